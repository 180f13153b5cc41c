# SPDX-License-Identifier: BSD-3-Clause
"""What the benchmark draws: meshes with normals, the points on them, and volumes whose isosurfaces change."""

import os
from dataclasses import dataclass

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import (
    vtkAppendPolyData,
    vtkFlyingEdges3D,
    vtkGlyph3D,
    vtkTriangleFilter,
)
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource, vtkPlaneSource, vtkSphereSource

from .clouds import make_cloud
from .errors import WrongUse
from .readers import read
from .sampling import sample_by_area
from .truth import mend_normals, with_normals
from .volumes import gyroid_ball

RADIUS = 1.5  # times the mean spacing
DATA_VARIABLE = "POINTSURFACE_SHARED_DATA"  # the folder of models, in the environment of the processes that measure, too
MESHES, VOLUMES = "meshes", "volumes"  # its folders


# ----------------------------------------------------------------------------------------------------------------------
def sphere():
    source = vtkSphereSource()
    source.SetThetaResolution(400)
    source.SetPhiResolution(200)
    return run(source)


def torus():
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(vtkParametricTorus())
    source.SetUResolution(400)
    source.SetVResolution(200)
    return run(source)


def gyroid():
    return contour(gyroid_ball(), 0)


def thin_sheets():
    """Ten squares, each a hundredth of its side behind the other and a little smaller."""
    sheets = vtkAppendPolyData()
    for i in range(10):
        half = 0.5 - 0.03 * i
        plane = vtkPlaneSource()
        plane.SetOrigin(-half, -half, 0.01 * i)
        plane.SetPoint1(half, -half, 0.01 * i)
        plane.SetPoint2(-half, half, 0.01 * i)
        plane.SetResolution(20, 20)
        sheets.AddInputConnection(plane.GetOutputPort())
    return run(sheets)


def small_spheres():
    """Ten thousand of them, anywhere in a cube."""
    centers = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.random.default_rng(0).random((10_000, 3), np.float32), deep=True))
    centers.SetPoints(points)
    ball = vtkSphereSource()
    ball.SetRadius(0.012)
    ball.SetThetaResolution(16)
    ball.SetPhiResolution(10)
    glyphs = vtkGlyph3D()
    glyphs.SetInputData(centers)
    glyphs.SetSourceConnection(ball.GetOutputPort())
    glyphs.ScalingOff()
    return run(glyphs)


SCENES = {
    "sphere": sphere,
    "torus": torus,
    "gyroid": gyroid,
    "thin sheets": thin_sheets,
    "small spheres": small_spheres,
}


@dataclass(frozen=True)
class Spread:
    """How points lie on a scene where not evenly on it, or that they have no normals."""

    scene: str
    ratio: float = 1  # of the largest radius to the smallest
    normals: bool = True
    noise: float = 0  # standard deviation along the normal, in mean spacings


# What the rules of vtkPointSurfaceMapperFactory ask for.
SPREADS = {f"sphere, radii 1 to {ratio}": Spread("sphere", ratio) for ratio in (5, 10, 25, 50, 100)}
SPREADS |= {f"{scene}, no normals": Spread(scene, normals=False) for scene in ("sphere", "gyroid")}
SPREADS |= {
    f"{scene}, no normals, noise {noise}": Spread(scene, normals=False, noise=noise)
    for noise in (0.25, 0.5)
    for scene in ("sphere", "gyroid")
}
SPREADS |= {f"sphere, no normals, radii 1 to {ratio}": Spread("sphere", ratio, False) for ratio in (5, 10, 20)}


# ----------------------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Isosurface:
    """A volume, made or read when it is asked for, and the value of its surface."""

    make: object
    value: float
    file: str = ""  # of the folder of models

    def is_there(self):
        return not self.file or os.path.exists(data_path(VOLUMES, self.file))


def _head(file, value):
    return Isosurface(lambda: read(data_path(VOLUMES, file), tell=True), value, file)


