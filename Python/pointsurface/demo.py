# SPDX-License-Identifier: BSD-3-Clause
"""Draws a file from points by pull-push, beside the mesh of the same surface, and tells how far apart the two are."""

import argparse
import math
import os
import sys
import time
from dataclasses import dataclass
from typing import Optional

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkRenderer

from . import vtkIsosurfacePoints, vtkPullPushMapper
from .metrics import SurfaceImage, compare
from .readers import UnreadableFile, read
from .rendering import offscreen_window, read_color, renderer_string, write_png
from .timing import time_frames
from .truth import mend_normals, render_truth, with_normals
from .volumes import gyroid_ball, otsu_threshold

# The MR head of Debian's package mricron-data: Colin 27, Montreal Neurological Institute.
HEAD = "/usr/share/mricron/templates/ch2.nii.gz"
HEAD_ISOVALUE = 50.5  # the skin; at 50 many voxels equal the isovalue
# The points' radii just close the surface. To average over more points makes the normals smoother: on the head 1.5 brings
# their mean error from 2.6 to 1.8 degrees for the same PSNR; at 2 silhouettes have grown, for 1 dB less.
ISOSURFACE_RADIUS_SCALE = 1.5
FRAMES = 20
DIFFERENCE_GAIN = 4


def add_arguments(parser):
    """The demo's part of the command line."""
    parser.add_argument("file", nargs="?", help="volume, mesh or points; default: the MR head of Debian's mricron-data")
    parser.add_argument("--isovalue", type=_isovalue, metavar="V", help="of a volume; default: Otsu's threshold")
    parser.add_argument("--size", type=_size, default=(800, 600), metavar="WxH", help="pixels; default: 800x600")
    parser.add_argument(
        "--output", default="pointsurface-demo", metavar="DIR", help="folder of the pictures; default: %(default)s"
    )


def run(arguments):
    """Writes the pictures and prints the table. Raises UnreadableFile or OSError with a line for the user."""
    subject = _load(arguments.file, arguments.isovalue)
    os.makedirs(arguments.output, exist_ok=True)
    rows = [("points", f"{subject.points.GetNumberOfPoints()}")]
    if subject.is_isosurface:
        rows.append(("extract points", f"{subject.extract_milliseconds:.1f} ms"))

    _announce("drawing the points")
    renderer, mapper = _scene(subject)
    window = offscreen_window(renderer, arguments.size)
    pictures = {"points": read_color(window)}
    image = _surface_image(pictures["points"], mapper)
    if subject.mesh is not None:
        _announce("drawing the mesh, 16 samples a pixel")
        surface_property = renderer.GetActors().GetLastActor().GetProperty()
        truth = render_truth(subject.mesh, renderer, surface_property, arguments.size)
        pictures["mesh"] = truth.color
        pictures["difference"] = DIFFERENCE_GAIN * np.abs(image.color - truth.color)
        measures = compare(image, truth, subject.points.GetLength())
    _announce("timing")
    rows += _timing_rows(time_frames(window, renderer, FRAMES, mapper=mapper))
    if subject.mesh is not None:
        rows += _measure_rows(measures)
    rows.append(("OpenGL renderer", renderer_string(window)))

    if subject.mesh is not None:
        pictures["montage"] = np.concatenate(list(pictures.values()), axis=1)
    _write_pictures(pictures, arguments.output)
    _print_report(subject, arguments, rows, pictures)


@dataclass
class _Subject:
    """What is drawn: points, and the mesh of the same surface where there is one."""

    title: str
    points: vtkPolyData
    mesh: Optional[vtkPolyData] = None
    extract_milliseconds: Optional[float] = None  # of an isosurface

    @property
    def is_isosurface(self):
        return self.extract_milliseconds is not None


def _announce(what):
    print(f"{what} ...", file=sys.stderr, flush=True)


def _watch(what):
    """A function to be called with 0 to 1, which announces the share of what is done: at most once a second."""
    last = time.monotonic()

    def report(fraction):
        nonlocal last
        if time.monotonic() - last >= 1:
            last = time.monotonic()
            _announce(f"{what}: {fraction:.0%}")

    return report


def _isovalue(text):
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text} is no finite number")
    return value


def _size(text):
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal()) or not all(16 <= int(n) <= 8192 for n in (width, height)):
        raise argparse.ArgumentTypeError(f"{text} is not WIDTHxHEIGHT with both in 16 to 8192, as in 800x600")
    return int(width), int(height)


