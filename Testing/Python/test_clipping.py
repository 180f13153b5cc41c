# SPDX-License-Identifier: BSD-3-Clause
"""Clipping planes cut a cloud where they cut a mesh, and nothing reaches over them."""

import numpy as np
import pytest
from scenes import BACKENDS, MAPPERS, assert_baseline, assert_same_surface, cloud_and_mesh, variants
from vtkmodules.vtkCommonDataModel import vtkPlane

from pointsurface import vtkDirectPointMapper

def plane(origin, normal):
    result = vtkPlane()
    result.SetOrigin(*origin)
    result.SetNormal(*normal)
    return result


BOX = [plane(side * np.array(axis), -side * np.array(axis)) for axis in np.diag([0.9, 1.1, 0.25]) for side in (-1, 1)]
CASES = {
    "one": [plane((0.1, 0, 0), (-1, 0.2, 0.1))],
    "two": [plane((0, 0.2, 0), (0, 1, 0)), plane((0, 0, 0), (-1, 0, 1))],
    "a box": BOX,
    "facing the viewer": [plane((0, 0, 0.1), (0, 0, -1))],
}


def eye_to_world_points(scene):
    """World positions of the surface in each covered pixel, from the depth buffer: (pixels, 3)."""
    depth = scene.depth()
    height, width = depth.shape
    aspect = width / height
    matrix = scene.camera.GetCompositeProjectionTransformMatrix(aspect, -1, 1)
    to_clip = np.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
    y, x = np.nonzero(depth < 1)
    clip = np.stack([2 * (x + 0.5) / width - 1, 2 * (y + 0.5) / height - 1, 2 * depth[y, x] - 1, np.ones(len(x))])
    world = np.linalg.solve(to_clip, clip)
    return (world[:3] / world[3]).T


def cut(planes):
    def prepare(scene):
        for p in planes:
            scene.mapper.AddClippingPlane(p)

    return prepare


def assert_cut(cloud, mesh, planes):
    # slivers of few points are drawn as of a sparser cloud, with cells four times as large
    assert_same_surface(cloud, mesh, further_beyond=4 if isinstance(cloud.mapper, vtkDirectPointMapper) else 0)
    points = eye_to_world_points(cloud)
    assert len(points) > 1000
    for p in planes:
        distance = (points - p.GetOrigin()) @ p.GetNormal() / np.linalg.norm(p.GetNormal())
        assert distance.min() > -2e-3, "the surface reaches over a plane"


@pytest.mark.parametrize("mapper_class, backend, name", variants(CASES))
def test_cut_as_the_mesh(mapper_class, backend, name):
    cloud, mesh = cloud_and_mesh(mapper_class, cut(CASES[name]))
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    assert_cut(cloud, mesh, CASES[name])


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_moved_turned_and_stretched(mapper_class, backend):
    """Planes are of the world, whatever the actor does; the eye's frame may be another than the view's."""

    def prepare(scene):
        cut(CASES["two"])(scene)
        scene.actor.SetScale(1.1, 0.8, 1.2)
        scene.actor.RotateX(25)
        scene.actor.SetPosition(0.1, 0.2, 0)
        scene.camera.ParallelProjectionOn()
        scene.camera.SetPosition(0.2, -0.5, 0.4)
        scene.camera.SetFocalPoint(0, 0, 0)
        scene.camera.SetParallelScale(1.4)
        scene.camera.SetClippingRange(-3, 3)

    cloud, mesh = cloud_and_mesh(mapper_class, prepare)
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    assert_cut(cloud, mesh, CASES["two"])


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_a_plane_that_moves_or_goes(mapper_class):
    cloud, mesh = cloud_and_mesh(mapper_class, live=True)
    whole = cloud.color()
    moving = plane((0, 0, 0), (1, 0, 0))
    for scene in (cloud, mesh):
        scene.mapper.AddClippingPlane(moving)
    assert_cut(cloud, mesh, [moving])
    moving.SetOrigin(0.5, 0, 0)
    assert_cut(cloud, mesh, [moving])
    cloud.mapper.RemoveAllClippingPlanes()
    assert np.array_equal(cloud.color(), whole)


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_picture(mapper_class):
    cloud, _ = cloud_and_mesh(mapper_class, cut(BOX))
    cloud.color()
    assert_baseline(cloud.window, f"Clipping-{mapper_class.__name__}")
