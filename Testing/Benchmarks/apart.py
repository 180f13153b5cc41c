# SPDX-License-Identifier: BSD-3-Clause
"""What the benchmarks share whose figures come from a process of their own each."""

import argparse
import json
import os
import subprocess
import sys

from pointsurface.rendering import write_whole


def measure_apart(script, *case):
    """What the script's function measure() returns for a case, in a process of its own."""
    print(f"{os.path.basename(script)}:", *case, file=sys.stderr, flush=True)
    command = [sys.executable, os.path.abspath(script), "--measure", json.dumps(case)]
    result = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(result.stdout.splitlines()[-1])


def main(script, description, measure, make_report):
    """The command line of a benchmark: prints its report, and writes it beside the script, or to a file.

    measure: a function of a case, whose result JSON can hold. make_report: a function that returns Markdown.
    """
    parser = argparse.ArgumentParser(description=description.splitlines()[0])
    default_output = os.path.splitext(os.path.abspath(script))[0] + ".md"
    parser.add_argument("--output", nargs="?", const=default_output, metavar="FILE", help="write the report to a file")
    parser.add_argument("--measure", type=json.loads, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.measure is not None:
        print(json.dumps(measure(*arguments.measure)))
        return
    report = make_report()
    print(report, end="")
    if arguments.output:
        write_whole(arguments.output, report.encode())