def _load(path, isovalue):
    if path is None:
        return _default_subject(isovalue)
    data = read(path, _watch(f"reading {path}"))
    name = os.path.basename(path)
    if isinstance(data, vtkImageData):
        if isovalue is None:
            try:
                isovalue = otsu_threshold(data)
            except ValueError as error:
                raise UnreadableFile(f"{path}: {error}") from error
            print(f"Isovalue by Otsu's threshold: {isovalue:g} (--isovalue takes another)")
        return _isosurface(name, data, isovalue)
    if isovalue is not None:
        raise UnreadableFile(f"{path} is no volume: --isovalue has no meaning for it")
    return _points_and_mesh(name, data)


def _default_subject(isovalue):
    if os.path.exists(HEAD):
        head = read(HEAD, _watch(f"reading {HEAD}"))
        return _isosurface("MR head (Colin 27)", head, HEAD_ISOVALUE if isovalue is None else isovalue)
    print(f"{HEAD} is not there (Debian's mricron-data has it): a gyroid in a ball instead")
    return _isosurface("gyroid in a ball", gyroid_ball(), 0.0 if isovalue is None else isovalue)


def _isosurface(name, volume, isovalue):
    extract = vtkIsosurfacePoints()
    extract.SetInputData(volume)
    extract.SetValue(0, isovalue)
    watch = _watch("extracting points")
    extract.AddObserver("ProgressEvent", lambda caller, _: watch(caller.GetProgress()))
    start = time.perf_counter()
    extract.Update()
    milliseconds = (time.perf_counter() - start) * 1000
    if extract.GetOutput().GetNumberOfPoints() == 0:
        low, high = volume.GetScalarRange()
        raise UnreadableFile(f"{name} has no surface at isovalue {isovalue:g}: its values lie in {low:g} to {high:g}")

    contour = vtkFlyingEdges3D()
    contour.SetInputData(volume)
    contour.SetValue(0, isovalue)
    contour.ComputeScalarsOff()
    contour.Update()
    mesh = contour.GetOutput()
    mend_normals(mesh)
    title = f"isosurface of {name} at {isovalue:g}"
    return _Subject(title, extract.GetOutput(), mesh, milliseconds)


def _points_and_mesh(name, data):
    """A file's points as they are; if it has polygons they are the mesh, with normals of their own if it has none."""
    scalars = data.GetPointData().GetScalars()
    if scalars is not None and scalars.GetDataType() != VTK_UNSIGNED_CHAR:
        data.GetPointData().SetActiveScalars(None)  # measurements, not colours
    points = vtkPolyData()
    points.SetPoints(data.GetPoints())
    points.GetPointData().ShallowCopy(data.GetPointData())
    if data.GetNumberOfPolys() + data.GetNumberOfStrips() == 0:
        return _Subject(f"points of {name}", points)
    if data.GetPointData().GetNormals() is None:
        normals = with_normals(data).GetPointData().GetNormals()
        mesh = vtkPolyData()
        mesh.ShallowCopy(data)
        mesh.GetPointData().SetNormals(normals)
        return _Subject(f"points of {name}", points, mesh)
    return _Subject(f"points of {name}", points, data)


def _scene(subject):
    """A renderer with the points as an actor, a key light and a fill light, and a camera that sees all."""
    mapper = vtkPullPushMapper()
    mapper.SetInputData(subject.points)
    mapper.SetRadiusScale(ISOSURFACE_RADIUS_SCALE if subject.is_isosurface else 1)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.93, 0.82, 0.72)
    actor.GetProperty().SetSpecular(0.2)
    actor.GetProperty().SetSpecularPower(30)
    renderer = vtkRenderer()
    renderer.SetBackground(0.15, 0.17, 0.2)
    renderer.AddActor(actor)
    for position, intensity in (((-0.6, 0.7, 1.0), 0.8), ((0.5, -0.2, 1.0), 0.3)):
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*position)
        light.SetIntensity(intensity)
        renderer.AddLight(light)
    camera = renderer.GetActiveCamera()
    # Scanners' volumes have z up and the face towards y, most models y up and the face towards z.
    camera.SetPosition(*((0.5, 1, 0.05) if subject.is_isosurface else (0.4, 0.3, 1)))
    camera.SetViewUp(*((0, 0, 1) if subject.is_isosurface else (0, 1, 0)))
    renderer.ResetCamera(subject.points.GetBounds())
    camera.Zoom(1.4)
    return renderer, mapper


def _surface_image(color, mapper):
    buffer = vtkImageData()
    if not mapper.ReadSurfaceBuffer(buffer):
        raise UnreadableFile("nothing has been drawn, so that there is nothing to measure")
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
