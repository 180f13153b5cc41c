# SPDX-License-Identifier: BSD-3-Clause
"""Draws a file from points by pull-push, beside the mesh of the same surface, and tells how far apart the two are."""

import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkRenderer

from . import vtkPullPushMapper
from .errors import WrongUse
from .metrics import SurfaceImage, compare
from .options import add_isovalue, add_size
from .progress import announce
from .rendering import read_color, renderer_string, write_png
from .scene import drawing, make_scene, window_without_screen
from .subjects import ISOSURFACE_RADIUS_SCALE, load
from .timing import time_frames
from .truth import render_truth

FRAMES = 20
DIFFERENCE_GAIN = 4


def add_arguments(parser):
    """The demo's part of the command line."""
    parser.add_argument("file", nargs="?", help="volume, mesh or points; default: the MR head of Debian's mricron-data")
    add_isovalue(parser)
    add_size(parser)
    parser.add_argument(
        "--output", default="pointsurface-demo", metavar="DIR", help="folder of the pictures; default: %(default)s"
    )


def run(arguments):
    """Writes the pictures and prints the table. Raises WrongUse or OSError with a line for the user."""
    subject = load(arguments.file, arguments.isovalue)
    if subject.remark:
        print(subject.remark)
    os.makedirs(arguments.output, exist_ok=True)
    rows = [("points", f"{subject.points.GetNumberOfPoints()}")]
    if subject.is_isosurface:
        rows.append(("extract points", f"{subject.extract_milliseconds:.1f} ms"))

    mapper = vtkPullPushMapper()
    mapper.SetInputData(subject.points)
    mapper.SetRadiusScale(ISOSURFACE_RADIUS_SCALE if subject.is_isosurface else 1)
    renderer = make_scene(subject, mapper)
    window = window_without_screen(renderer, arguments.size)
    announce("drawing the points")
    with drawing(mapper):
        window.Render()
    pictures = {"points": read_color(window)}
    image = _surface_image(pictures["points"], mapper)
    if subject.mesh is not None:
        announce("drawing the mesh, 16 samples a pixel")
        surface_property = renderer.GetActors().GetLastActor().GetProperty()
        truth = render_truth(subject.mesh, renderer, surface_property, arguments.size)
        pictures["mesh"] = truth.color
        pictures["difference"] = DIFFERENCE_GAIN * np.abs(image.color - truth.color)
        measures = compare(image, truth, subject.points.GetLength())
    announce("timing")
    rows += _timing_rows(time_frames(window, renderer, FRAMES, mapper=mapper))
    if subject.mesh is not None:
        rows += _measure_rows(measures)
    rows.append(("OpenGL renderer", renderer_string(window)))

    if subject.mesh is not None:
        pictures["montage"] = np.concatenate(list(pictures.values()), axis=1)
    _write_pictures(pictures, arguments.output)
    _print_report(subject, arguments, rows, pictures)


def _surface_image(color, mapper):
    buffer = vtkImageData()
    if not mapper.ReadSurfaceBuffer(buffer):
        raise WrongUse("nothing has been drawn, so that there is nothing to measure")
    width, height, _ = buffer.GetDimensions()
    data = buffer.GetPointData()
    normals = vtk_to_numpy(data.GetArray("Normals")).reshape(height, width, 3)
    depth = vtk_to_numpy(data.GetArray("Depth")).reshape(height, width)
    return SurfaceImage(color, normals.astype(float), depth.astype(float))


def _timing_rows(milliseconds):
    names = {"project": "project", "reconstruct": "reconstruct", "shade": "shade", "frame": "whole frame"}
    return [(name, f"{milliseconds[key]:.1f} ms") for key, name in names.items()]


def _measure_rows(measures):
    return [
        ("PSNR", f"{measures['psnr']:.1f} dB"),
        ("SSIM", f"{measures['ssim']:.4f}"),
        ("normal error", f"{measures['normal_mean']:.2f} degrees on average, 95% below {measures['normal_95']:.2f}"),
        ("depth error", f"{100 * measures['depth']:.4f}% of the bounding box's diagonal on average"),
        ("silhouettes", f"{measures['iou']:.4f} intersection over union"),
        ("unfilled", f"{100 * measures['unfilled']:.3f}% of the pixels inside the silhouette"),
    ]


def _write_pictures(pictures, folder):
    """Pictures of an earlier run that this one has none of go, lest they be taken for its own."""
    for name in ("points", "mesh", "difference", "montage"):
        path = os.path.join(folder, f"{name}.png")
        if name in pictures:
            write_png(path, pictures[name])
        elif os.path.exists(path):
            os.remove(path)


def _print_report(subject, arguments, rows, pictures):
    width, height = arguments.size
    print(f"{subject.title[0].upper()}{subject.title[1:]}, {width} x {height} pixels")
    for name, value in rows:
        print(f"  {name:<16} {value}")
    print(f"Frames and their stages: median of {FRAMES}, camera moving.")
    if subject.mesh is None:
        print("The file has no polygons, so there is no true surface to compare with.")
    else:
        print(f"The difference is shown {DIFFERENCE_GAIN} times as bright; the mesh has 16 samples a pixel.")
    print(f"Pictures in {arguments.output}: {', '.join(f'{name}.png' for name in pictures)}")