ISOSURFACES = {
    "isosurface of a gyroid, 128^3": Isosurface(lambda: gyroid_ball(128), 0),
    "isosurface of a gyroid, 256^3": Isosurface(lambda: gyroid_ball(256), 0),
    "isosurface of a CT head, bone": _head("ct-head-promed0051.vti", 300),
    "isosurface of an MR head": _head("mr-head-colin27-t1.vti", 50.5),
}


def contour(volume, value):
    """The mesh of an isosurface, with normals."""
    edges = vtkFlyingEdges3D()
    edges.SetInputData(volume)
    edges.SetValue(0, value)
    edges.ComputeScalarsOff()
    mesh = run(edges)
    mend_normals(mesh)
    return mesh


# ----------------------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Case:
    """A scene with so many points in a square viewport of so many pixels along a side.

    scene: in SCENES, SPREADS or ISOSURFACES; or a mesh of the folder of models; or a file.
    points: 0 for those that an isosurface has.
    """

    scene: str
    points: int
    pixels: int

    def __str__(self):
        points = f", {self.points} points" if self.points else ""
        return f"{self.scene}{points}, {self.pixels} x {self.pixels}"

    @property
    def title(self):
        """With no folder, for reports that are shown to others."""
        return str(Case(os.path.basename(self.scene), self.points, self.pixels))


def data_path(*names):
    return os.path.join(os.environ.get(DATA_VARIABLE, ""), *names)


def shared_meshes():
    """The names of those in the folder of models."""
    if not os.environ.get(DATA_VARIABLE) or not os.path.isdir(data_path(MESHES)):
        return []
    return sorted(file.removesuffix(".vtp") for file in os.listdir(data_path(MESHES)) if file.endswith(".vtp"))


def make_mesh(name):
    """The triangles of a scene, a shared mesh, or a file with polygons. Raises WrongUse."""
    if name in SCENES:
        mesh = SCENES[name]()
    else:
        mesh = read(data_path(MESHES, f"{name}.vtp") if name in shared_meshes() else name, tell=True)
    if isinstance(mesh, vtkImageData) or mesh.GetNumberOfPolys() + mesh.GetNumberOfStrips() == 0:
        raise WrongUse(f"{name} has no polygons, so that there is no truth to measure with")
    if mesh.GetPointData().GetNormals() is None:
        mesh = with_normals(mesh)
    triangles = vtkTriangleFilter()
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    triangles.SetInputData(mesh)
    return run(triangles)


def make_points(mesh, count, spread):
    """About so many points at random, with normals unless the spread has none, and the array "radius"."""
    # Where radii grow along x as ratio^t, t from 0 to 1, density falls as ratio^(-2t): of an even sample such a share is kept.
    kept = (1 - spread.ratio**-2) / (2 * np.log(spread.ratio)) if spread.ratio > 1 else 1
    cloud = sample_by_area(mesh, round(count / kept))
    data = cloud.GetPointData()
    points, normals, radii = map(vtk_to_numpy, (cloud.GetPoints().GetData(), data.GetNormals(), data.GetArray("radius")))
    radii = radii * RADIUS / 2  # it is twice the mean spacing
    if spread.ratio > 1:
        along = (points[:, 0] - points[:, 0].min()) / np.ptp(points[:, 0])
        chosen = np.random.default_rng(1).random(len(points)) < spread.ratio ** (-2 * along)
        points, normals, radii = points[chosen], normals[chosen], (radii * spread.ratio**along)[chosen]
    if spread.noise:
        shifts = spread.noise / RADIUS * radii * np.random.default_rng(2).standard_normal(len(points))
        points = (points + shifts[:, None] * normals).astype(np.float32)
    return make_cloud(points, normals if spread.normals else None, arrays={"radius": radii.astype(np.float32)})


def run(algorithm):
    algorithm.Update()
    return algorithm.GetOutput()
