# SPDX-License-Identifier: BSD-3-Clause
"""What a command of the command line draws: the points of a file, whatever kind of file it is."""

import os
import time
from dataclasses import dataclass
from functools import cached_property
from typing import Callable, Optional

from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

from . import vtkIsosurfacePoints
from .errors import WrongUse
from .progress import followed
from .readers import read
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
    make_mesh: Optional[Callable[[], vtkPolyData]] = None
    extract_milliseconds: Optional[float] = None  # of an isosurface
    remark: str = ""  # for the user, on what was chosen

    @property
    def is_isosurface(self):
        return self.extract_milliseconds is not None

    @cached_property
    def mesh(self):
        return self.make_mesh() if self.make_mesh else None


def load(path, isovalue=None):
    """The points of a file, or of the default head without one. Raises WrongUse.

    A volume's are those of its isosurface, at Otsu's threshold if no isovalue is given; scalars that are no colours are
    not left active.
    """
    if path is None:
        return _default_subject(isovalue)
    data = read(path, tell=True)
    name = os.path.basename(os.path.abspath(path))  # of a folder, too, which may end with a slash
    if isinstance(data, vtkImageData):
        if isovalue is not None:
            return _isosurface(name, data, isovalue)
        try:
            isovalue = otsu_threshold(data)
        except ValueError as error:
            raise WrongUse(f"{path}: {error}") from error
        remark = f"Isovalue by Otsu's threshold: {isovalue:g} (--isovalue takes another)"
        return _isosurface(name, data, isovalue, remark)
    if isovalue is not None:
        raise WrongUse(f"{path} is no volume: --isovalue has no meaning for it")
    return _points_and_mesh(name, data)


def _default_subject(isovalue):
    if os.path.exists(HEAD):
        head = read(HEAD, tell=True)
        return _isosurface("MR head (Colin 27)", head, HEAD_ISOVALUE if isovalue is None else isovalue)
    remark = f"{HEAD} is not there (Debian's mricron-data has it): a gyroid in a ball instead"
    return gyroid(isovalue=0.0 if isovalue is None else isovalue, remark=remark)


def gyroid(samples=128, isovalue=0.0, remark=""):
    """A subject that needs no file: the gyroid's labyrinth inside of a ball, of a volume of samples^3. Raises WrongUse."""
    return _isosurface("gyroid in a ball", gyroid_ball(samples), isovalue, remark)


def _isosurface(name, volume, isovalue, remark=""):
    extract = vtkIsosurfacePoints()
    extract.SetInputData(volume)
    extract.SetValue(0, isovalue)
    start = time.perf_counter()
    with followed(extract, "extracting points"):
        extract.Update()
    milliseconds = (time.perf_counter() - start) * 1000
    if extract.GetOutput().GetNumberOfPoints() == 0:
        low, high = volume.GetScalarRange()
        raise WrongUse(f"{name} has no surface at isovalue {isovalue:g}: its values lie in {low:g} to {high:g}")

    title = f"isosurface of {name} at {isovalue:g}"
    return Subject(title, extract.GetOutput(), lambda: _contour(volume, isovalue), milliseconds, remark)


def _contour(volume, isovalue):
    contour = vtkFlyingEdges3D()
    contour.SetInputData(volume)
    contour.SetValue(0, isovalue)
    contour.ComputeScalarsOff()
    with followed(contour, "extracting the mesh"):
        contour.Update()
    mesh = contour.GetOutput()
    mend_normals(mesh)
    return mesh


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
    return Subject(f"points of {name}", points, lambda: _mesh_with_normals(data))


def _mesh_with_normals(data):
    if data.GetPointData().GetNormals() is not None:
        return data
    mesh = vtkPolyData()
    mesh.ShallowCopy(data)
    mesh.GetPointData().SetNormals(with_normals(data).GetPointData().GetNormals())
    return mesh
