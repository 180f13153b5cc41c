# SPDX-License-Identifier: BSD-3-Clause
"""The options that commands of the command line share, and how their values are read."""

import argparse
import json
import math

from .colors import COLOR_MAPS, color_map, parse_color
from .methods import AUTO, METHODS
from .passes import PASSES
from .scene import VIEWS


def add_subject(parser):
    """What is drawn or converted: a file."""
    parser.add_argument("file", help="volume, mesh or points")
    add_isovalue(parser)


def add_isovalue(parser):
    parser.add_argument("--isovalue", type=finite, metavar="V", help="of a volume; default: Otsu's threshold")


def add_size(parser):
    parser.add_argument("--size", type=size, default=(800, 600), metavar="WxH", help="pixels; default: 800x600")


def add_scene(parser):
    """How the points are drawn: see scene.make()."""
    surface = parser.add_argument_group("the surface")
    surface.add_argument(
        "--method", choices=(*METHODS, AUTO), default="pull-push",
        help="how it is made of the points; auto: by what measures best for such points here. Default: %(default)s",
    )  # fmt: skip
    surface.add_argument("--radius", type=positive, metavar="R", help="of all points, in the units of the file")
    surface.add_argument("--radius-scale", type=positive, metavar="S", help="factor on all radii; default: 1")
    surface.add_argument("--supersampling", type=int, choices=range(1, 5), default=1, help="default: %(default)s")
    surface.add_argument(
        "--pass", dest="passes", choices=PASSES, action="append", default=[], metavar="PASS",
        help=f"a filter of the picture, once for each, in their order: {', '.join(PASSES)}",
    )  # fmt: skip
    surface.add_argument(
        "--clip", type=clipping_plane, action="append", default=[], metavar="NX,NY,NZ[@X,Y,Z]",
        help="keep what lies on the side of a plane that its normal points to; through a point, default: the middle. "
        "Up to six. As in --clip=-1,0,0",
    )  # fmt: skip
    colors = parser.add_argument_group("colours and lights")
    colors.add_argument("--color", type=color, metavar="COLOR", help="of the surface: name or #rrggbb")
    colors.add_argument("--background", type=color, metavar="COLOR", help="name or #rrggbb")
    colors.add_argument("--scalars", metavar="NAME", help="point array to colour by; of vectors their length")
    colors.add_argument(
        "--cmap", type=color_table, metavar="MAP",
        help=f"{', '.join(COLOR_MAPS)}, or one of matplotlib's where that is installed; default: rainbow",
    )  # fmt: skip
    colors.add_argument("--range", type=value_range, metavar="LOW,HIGH", help="of the colour map; default: the array's")
    colors.add_argument(
        "--light", type=light, action="append", default=[], metavar="AZIMUTH,ELEVATION[,INTENSITY]",
        help="a light, in degrees as seen from the camera, 0,0 being at the camera, in place of the two that are there",
    )  # fmt: skip
    camera = parser.add_mutually_exclusive_group()
    camera.add_argument("--view", choices=VIEWS, help="from where; default: as the demo has it")
    camera.add_argument("--camera", type=camera_file, metavar="FILE", help='JSON, such as the "camera" of render --json')
    add_size(parser)


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


def vector(text, *counts):
    """A tuple of finite numbers, of as many as one of `counts`."""
    try:
        values = tuple(float(word) for word in text.split(","))
    except ValueError:
        values = ()
    if len(values) not in counts or not all(map(math.isfinite, values)):
        wanted = " or ".join(map(str, counts))
        raise argparse.ArgumentTypeError(f"{text} is not {wanted} finite numbers with commas between them")
    return values


def value_range(text):
    low, high = vector(text, 2)
    if low >= high:
        raise argparse.ArgumentTypeError(f"{text} is no range: its first number is to be the lower one")
    return low, high


def light(text):
    """(azimuth, elevation, intensity), the angles in degrees as seen from the camera."""
    azimuth, elevation, *intensity = vector(text, 2, 3)
    intensity = intensity[0] if intensity else 1.0
    if intensity <= 0:
        raise argparse.ArgumentTypeError(f"{text}: an intensity is over 0")
    return azimuth, elevation, intensity


def clipping_plane(text):
    """(normal, origin or None)."""
    normal, at, origin = text.partition("@")
    normal = vector(normal, 3)
    if not any(normal):
        raise argparse.ArgumentTypeError(f"{text}: a plane's normal is not 0,0,0")
    return normal, vector(origin, 3) if at else None


def color(text):
    try:
        return parse_color(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def color_table(text):
    try:
        return color_map(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def camera_file(text):
    """A dict of a JSON file, as `render --json` tells it and the viewer saves it; see scene.place_camera()."""
    try:
        with open(text, encoding="utf-8") as file:
            camera = json.load(file)
    except OSError as error:
        raise argparse.ArgumentTypeError(f"{text}: {error.strerror}") from error
    except ValueError as error:  # of UTF-8, too
        raise argparse.ArgumentTypeError(f"{text} is no JSON: {error}") from error
    camera = camera.get("camera", camera) if isinstance(camera, dict) else {}
    for name in ("position", "focal_point", "view_up"):
        if not _is_vector(camera.get(name)):
            raise argparse.ArgumentTypeError(f'{text} has no "{name}" of three numbers')
    for name in ("view_angle", "parallel_scale"):
        if not isinstance(camera.get(name, 1), (int, float)) or not 0 < camera.get(name, 1):
            raise argparse.ArgumentTypeError(f'{text}: "{name}" is no number over 0')
    return camera


def _is_vector(value):
    return isinstance(value, list) and len(value) == 3 and all(isinstance(x, (int, float)) for x in value)
