# SPDX-License-Identifier: BSD-3-Clause
"""What can be wrong, in words for a user, and what VTK has to complain about."""

import os
import re
import sys
from contextlib import contextmanager

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow


class WrongUse(Exception):
    """A file, an array or an option that will not do; its text is one line that says why and what would."""


class UnreadableFile(WrongUse):
    """A file that cannot be opened as a volume or as points; its text is one line that says why."""


class CannotRender(Exception):
    """There is no OpenGL, or no display, to draw with; its text is one line that says why and what to do."""


@contextmanager
def complaints():
    """Keeps what VTK's objects have to say off standard error. Gives a function that returns what they said so far.

    The function's argument is "ERROR" or "Warning"; it returns a list of texts of one line, the same text once. A generic
    warning counts as an error: the readers of raw data tell so of a file that ends too early.
    """
    heard = vtkStringOutputWindow()
    usual = vtkOutputWindow.GetInstance()
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(heard)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)

    def of_kind(kind):
        kinds = r"(?:ERROR|Generic Warning)" if kind == "ERROR" else kind
        pattern = rf"^{kinds}: In [^\n]*\n(?:\w+ \(0x\w+\): )?(.*?)\s*(?:\n\n|\Z)"
        texts = re.findall(pattern, heard.GetOutput(), re.M | re.S)
        return list(dict.fromkeys(" ".join(text.split()) for text in texts))

    try:
        yield of_kind
    finally:
        vtkOutputWindow.SetInstance(usual)
        vtkLogger.SetStderrVerbosity(verbosity)


@contextmanager
def silent(stream):
    """Keeps off standard output (1) or standard error (2) what VTK's objects write there; 0: nothing.

    What comes through Python's sys.stdout or sys.stderr, as progress does, is still written.
    """
    if not stream:
        yield
        return
    name = {1: "stdout", 2: "stderr"}[stream]
    usual = getattr(sys, name)
    kept = os.dup(stream)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    shown = usual
    if _writes_to(usual, stream):  # and not to a file, or to a notebook
        usual.flush()
        shown = open(kept, "w", buffering=1, encoding=usual.encoding, errors=usual.errors, closefd=False)
    try:
        os.dup2(nowhere, stream)
        setattr(sys, name, shown)
        yield
    finally:
        setattr(sys, name, usual)
        if shown is not usual:
            shown.close()
        os.dup2(kept, stream)
        os.close(kept)
        os.close(nowhere)


def _writes_to(file, stream):
    try:
        return file.fileno() == stream
    except (AttributeError, OSError):  # there is none, or it has no number
        return False
