# SPDX-License-Identifier: BSD-3-Clause
"""How the command line tells what it is doing, on standard error, and how Ctrl-C stops it."""

import signal
import sys
import threading
import time
from contextlib import contextmanager


def announce(what):
    print(f"{what} ...", file=sys.stderr, flush=True)


@contextmanager
def shown(what):
    """Gives a function to be called with 0 to 1, which shows the share of what is done where that takes over a second.

    A bar if tqdm is installed and standard error is a terminal, else a line a second.
    """
    bar = _bar(what)
    if bar is None:
        yield _lines(what)
        return
    with bar:

        def move(fraction):
            bar.update(fraction - bar.n)

        yield move


def _bar(what):
    if not sys.stderr.isatty():
        return None
    try:
        from tqdm import tqdm
    except ImportError:
        return None
    layout = "{desc}: {percentage:3.0f}%|{bar}| {elapsed} < {remaining}"
    return tqdm(desc=what, total=1.0, delay=1, leave=False, file=sys.stderr, bar_format=layout)


def _lines(what):
    last = time.monotonic()

    def report(fraction):
        nonlocal last
        if time.monotonic() - last >= 1:
            last = time.monotonic()
            announce(f"{what}: {fraction:.0%}")

    return report


@contextmanager
def waiting(what):
    """Shows for how long the block has run, a line a second: where nobody can tell how far it is."""
    start, is_over = time.monotonic(), threading.Event()

    def tell():
        while not is_over.wait(1):
            announce(f"{what}: {time.monotonic() - start:.0f} s")

    teller = threading.Thread(target=tell)
    teller.start()
    try:
        yield
    finally:
        is_over.set()
        teller.join()


@contextmanager
def followed(algorithm, what):
    """Shows how far a vtkAlgorithm is while the block runs it. Ctrl-C aborts it, and raises KeyboardInterrupt after the
    block: VTK ends the whole process, with no chance to clean up, if an observer raises it.
    """
    interrupted = False

    def interrupt(*_):
        nonlocal interrupted
        interrupted = True

    with shown(what) as show:

        def progress(caller, _event):
            show(caller.GetProgress())
            if interrupted:
                caller.AbortExecuteOn()

        observer = algorithm.AddObserver("ProgressEvent", progress)
        usual = signal.getsignal(signal.SIGINT)
        if usual is signal.default_int_handler:  # not where a shell has it ignored, as in the background
            signal.signal(signal.SIGINT, interrupt)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, usual)
            algorithm.RemoveObserver(observer)
    if interrupted:
        raise KeyboardInterrupt
