# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of a mapper as a guest of VTK share: the mappers, a surface known by formula, scenes, and baselines.

MAPPERS is the one list of mapper classes that have to pass; a new mapper is added here. A mapper that draws something
else than points has an entry in INPUTS, which makes that of a cloud.
"""

import functools
import os
from typing import NamedTuple

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer
from vtkmodules.vtkTestingRendering import vtkTesting

from pointsurface import (
    rendering,
    vtkAlgebraicSplatMapper,
    vtkAlgebraicSplats,
    vtkDirectPointMapper,
    vtkImageSpacePointMapper,
    vtkPullPushMapper,
    vtkSurfaceSplatMapper,
)

MAPPERS = [
    vtkPullPushMapper,
    vtkImageSpacePointMapper,
    vtkDirectPointMapper,
    vtkAlgebraicSplatMapper,
    vtkSurfaceSplatMapper,
]


class Accuracy(NamedTuple):
    """What the picture of a mapper may differ from that of the mesh."""

    factor: float = 1  # on the differences of colours and depths
    beyond: int = 3  # pixels that it may reach over the mesh's outline
    missing: int = 1  # pixels that it may stay within


ACCURACY = {
    vtkPullPushMapper: Accuracy(),
    # a pixel has the normal and the depth of one point beside it
    vtkImageSpacePointMapper: Accuracy(factor=1.3, missing=2),
    # normals are fitted to what falls around a pixel; a splat is three sampling distances wide
    vtkDirectPointMapper: Accuracy(factor=1.5, beyond=4, missing=2),
    # colours are those of a quarter of the points
    vtkAlgebraicSplatMapper: Accuracy(factor=1.4),
    vtkSurfaceSplatMapper: Accuracy(),
}
BACKENDS = ["OpenGL", "CPU"]


def variants(cases):
    """For pytest: "mapper_class, backend, name" of every case by the first mapper and both back ends. The others share
    their way to VTK with it and have tests of their own that both back ends make the same buffer: each case once, by one
    back end and the other in turn."""
    every = [(MAPPERS[0], backend, name) for name in cases for backend in BACKENDS]
    once = [(m, BACKENDS[(i + j) % 2], name) for i, name in enumerate(cases) for j, m in enumerate(MAPPERS[1:])]
    return every + once

BASELINES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data", "Baseline")
OUTPUT = os.environ.get("POINTSURFACE_TEST_OUTPUT", ".")
TUBE = 0.4  # radius of the torus' tube; that of its ring is 1
BOUNDS = (-1 - TUBE, 1 + TUBE, -1 - TUBE, 1 + TUBE, -TUBE, TUBE)  # of the torus


def array(values, name=None, kind=np.float32):
    result = numpy_to_vtk(np.ascontiguousarray(values, kind), deep=True)
    if name:
        result.SetName(name)
    return result


def polydata(points, normals):
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(array(points, kind=np.asarray(points).dtype))
    data.GetPointData().SetNormals(array(normals, "Normals"))
    return data


def even_directions(count):
    """Unit vectors, spread evenly."""
    i = np.arange(count) + 0.5
    z = 1 - 2 * i / count
    around = np.pi * (1 + np.sqrt(5)) * i
    return np.stack([np.sqrt(1 - z * z) * np.cos(around), np.sqrt(1 - z * z) * np.sin(around), z], axis=-1)


def spacing_on_sphere(count):
    """Of so many points, on the unit sphere."""
    return np.sqrt(4 * np.pi / count)


def torus(u, v):
    """Positions and normals at the angles around the ring and around the tube."""
    normals = np.stack([np.cos(u) * np.cos(v), np.sin(u) * np.cos(v), np.sin(v)], axis=-1)
    ring = np.stack([np.cos(u), np.sin(u), np.zeros_like(u)], axis=-1)
    return ring + TUBE * normals, normals


def torus_cloud(count=20000):
    """Even points of the torus with its normals, and radii of 1.5 times their spacing."""
    i = np.arange(1, count + 1)
    u = 2 * np.pi * np.mod(0.7548776662466927 * i, 1)
    share = 2 * np.pi * np.mod(0.5698402909980532 * i, 1)
    v = share.copy()
    for _ in range(20):  # the area up to v is v + TUBE sin v
        v -= (v + TUBE * np.sin(v) - share) / (1 + TUBE * np.cos(v))
    cloud = polydata(*(x.astype(np.float32) for x in torus(u, v)))
    radius = 1.5 * np.sqrt(4 * np.pi**2 * TUBE / count)
    cloud.GetPointData().AddArray(array(np.full(count, radius), "radius"))
    return cloud


def torus_mesh(around_ring=400, around_tube=200):
    u, v = np.meshgrid(
        np.arange(around_ring) * 2 * np.pi / around_ring, np.arange(around_tube) * 2 * np.pi / around_tube, indexing="ij"
    )
    mesh = polydata(*(x.reshape(-1, 3).astype(np.float32) for x in torus(u, v)))
    i, j = (x.ravel() for x in np.indices((around_ring, around_tube)))
    i1, j1 = (i + 1) % around_ring, (j + 1) % around_tube
    corners = np.stack([i, i1, i1, i]), np.stack([j, j, j1, j1])
    quads = (corners[0] * around_tube + corners[1]).T
    cells = vtkCellArray()
    cells.SetData(4, numpy_to_vtk(np.ascontiguousarray(quads, np.int64).ravel(), deep=True))
    mesh.SetPolys(cells)
    return mesh


def splats(cloud):
    """Patches fitted to a cloud, small enough to have the colours of their centres; those that it has, if it has any."""
    if cloud.GetPointData().HasArray("SplatCoefficients"):
        return cloud
    fit = vtkAlgebraicSplats()
    fit.SetInputData(cloud)
    fit.SetNumberOfNeighbors(16)
    fit.SetOrder(2)
    fit.Update()
    return fit.GetOutput()


INPUTS = {vtkAlgebraicSplatMapper: splats}


def input_of(mapper_class, data):
    """What a mapper draws, of a cloud or a mesh."""
    return INPUTS[mapper_class](data) if mapper_class in INPUTS else data


class Scene:
    """One surface in a renderer of its own window, looked at from the side; the camera sees all within the bounds."""

    def __init__(self, mapper_class, data, size=(200, 200), bounds=None):
        self.is_mesh = mapper_class is vtkPolyDataMapper
        self.mapper = mapper_class()
        self.mapper.SetInputData(input_of(mapper_class, data))
        self.actor = vtkActor()
        self.actor.SetMapper(self.mapper)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(0.1, 0.2, 0.3)
        self.renderer.AddActor(self.actor)
        self.window = rendering.offscreen_window(self.renderer, size)
        self.camera = self.renderer.GetActiveCamera()
        self.camera.SetPosition(1.2, -3.0, 2.4)
        self.camera.SetViewUp(0, 0, 1)
        self.renderer.ResetCamera(bounds or data.GetBounds())  # not the mapper's own: those of splats reach farther
        self.camera.Zoom(1.6)

    def add_floor(self):
        """A square below the surface, larger than it; returns its actor."""
        floor = vtkPlaneSource()
        floor.SetOrigin(-2.5, -2.5, -0.6)
        floor.SetPoint1(2.5, -2.5, -0.6)
        floor.SetPoint2(-2.5, 2.5, -0.6)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(floor.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(0.9, 0.8, 0.6)
        self.renderer.AddActor(actor)
        self.renderer.ResetCameraClippingRange()
        return actor

    def color(self):
        """The picture: (height, width, 3), 0 to 1."""
        return rendering.read_color(self.window)

    def depth(self):
        """The depth buffer of the last picture: (height, width), 1 where there is nothing or another renderer."""
        width, height = self.window.GetSize()
        values = vtkFloatArray()
        self.window.GetZbufferData(0, 0, width - 1, height - 1, values)
        depth = np.ones((height, width))
        (left, bottom), (columns, rows) = self.renderer.GetOrigin(), self.renderer.GetSize()
        own = slice(bottom, bottom + rows), slice(left, left + columns)
        depth[own] = vtk_to_numpy(values).reshape(height, width)[own]
        return depth


class Still:
    """What a scene showed."""

    def __init__(self, scene):
        picture, depth = scene.color(), scene.depth()
        self.color, self.depth = lambda: picture, lambda: depth


def torus_scene(mapper_class, prepare, make_data, **options):
    scene = Scene(mapper_class, make_data(), bounds=BOUNDS, **options)
    prepare(scene)
    return scene


def as_it_is(scene):
    pass


@functools.lru_cache(maxsize=None)
def still(mapper_class, prepare=as_it_is, make_data=torus_cloud, **options):
    """What a scene of the torus shows: drawn once, for all who ask."""
    return Still(torus_scene(mapper_class, prepare, make_data, **options))


def cloud_and_mesh(mapper_class, prepare=as_it_is, data=(torus_cloud, torus_mesh), live=False, **options):
    """The scene of the cloud and that of the mesh of the same surface, each prepared alike, by the same camera. Of the mesh
    it is what the scene shows, drawn once for all mappers, if it is not wanted live."""
    cloud = torus_scene(mapper_class, prepare, data[0], **options)
    return cloud, (torus_scene if live else still)(vtkPolyDataMapper, prepare, data[1], **options)


def covered_by_both(cloud, mesh):
    """Pixels in which both scenes, as last drawn, show something."""
    return (cloud.depth() < 1) & (mesh.depth() < 1)


def difference(image, other, mask=None):
    """Mean over the pixels of a mask of the largest difference of a channel, in grey levels of 255."""
    largest = 255 * np.abs(image - other).max(axis=-1)
    return float(largest.mean() if mask is None else largest[mask].mean())


def grow(mask, pixels):
    """A mask with all pixels that are up to so many steps away, diagonal ones included."""
    for _ in range(pixels):
        wide = np.pad(mask, 1)
        mask = np.any([wide[i : i + mask.shape[0], j : j + mask.shape[1]] for i in range(3) for j in range(3)], axis=0)
    return mask


def assert_same_surface(cloud, mesh, mean_difference=3.0, further_beyond=0):
    """The pictures of a cloud and a mesh show the same surface in the same place, lit alike, as accurate as the mapper."""
    accuracy = ACCURACY[type(cloud.mapper)]
    pictures = cloud.color(), mesh.color()
    masks = cloud.depth() < 1, mesh.depth() < 1
    inside = ~grow(~(masks[0] & masks[1]), 1)
    measured = difference(*pictures, inside)
    print(f"mean difference {measured:.3f} over {np.count_nonzero(inside)} pixels")
    assert np.count_nonzero(inside) > 500
    assert not np.any(masks[0] & ~grow(masks[1], accuracy.beyond + further_beyond)), "the cloud is where the mesh is not"
    assert not np.any(masks[1] & ~grow(masks[0], accuracy.missing)), "the cloud has holes"
    assert measured < mean_difference * accuracy.factor


def assert_baseline(window, name, threshold=10):
    """The window shows what the picture Testing/Data/Baseline/`name`.png shows."""
    testing = vtkTesting()
    for argument in ("-T", OUTPUT, "-V", os.path.join(BASELINES, name + ".png")):
        testing.AddArgument(argument)
    testing.SetRenderWindow(window)
    assert testing.RegressionTest(threshold) == vtkTesting.PASSED, f"{name} differs from its baseline"
