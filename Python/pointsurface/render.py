# SPDX-License-Identifier: BSD-3-Clause
"""Draws a file's points into a picture, or into the frames of a turn around them."""

import json
import os

import numpy as np

from . import scene
from .errors import WrongUse
from .options import add_json, add_scene, add_subject, whole_number
from .progress import announce, shown
from .rendering import read_color, renderer_string, write_png
from .subjects import load
from .timing import stage_milliseconds
from .writers import check_writable, whole_file

ANIMATED = {".gif": "GIF", ".apng": "PNG"}  # Pillow's names
FRAME_MILLISECONDS = 40


def add_arguments(parser):
    """The command's part of the command line."""
    add_subject(parser)
    parser.add_argument(
        "picture", help="the PNG file to write; with --orbit an animated .gif or .apng, or one of each frame: turn-%%03d.png"
    )
    parser.add_argument("--orbit", type=whole_number(2), metavar="N", help="N frames of a full turn of the camera")
    add_scene(parser)
    add_json(parser)


def run(arguments):
    """Writes the picture. Raises WrongUse, CannotRender or OSError with a line for the user."""
    check_writable(arguments.picture)
    _check_name(arguments)
    subject = load(arguments.file, arguments.isovalue)
    if subject.remark:
        announce(subject.remark)
    arguments.method = scene.choose_method(subject, arguments.method)
    renderer = scene.make(subject, arguments)
    mapper = renderer.GetActors().GetLastActor().GetMapper()
    window = scene.window_without_screen(renderer, arguments.size)
    announce(f"drawing {subject.title}")
    with scene.drawing(mapper):
        window.Render()
    camera = scene.describe_camera(renderer.GetActiveCamera())
    if arguments.orbit:
        pictures = _write_orbit(arguments, _orbit(window, renderer, arguments.orbit))
    else:
        write_png(arguments.picture, read_color(window))
        pictures = [arguments.picture]
    if arguments.json:
        print(
            json.dumps(
                {
                    "pictures": pictures,
                    "method": arguments.method,
                    "points": mapper.GetInput().GetNumberOfPoints(),
                    "bounds": subject.points.GetBounds(),
                    "camera": camera,
                    "milliseconds": stage_milliseconds(mapper),
                    "renderer": renderer_string(window),
                }
            )
        )


def _check_name(arguments):
    extension = os.path.splitext(arguments.picture)[1].lower()
    if extension in ANIMATED and not arguments.orbit:
        raise WrongUse(f"{arguments.picture} is for an animation: it needs --orbit")
    if extension not in (".png", *ANIMATED):
        raise WrongUse(f"{arguments.picture} does not end with .png, which pictures are")
    if not arguments.orbit:
        return
    if extension in ANIMATED:
        _pillow(arguments.picture)
    elif _frame_name(arguments.picture, 0) == _frame_name(arguments.picture, 1):
        endings = ", ".join(ANIMATED)
        raise WrongUse(f"{arguments.picture} is the name of one picture: --orbit needs one as turn-%03d.png, or {endings}")


def _frame_name(picture, index):
    try:
        return picture % index
    except (TypeError, ValueError):
        return picture


def _pillow(picture):
    try:
        from PIL import Image
    except ImportError:
        raise WrongUse(f"{picture} needs the package Pillow; frames as turn-%03d.png do not") from None
    return Image


def _orbit(window, renderer, count):
    """The frames of a turn, (height, width, 3), 0 to 1."""
    with shown("drawing the turn") as show:
        for i in range(count):
            yield read_color(window)
            show((i + 1) / count)
            renderer.GetActiveCamera().Azimuth(360 / count)
            renderer.ResetCameraClippingRange()


def _write_orbit(arguments, frames):
    extension = os.path.splitext(arguments.picture)[1].lower()
    if extension not in ANIMATED:
        names = [_frame_name(arguments.picture, i) for i in range(arguments.orbit)]
        for name, frame in zip(names, frames):
            write_png(name, frame)
        return names
    image = _pillow(arguments.picture)
    first, *others = (image.fromarray(np.rint(frame[::-1] * 255).astype(np.uint8)) for frame in frames)
    with whole_file(arguments.picture) as temporary:
        first.save(temporary, ANIMATED[extension], save_all=True, append_images=others, duration=FRAME_MILLISECONDS, loop=0)
    return [arguments.picture]
