# SPDX-License-Identifier: BSD-3-Clause
"""The command line: python3 -m pointsurface COMMAND."""

import argparse
import sys

from . import bench, convert, demo, info, render, view
from .errors import CannotRender, WrongUse

CANNOT_RENDER = 1
WRONG_USE = 2
INTERRUPTED = 130


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, without the usage."""

    def error(self, message):
        self.exit(WRONG_USE, f"{self.prog}: {message} (--help tells more)\n")


def main():
    parser = _Parser(
        prog="pointsurface", description="Point clouds drawn as closed, lit surfaces, with no mesh.",
        epilog="Exit codes: 0 done; 1 no OpenGL or no display to draw with; 2 a file or an option will not do; "
        "130 stopped by Ctrl-C, which leaves no half file.",
    )  # fmt: skip
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, command, explanation in (
        ("render", render, "draw a file's points into a picture"),
        ("view", view, "show a file's points in a window, with keys to change how"),
        ("info", info, "tell what a file holds"),
        ("convert", convert, "write a file's points, with normals, radii or as splats"),
        ("bench", bench, "measure speed against error, beside what VTK draws points with"),
        ("demo", demo, "draw a file from points, and its mesh beside it"),
    ):
        command_parser = commands.add_parser(name, help=explanation, description=command.__doc__)
        command.add_arguments(command_parser)
        command_parser.set_defaults(run=command.run)
    arguments = parser.parse_args()
    try:
        arguments.run(arguments)
    except WrongUse as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        return WRONG_USE
    except CannotRender as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        return CANNOT_RENDER
    except OSError as error:  # of the folder or files that are written
        print(f"{parser.prog}: {error.filename}: {error.strerror}", file=sys.stderr)
        return WRONG_USE
    except KeyboardInterrupt:
        return INTERRUPTED
    return 0


if __name__ == "__main__":
    sys.exit(main())
