# SPDX-License-Identifier: BSD-3-Clause
"""Draws a file's points into a picture."""

import argparse
import json

from vtkmodules.vtkCommonColor import vtkNamedColors
from vtkmodules.vtkCommonCore import vtkLookupTable

from .errors import WrongUse
from .methods import METHODS
from .options import add_json, add_size, add_subject, positive
from .progress import announce
from .rendering import offscreen_window, read_color, renderer_string, write_png
from .scene import make_scene
from .subjects import ISOSURFACE_RADIUS_SCALE, load
from .writers import check_writable

# Where the camera stands, from the middle of the points, and what is up in its picture.
VIEWS = {
    "front": ((0, -1, 0), (0, 0, 1)),
    "back": ((0, 1, 0), (0, 0, 1)),
    "left": ((-1, 0, 0), (0, 0, 1)),
    "right": ((1, 0, 0), (0, 0, 1)),
    "top": ((0, 0, 1), (0, 1, 0)),
    "bottom": ((0, 0, -1), (0, 1, 0)),
    "oblique": ((1, 1, 1), (0, 0, 1)),
}


def add_arguments(parser):
    """The command's part of the command line."""
    add_subject(parser)
    parser.add_argument("picture", help="the PNG file to write")
    parser.add_argument("--method", choices=METHODS, default="pull-push", help="default: %(default)s")
    add_size(parser)
    parser.add_argument("--view", choices=VIEWS, help="from where; default: as the demo has it")
    parser.add_argument("--radius", type=positive, metavar="R", help="of all points, in the units of the file")
    parser.add_argument("--radius-scale", type=positive, metavar="S", help="factor on all radii; default: 1")
    parser.add_argument("--supersampling", type=int, choices=range(1, 5), default=1, help="default: %(default)s")
    parser.add_argument("--scalars", metavar="NAME", help="point array to colour by")
    parser.add_argument("--color", type=_color, metavar="COLOR", help="name or #rrggbb")
    parser.add_argument("--background", type=_color, metavar="COLOR", help="name or #rrggbb")
    add_json(parser)


def run(arguments):
    """Writes the picture. Raises WrongUse or OSError with a line for the user."""
    check_writable(arguments.picture)
    subject = load(arguments.file, arguments.isovalue)
    if subject.remark:
        announce(subject.remark)
    mapper = _make_mapper(subject, arguments)
    renderer = make_scene(subject, mapper)
    if arguments.view:
        _look_from(renderer, *VIEWS[arguments.view])
    if arguments.color:
        renderer.GetActors().GetLastActor().GetProperty().SetColor(arguments.color)
    if arguments.background:
        renderer.SetBackground(arguments.background)
    announce(f"drawing {subject.title}")
    window = offscreen_window(renderer, arguments.size)
    write_png(arguments.picture, read_color(window))
    if arguments.json:
        print(json.dumps(_report(subject, mapper, window, arguments)))


def _make_mapper(subject, arguments):
    mapper = METHODS[arguments.method]()
    mapper.SetInputData(subject.points)
    default_scale = ISOSURFACE_RADIUS_SCALE if subject.is_isosurface else 1
    mapper.SetRadiusScale(arguments.radius_scale or default_scale)
    mapper.SetRadius(arguments.radius or 0)
    mapper.SetSupersampling(arguments.supersampling)
    if arguments.scalars:
        _color_by(mapper, subject.points.GetPointData(), arguments)
    return mapper


def _color_by(mapper, data, arguments):
    array = data.GetArray(arguments.scalars)
    if array is None:
        names = ", ".join(data.GetArrayName(i) for i in range(data.GetNumberOfArrays())) or "none"
        raise WrongUse(f'{arguments.file} has no point array "{arguments.scalars}"; it has: {names}')
    table = vtkLookupTable()
    table.SetHueRange(2 / 3, 0)  # blue is low
    mapper.SetLookupTable(table)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(arguments.scalars)
    mapper.SetScalarRange(array.GetRange())


def _look_from(renderer, direction, up):
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(direction)
    camera.SetViewUp(up)
    renderer.ResetCamera()


def _report(subject, mapper, window, arguments):
    return {
        "picture": arguments.picture,
        "method": arguments.method,
        "points": subject.points.GetNumberOfPoints(),
        "bounds": subject.points.GetBounds(),
        "milliseconds": {
            stage.lower(): getattr(mapper, f"GetLastFrame{stage}Milliseconds")()
            for stage in ("Project", "Reconstruct", "Shade")
        },
        "renderer": renderer_string(window),
    }


def _color(text):
    red, green, blue, alpha = vtkNamedColors().HTMLColorToRGBA(text)
    if alpha == 0:
        raise argparse.ArgumentTypeError(f"{text} is no colour: a name as in HTML, or #rrggbb, is needed")
    return red / 255, green / 255, blue / 255
