# SPDX-License-Identifier: BSD-3-Clause
"""The options that commands of the command line share, and how their values are read."""

import argparse
import math


def add_subject(parser):
    """What is drawn or converted: a file."""
    parser.add_argument("file", help="volume, mesh or points")
    add_isovalue(parser)


def add_isovalue(parser):
    parser.add_argument("--isovalue", type=finite, metavar="V", help="of a volume; default: Otsu's threshold")


def add_size(parser):
    parser.add_argument("--size", type=size, default=(800, 600), metavar="WxH", help="pixels; default: 800x600")


def add_json(parser):
    parser.add_argument("--json", action="store_true", help="tell what was done as JSON on standard output")


def finite(text):
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text} is no finite number")
    return value


def positive(text):
    try:
        value = float(text)
    except ValueError:
        value = 0
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is no number over 0")
    return value


def whole_number(low, high=None):
    """A type for whole numbers from `low` on, up to `high`."""

    def parse(text):
        value = int(text) if text.isdecimal() else -1
        if value < low or (high is not None and value > high):
            bounds = f"of {low} or more" if high is None else f"of {low} to {high}"
            raise argparse.ArgumentTypeError(f"{text} is no whole number {bounds}")
        return value

    return parse


def size(text):
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal()) or not all(16 <= int(n) <= 8192 for n in (width, height)):
        raise argparse.ArgumentTypeError(f"{text} is not WIDTHxHEIGHT with both in 16 to 8192, as in 800x600")
    return int(width), int(height)
