# SPDX-License-Identifier: BSD-3-Clause
"""What a command of the command line draws: the points of a file, whatever kind of file it is."""

import argparse
import math
import os
import sys
import time
from dataclasses import dataclass
from typing import Optional

from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkRenderer

from . import vtkIsosurfacePoints
from .readers import UnreadableFile, read
from .truth import mend_normals, with_normals
from .volumes import gyroid_ball, otsu_threshold

# The MR head of Debian's package mricron-data: Colin 27, Montreal Neurological Institute.
HEAD = "/usr/share/mricron/templates/ch2.nii.gz"
HEAD_ISOVALUE = 50.5  # the skin; at 50 many voxels equal the isovalue
# The points' radii just close the surface. To average over more points makes the normals smoother: on the head 1.5 brings
# their mean error from 2.6 to 1.8 degrees for the same PSNR; at 2 silhouettes have grown, for 1 dB less.
ISOSURFACE_RADIUS_SCALE = 1.5


@dataclass
class Subject:
    """Points, and the mesh of the same surface where there is one."""

    title: str
    points: vtkPolyData
    mesh: Optional[vtkPolyData] = None
    extract_milliseconds: Optional[float] = None  # of an isosurface
    remark: str = ""  # for the user, on what was chosen

    @property
    def is_isosurface(self):
        return self.extract_milliseconds is not None


def announce(what):
    print(f"{what} ...", file=sys.stderr, flush=True)


def watch(what):
    """A function to be called with 0 to 1, which announces the share of what is done: at most once a second."""
    last = time.monotonic()

    def report(fraction):
        nonlocal last
        if time.monotonic() - last >= 1:
            last = time.monotonic()
            announce(f"{what}: {fraction:.0%}")

    return report


def isovalue_argument(text):
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text} is no finite number")
    return value


def size_argument(text):
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal()) or not all(16 <= int(n) <= 8192 for n in (width, height)):
        raise argparse.ArgumentTypeError(f"{text} is not WIDTHxHEIGHT with both in 16 to 8192, as in 800x600")
    return int(width), int(height)


def load(path, isovalue=None):
    """The points of a file, or of the default head without one. Raises UnreadableFile.

    A volume's are those of its isosurface, at Otsu's threshold if no isovalue is given; scalars that are no colours are
    not left active.
    """
    if path is None:
        return _default_subject(isovalue)
    data = read(path, watch(f"reading {path}"))
    name = os.path.basename(path)
    if isinstance(data, vtkImageData):
        if isovalue is not None:
            return _isosurface(name, data, isovalue)
        try:
            isovalue = otsu_threshold(data)
        except ValueError as error:
            raise UnreadableFile(f"{path}: {error}") from error
        remark = f"Isovalue by Otsu's threshold: {isovalue:g} (--isovalue takes another)"
        return _isosurface(name, data, isovalue, remark)
    if isovalue is not None:
        raise UnreadableFile(f"{path} is no volume: --isovalue has no meaning for it")
    return _points_and_mesh(name, data)


def _default_subject(isovalue):
    if os.path.exists(HEAD):
        head = read(HEAD, watch(f"reading {HEAD}"))
        return _isosurface("MR head (Colin 27)", head, HEAD_ISOVALUE if isovalue is None else isovalue)
    remark = f"{HEAD} is not there (Debian's mricron-data has it): a gyroid in a ball instead"
    return _isosurface("gyroid in a ball", gyroid_ball(), 0.0 if isovalue is None else isovalue, remark)


def _isosurface(name, volume, isovalue, remark=""):
    extract = vtkIsosurfacePoints()
    extract.SetInputData(volume)
    extract.SetValue(0, isovalue)
    report = watch("extracting points")
    extract.AddObserver("ProgressEvent", lambda caller, _: report(caller.GetProgress()))
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
    return Subject(title, extract.GetOutput(), mesh, milliseconds, remark)


def _points_and_mesh(name, data):
    """A file's points as they are; if it has polygons they are the mesh, with normals of their own if it has none."""
    scalars = data.GetPointData().GetScalars()
    if scalars is not None and scalars.GetDataType() != VTK_UNSIGNED_CHAR:
        data.GetPointData().SetActiveScalars(None)  # measurements, not colours
    points = vtkPolyData()
    points.SetPoints(data.GetPoints())
    points.GetPointData().ShallowCopy(data.GetPointData())
    if data.GetNumberOfPolys() + data.GetNumberOfStrips() == 0:
        return Subject(f"points of {name}", points)
    if data.GetPointData().GetNormals() is None:
        normals = with_normals(data).GetPointData().GetNormals()
        mesh = vtkPolyData()
        mesh.ShallowCopy(data)
        mesh.GetPointData().SetNormals(normals)
        return Subject(f"points of {name}", points, mesh)
    return Subject(f"points of {name}", points, data)


def make_scene(subject, mapper):
    """A renderer with the subject, drawn by `mapper`, as its actor, a key light and a fill light, a camera that sees all."""
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
    return renderer
