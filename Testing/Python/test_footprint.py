# SPDX-License-Identifier: BSD-3-Clause
"""A point is a round disc in the world, so its footprint is that of a round polygon, whatever a camera's transforms and
screens make of it."""

import numpy as np
import pytest
from scenes import Scene, array, polydata
from test_geometry import CASES
from vtkmodules.vtkFiltersSources import vtkRegularPolygonSource
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

from pointsurface import vtkAlgebraicSplatMapper, vtkPullPushMapper

NORMAL = np.array([0.3, -0.8, 0.5])
NORMAL /= np.linalg.norm(NORMAL)
RADIUS = 0.8
NAMES = [
    "turned view",
    "oblique view",
    "sheared picture",
    "sheared picture, parallel",
    "sheared view",
    "sheared view, parallel",
    "turned and stretched picture",
    "off-axis",
    "off-axis, a slanted screen",
    "left eye",
]


def point():
    cloud = polydata([[0.0, 0.0, 0.0]], [NORMAL])
    cloud.GetPointData().AddArray(array([RADIUS], "radius"))
    return cloud


def splat():
    """The same disc as an algebraic splat, a plane."""
    cloud = point()
    side = np.cross(NORMAL, [1.0, 0.0, 0.0])
    cloud.GetPointData().AddArray(array([side / np.linalg.norm(side)], "SplatAxes"))
    cloud.GetPointData().AddArray(array([[0.0, 0.0, 0.0]], "SplatCoefficients"))
    cloud.GetPointData().AddArray(array([1], "SplatOrder", np.uint8))
    cloud.GetPointData().AddArray(array([RADIUS], "FeatureSize"))
    return cloud


def polygon():
    source = vtkRegularPolygonSource()
    source.SetNumberOfSides(200)
    source.SetRadius(RADIUS)
    source.SetNormal(*NORMAL)
    source.Update()
    return source.GetOutput()


@pytest.mark.parametrize("backend", ["OpenGL", "CPU"])
@pytest.mark.parametrize("mapper_class, make", [(vtkPullPushMapper, point), (vtkAlgebraicSplatMapper, splat)])
@pytest.mark.parametrize("name", NAMES)
def test_footprint_of_a_disc(mapper_class, make, backend, name):
    masks = []
    for maker, data in ((mapper_class, make()), (vtkPolyDataMapper, polygon())):
        scene = Scene(maker, data)
        if not scene.is_mesh:
            getattr(scene.mapper, f"SetBackendTo{backend}")()
        scene.camera.SetPosition(1.2, -3.0, 2.4)  # not by bounds, which are the disc's or its centre's
        scene.camera.SetFocalPoint(0, 0, 0)
        scene.camera.SetViewAngle(30)
        scene.camera.SetParallelScale(1.2)
        scene.camera.SetClippingRange(0.5, 20)
        CASES[name](scene)
        scene.color()
        masks.append(scene.depth() < 1)
    both, either = (np.count_nonzero(op(*masks)) for op in (np.logical_and, np.logical_or))
    print(f"{name}: {both} pixels of {either}")
    assert both > 2000
    assert both > 0.98 * either
