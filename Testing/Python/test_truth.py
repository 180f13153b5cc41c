# SPDX-License-Identifier: BSD-3-Clause
"""The truth drawn from a mesh against a sphere known by formula."""

import math

import numpy as np
import pytest
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkLight, vtkProperty, vtkRenderer

import pointsurface  # noqa: F401  makes a window without a display
from pointsurface.truth import render_truth, sample_depth

SIZE = (96, 64)
CENTER = np.array([3.0, -2.0, 1.0])
RADIUS = 0.8


def fine_sphere():
    sphere = vtkSphereSource()
    sphere.SetCenter(*CENTER)
    sphere.SetRadius(RADIUS)
    sphere.SetThetaResolution(360)
    sphere.SetPhiResolution(180)
    sphere.SetOutputPointsPrecision(1)
    sphere.Update()
    return sphere.GetOutput()


def renderer_with_camera(parallel):
    renderer = vtkRenderer()
    renderer.SetBackground(0.1, 0.2, 0.3)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(CENTER + (1.5, 2.0, 2.5))
    camera.SetFocalPoint(CENTER + (0.1, 0.0, 0.2))
    camera.SetViewUp(0.2, 1.0, 0.3)
    camera.SetViewAngle(35)
    camera.SetParallelProjection(parallel)
    camera.SetParallelScale(1.0)
    return renderer


def analytic_sphere(camera, size=SIZE):
    """Eye-space normals, depth, and the cosine between normal and ray at the pixels' centres; 0 outside of the sphere."""
    width, height = size
    view = np.array([[camera.GetViewTransformMatrix().GetElement(i, j) for j in range(4)] for i in range(4)])
    center = view[:3, :3] @ CENTER + view[:3, 3]
    x = ((np.arange(width) + 0.5) / width * 2 - 1) * width / height
    y = (np.arange(height) + 0.5) / height * 2 - 1
    x, y = np.meshgrid(x, y)
    zero = np.zeros_like(x)
    if camera.GetParallelProjection():
        origin = np.stack([x, y, zero], -1) * camera.GetParallelScale()
        direction = np.stack([zero, zero, zero - 1], -1)
    else:
        slope = math.tan(math.radians(camera.GetViewAngle()) / 2)
        origin = np.zeros((*x.shape, 3))
        direction = np.stack([x * slope, y * slope, zero - 1], -1)
    offset = origin - center
    a, b = (direction**2).sum(-1), (direction * offset).sum(-1)
    root = b**2 - a * ((offset**2).sum(-1) - RADIUS**2)
    hit = root > 0
    t = np.where(hit, (-b - np.sqrt(np.where(hit, root, 0))) / a, 0)
    normals = (origin + t[..., None] * direction - center) / RADIUS
    cosine = -(normals * direction).sum(-1) / np.sqrt(a)
    return np.where(hit[..., None], normals, 0), t, np.where(hit, cosine, 0)


@pytest.mark.parametrize("parallel", [False, True])
def test_sphere(parallel):
    renderer = renderer_with_camera(parallel)
    truth = render_truth(fine_sphere(), renderer, vtkProperty(), SIZE)
    normals, depth, cosine = analytic_sphere(renderer.GetActiveCamera())
    # A pixel's centre may fall between the circle and the polygon that stands for it.
    assert np.count_nonzero(truth.mask ^ (depth > 0)) <= 4
    both = truth.mask & (depth > 0)
    assert np.count_nonzero(both) > 800
    assert np.allclose(np.linalg.norm(truth.normals[both], axis=-1), 1, atol=1e-6)
    assert np.all(truth.normals[~truth.mask] == 0)

    inner = both & (cosine > 0.2)
    # The facets are up to 1.2e-4 below the sphere, times 1 / 0.2 where it is seen at an angle.
    assert np.abs(truth.depth - depth)[inner].max() < 7e-4
    assert np.abs(truth.normals - normals)[inner].max() < 2e-3


def test_samples_of_depth():
    renderer = renderer_with_camera(parallel=False)
    samples = sample_depth(fine_sphere(), renderer, SIZE, 4)
    assert samples.shape == (SIZE[1], SIZE[0], 4, 4)
    _, depth, cosine = analytic_sphere(renderer.GetActiveCamera(), (4 * SIZE[0], 4 * SIZE[1]))
    for up, aside in np.ndindex(4, 4):
        inner = cosine[up::4, aside::4] > 0.2
        assert np.count_nonzero(inner) > 700
        assert np.abs(samples[..., up, aside] - depth[up::4, aside::4])[inner].max() < 7e-4
    assert np.all(samples[0, 0] == 0)


def test_color_is_lit_and_supersampled():
    renderer = renderer_with_camera(parallel=False)
    light = vtkLight()
    light.SetLightTypeToCameraLight()
    light.SetPosition(0, 0, 1)
    light.SetFocalPoint(0, 0, 0)
    renderer.AddLight(light)
    matte = vtkProperty()
    matte.SetColor(1, 0.5, 0.25)
    truth = render_truth(fine_sphere(), renderer, matte, SIZE)
    normals, depth, cosine = analytic_sphere(renderer.GetActiveCamera())
    inner = cosine > 0.4
    # VTK's diffuse light from the viewer's direction is the normal's z; in steps of 1/255 and averaged over a pixel.
    assert np.abs(truth.color[..., 0] - normals[..., 2])[inner].max() < 0.03
    assert np.abs(truth.color[..., 0] - normals[..., 2])[inner].mean() < 0.003
    assert np.allclose(truth.color[0, 0], (0.1, 0.2, 0.3), atol=0.5 / 255 + 1e-9)
    # On the silhouette 16 samples give shares of the background that one sample cannot.
    single = render_truth(fine_sphere(), renderer, matte, SIZE, supersampling=1)
    assert np.abs(truth.color - single.color).max() > 0.1


def test_normals_on_the_back_keep_their_orientation():
    plane = vtkPlaneSource()
    plane.SetOrigin(-1, -1, 0)
    plane.SetPoint1(1, -1, 0)
    plane.SetPoint2(-1, 1, 0)
    plane.SetNormal(0, 0, 1)
    plane.Update()
    for side in (1, -1):
        renderer = vtkRenderer()
        renderer.GetActiveCamera().SetPosition(0, 0, 5 * side)
        renderer.GetActiveCamera().SetFocalPoint(0, 0, 0)
        truth = render_truth(plane.GetOutput(), renderer, vtkProperty(), SIZE)
        assert np.allclose(truth.normals[truth.mask], (0, 0, side), atol=1e-6)
        assert np.allclose(truth.depth[truth.mask], 5, atol=1e-5)
        assert np.count_nonzero(truth.mask) > 500


def test_mesh_without_polygons_or_normals():
    with pytest.raises(ValueError, match="no polygons"):
        render_truth(vtkPolyData(), renderer_with_camera(False), vtkProperty(), SIZE)
    bare = vtkPolyData()
    bare.DeepCopy(fine_sphere())
    bare.GetPointData().SetNormals(None)
    for name in [bare.GetPointData().GetArrayName(i) for i in range(bare.GetPointData().GetNumberOfArrays())]:
        bare.GetPointData().RemoveArray(name)
    with pytest.raises(ValueError, match="no point normals"):
        render_truth(bare, renderer_with_camera(False), vtkProperty(), SIZE)
