# SPDX-License-Identifier: BSD-3-Clause
"""Image-space points, up to two pixels apart: nearly no pixel stays open, outlines stay in place, and cost falls with need."""

import os

import numpy as np
import pytest
from scenes import Scene
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


def scenes_of(mesh, spacing):
    """A cloud whose points project so many pixels apart, and its mesh."""
    area = vtkMassProperties()
    area.SetInputData(mesh)
    reference = Scene(vtkPolyDataMapper, mesh, SIZE)
    camera = reference.camera
    pixel = 2 * camera.GetDistance() * np.tan(np.radians(camera.GetViewAngle() / 2)) / SIZE[1]
    cloud = sampling.sample_by_area(mesh, int(area.GetSurfaceArea() / (spacing * pixel) ** 2))
    points = Scene(vtkImageSpacePointMapper, cloud, SIZE)
    points.camera.DeepCopy(camera)
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
