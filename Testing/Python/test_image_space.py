# SPDX-License-Identifier: BSD-3-Clause
"""Image-space points, up to two pixels apart: nearly no pixel stays open, outlines stay in place, and cost
falls with need."""

import os

import numpy as np
import pytest
from scenes import BACKENDS, Scene
from vtkmodules.vtkFiltersCore import vtkMassProperties
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

from pointsurface import sampling, vtkImageSpacePointMapper

DATA = os.environ.get("POINTSURFACE_SHARED_DATA", "")
SIZE = (400, 400)


def read(name):
    path = os.path.join(DATA, f"meshes/{name}.vtp")
    if not DATA or not os.path.exists(path):
        pytest.skip("../shared/data is absent")
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def pixel_of(scene):
    """The width of a pixel at the camera's focal point, in world units."""
    camera = scene.camera
    return 2 * camera.GetDistance() * np.tan(np.radians(camera.GetViewAngle() / 2)) / SIZE[1]


def scenes_of(mesh, spacing):
    """A cloud whose points project so many pixels apart, and its mesh."""
    area = vtkMassProperties()
    area.SetInputData(mesh)
    reference = Scene(vtkPolyDataMapper, mesh, SIZE)
    cloud = sampling.sample_by_area(mesh, int(area.GetSurfaceArea() / (spacing * pixel_of(reference)) ** 2))
    points = Scene(vtkImageSpacePointMapper, cloud, SIZE)
    points.camera.DeepCopy(reference.camera)
    points.actor.GetProperty().BackfaceCullingOn()
    return points, reference


def compare(points, reference):
    """The share of the silhouette that is open, and the intersection over union."""
    mask, truth = points.depth() < 1, reference.depth() < 1
    return np.count_nonzero(truth & ~mask) / np.count_nonzero(truth), np.count_nonzero(mask & truth) / np.count_nonzero(
        mask | truth
    )


@pytest.mark.parametrize("spacing", [1.4, 2.0])
@pytest.mark.parametrize("name", ["dragon", "buddha", "armadillo"])
def test_no_more_than_one_pixel_in_a_thousand_is_open(name, spacing):
    """With the radii that the cloud comes with, and with radii of 1.5 times the distance between points."""
    points, reference = scenes_of(read(name), spacing)
    points.color(), reference.color()
    unfilled, overlap = compare(points, reference)
    points.mapper.FillWithinDiscsOff()
    points.color()
    before = compare(points, reference)
    print(f"{name}, {spacing}: {unfilled:.3%} open, overlap {overlap:.4f}; by masks alone {before[0]:.3%}, {before[1]:.4f}")
    assert unfilled < 0.001
    assert overlap > max(0.975, before[1] - 0.005)
    assert before[0] > 2 * unfilled

    points.mapper.FillWithinDiscsOn()
    points.mapper.SetRadiusArray(None)
    points.mapper.SetRadius(1.5 * spacing * pixel_of(reference))
    points.color()
    unfilled, overlap = compare(points, reference)
    print(f"{name}, {spacing}, radii of 1.5 spacings: {unfilled:.3%} open, overlap {overlap:.4f}")
    assert unfilled < 0.001 and overlap > 0.97


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("axis", [(0, 0, 1), (1, 0, 0)], ids=["pole", "equator"])
@pytest.mark.parametrize("resolution", [100, 200])
def test_no_cross_on_a_regular_sphere_seen_along_an_axis(resolution, axis, backend):
    """Gaps between rows of points that run along the picture's axes are open to the outline, where the masks look for the
    surface: by masks alone they stay, as a dark cross. Within discs they are filled, with the surface's light."""
    source = vtkSphereSource()
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    source.Update()
    points, mesh = (Scene(kind, source.GetOutput(), (200, 200)) for kind in (vtkImageSpacePointMapper, vtkPolyDataMapper))
    getattr(points.mapper, f"SetBackendTo{backend}")()
    points.actor.GetProperty().BackfaceCullingOn()
    points.camera.SetFocalPoint(0, 0, 0)
    points.camera.SetPosition(*axis)
    points.camera.SetViewUp(0, 1, 0)
    points.renderer.ResetCamera()
    points.camera.Zoom(1.5)
    mesh.camera.DeepCopy(points.camera)
    y, x = np.indices((200, 200)) - 99.5
    inside = np.hypot(x, y) < 75
    truth = mesh.color()
    assert (mesh.depth()[inside] < 1).all()
    for radius in (0, 1.5 * np.pi / resolution):  # estimated; of 1.5 times the distance along the equator
        points.mapper.SetRadius(radius)
        color = points.color()
        assert (points.depth()[inside] < 1).all()
        assert np.abs(color - truth)[inside].max() < 0.05
    points.mapper.FillWithinDiscsOff()
    points.mapper.SetRadius(0)
    points.color()
    cross = inside & (points.depth() >= 1)
    assert np.count_nonzero(cross) > 10
    if axis == (0, 0, 1):
        assert (np.minimum(np.abs(x), np.abs(y))[cross] < 6).all(), "a cross"


def test_cost_falls_with_need():
    """Ever more points: ever fewer iterations, and none when no hole is left."""
    iterations = []
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(200)
    sphere.SetPhiResolution(200)
    sphere.Update()
    for spacing in (2.0, 1.0, 0.2):
        points, _ = scenes_of(sphere.GetOutput(), spacing)
        points.mapper.FillWithinDiscsOff()
        points.color()
        iterations.append(points.mapper.GetLastFrameBackgroundFills() + points.mapper.GetLastFrameOccludedFills())
    print(iterations)
    assert iterations[0] > iterations[1] > iterations[2] == 0
