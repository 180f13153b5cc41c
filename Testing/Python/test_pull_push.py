# SPDX-License-Identifier: BSD-3-Clause
"""vtkPullPushMapper: what its departures from the paper promise, by both back ends, beside the true surface."""

import functools

import numpy as np
import pytest
from scenes import BACKENDS, Scene, array, polydata, torus, torus_cloud, torus_mesh
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkProperty

from pointsurface import metrics, truth, vtkPullPushMapper

SIZE = (300, 300)


def draw(data, backend, size=SIZE, zoom=1, **properties):
    """A scene after one frame, and a metrics.SurfaceImage of what it shows."""
    scene = Scene(vtkPullPushMapper, data, size)
    scene.camera.Zoom(zoom)
    getattr(scene.mapper, f"SetBackendTo{backend}")()
    for name, value in properties.items():
        getattr(scene.mapper, f"Set{name}")(value)
    color = scene.color()
    buffer = vtkImageData()
    assert scene.mapper.ReadSurfaceBuffer(buffer)
    layers = buffer.GetPointData()
    normals = vtk_to_numpy(layers.GetArray("Normals")).reshape(*size[::-1], 3).astype(float)
    depth = vtk_to_numpy(layers.GetArray("Depth")).reshape(size[::-1]).astype(float)
    return scene, metrics.SurfaceImage(color, normals, depth)


def draw_truth(scene):
    return truth.render_truth(torus_mesh(), scene.renderer, vtkProperty(), scene.window.GetSize())


def get_outline_shift(mask, true_mask):
    """How far outlines lie outside of the true ones, in pixels, on average."""
    steps = sum(np.count_nonzero(np.diff(true_mask.astype(int), axis=axis)) for axis in (0, 1))
    return (np.count_nonzero(mask) - np.count_nonzero(true_mask)) / (np.pi / 4 * steps)


@pytest.mark.parametrize("backend", BACKENDS)
def test_outlines_are_trimmed(backend):
    """Outlines lie about where the surface's do: what is left is how far a disc reaches over what is curved."""
    images = {}
    for trimmed in (True, False):
        scene, images[trimmed] = draw(torus_cloud(80_000), backend, TrimOutlines=trimmed)
    expected = draw_truth(scene).mask
    shifts = {trimmed: get_outline_shift(image.mask, expected) for trimmed, image in images.items()}
    assert metrics.unfilled_share(images[True].mask, expected) < 1e-3
    print(f"outlines {shifts[True]:.2f} pixels too far out, {shifts[False]:.2f} where they are not trimmed")
    assert abs(shifts[True]) < 0.3
    assert shifts[False] > shifts[True] + 0.15


# Where each departure from the paper helps: its name, the cloud, how far the view is zoomed in, the factor on radii, the
# measure of the error that tells, and what it is at most with the departure, as a multiple of what it is without.
DEPARTURES = [
    ("SubpixelCenters", "even", 20_000, 1, 1, "depth", 0.5),
    ("PerspectiveDiscs", "even", 20_000, 1, 1, "depth", 0.25),
    ("PerspectiveDiscs", "even", 20_000, 1, 1, "outline", 0.75),
    ("DistanceWeights", "even", 20_000, 3, 1, "normal_mean", 0.85),
    ("UnionRadii", "even", 80_000, 1, 0.4, "depth", 0.85),  # of less than two pixels
    ("FillPixels", "random", 80_000, 1, 1, "unfilled", 0.25),
    ("DepthTestInPush", "random", 10_000, 3, 1, "wrong_depth", 0.3),
]


@functools.lru_cache(maxsize=None)
def make_cloud(kind, count):
    return {"even": torus_cloud, "random": random_cloud}[kind](count)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("name, kind, count, zoom, scale, measure, factor", DEPARTURES)
def test_each_departure_helps(backend, name, kind, count, zoom, scale, measure, factor):
    """The error against the torus is larger with one departure off alone: it does something, and for the better."""
    errors = {}
    for on in (True, False):
        scene, image = draw(make_cloud(kind, count), backend, zoom=zoom, RadiusScale=scale, **{name: on})
        measured = metrics.compare(image, draw_truth(scene), diagonal=3.2)
        errors[on] = 1 - measured["iou"] if measure == "outline" else measured[measure]
    print(f"{measure} {errors[True]:.5f}, {errors[False]:.5f} without {name}")
    assert 0 < errors[True] < factor * errors[False]


@pytest.mark.parametrize("backend", BACKENDS)
def test_which_radius_counts(backend):
    """The named array, else the constant, else the array "radius"."""
    cloud = torus_cloud(2000)
    cloud.GetPointData().AddArray(array(np.full(2000, 0.03), "size"))
    own = cloud.GetPointData().GetArray("radius").GetValue(0)
    for properties, expected in (
        (dict(), own),
        (dict(Radius=0.02), 0.02),
        (dict(RadiusArray="size"), 0.03),
        (dict(RadiusArray="size", Radius=0.02), 0.03),
    ):
        scene, _ = draw(cloud, backend, (100, 100), **properties)
        buffer = vtkImageData()
        assert scene.mapper.ReadProjectedBuffer(buffer)
        radii = vtk_to_numpy(buffer.GetPointData().GetArray("Radius"))
        assert radii[radii > 0] == pytest.approx(expected, rel=1e-5)
    cloud.GetPointData().GetArray("radius").Fill(1e30)
    cloud.GetPointData().GetArray("radius").SetValue(0, own)
    scene = Scene(vtkPullPushMapper, cloud, (100, 100))
    scene.mapper.SetBackend(getattr(vtkPullPushMapper, backend))
    said = []
    scene.mapper.AddObserver("WarningEvent", lambda *_: said.append(1))
    scene.color()
    assert scene.mapper.ReadProjectedBuffer(buffer) and said == [1]
    radii = vtk_to_numpy(buffer.GetPointData().GetArray("Radius"))
    assert radii.max() == pytest.approx(cloud.GetLength(), rel=1e-5), "none is larger than the cloud"


def random_cloud(count):
    """Points of the torus at random, with radii of 1.5 times their mean spacing."""
    angles = 2 * np.pi * np.random.default_rng(0).random((4 * count, 3))
    keep = 2 * np.pi * (1 + 0.4 * np.cos(angles[:, 1])) > 1.4 * angles[:, 2]
    u, v, _ = angles[keep][:count].T
    cloud = polydata(*(x.astype(np.float32) for x in torus(u, v)))
    cloud.GetPointData().AddArray(array(np.full(count, 1.5 * np.sqrt(4 * np.pi**2 * 0.4 / count)), "radius"))
    return cloud


@pytest.mark.parametrize("backend", BACKENDS)
def test_outlines_of_dense_clouds(backend):
    """Several points in a pixel tell on which side of its centre an outline is."""
    psnr = {}
    for trimmed in (True, False):
        scene, image = draw(random_cloud(200_000), backend, (100, 100), TrimOutlines=trimmed)
        psnr[trimmed] = metrics.psnr(image.color, draw_truth(scene).color)
    print(f"PSNR {psnr[True]:.2f}, {psnr[False]:.2f} where outlines are not trimmed")
    assert psnr[True] > psnr[False] + 2


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("covered", (0.3, 0.7))
def test_inner_outlines_of_dense_clouds(backend, covered):
    """A pixel that a surface in front covers in part shows it, or what is behind, as its centre does."""
    half, spacing = 30, 0.25  # pixels
    grid = np.arange(-half, half, spacing) + spacing / 2
    x, y = (c.ravel() for c in np.meshgrid(grid, grid))
    front, back = np.stack([x, y, 0 * x], axis=1)[x < covered], np.stack([x, y, 0 * x - 10], axis=1)
    points = np.vstack([front, back]).astype(np.float32)
    cloud = polydata(points, np.tile(np.float32([0, 0, 1]), (len(points), 1)))
    depths = {}
    for trimmed in (True, False):
        scene = Scene(vtkPullPushMapper, cloud, (2 * half, 2 * half))
        scene.mapper.SetRadius(1.5 * spacing)
        scene.mapper.ThinPointsOff()
        scene.mapper.SetTrimOutlines(trimmed)
        getattr(scene.mapper, f"SetBackendTo{backend}")()
        scene.camera.SetParallelProjection(True)
        scene.camera.SetParallelScale(half)
        scene.camera.SetFocalPoint(0, 0, 0)
        scene.camera.SetPosition(0, 0, 100)
        scene.camera.SetViewUp(0, 1, 0)
        scene.renderer.ResetCameraClippingRange()
        scene.window.Render()
        buffer = vtkImageData()
        assert scene.mapper.ReadSurfaceBuffer(buffer)
        depth = vtk_to_numpy(buffer.GetPointData().GetArray("Depth")).reshape(2 * half, 2 * half)
        depths[trimmed] = depth[2:-2, half - 1 : half + 2]  # to the left of the pixel with the edge, it, to the right
    print(f"depths {depths[True].mean(axis=0)}, {depths[False].mean(axis=0)} where outlines are not trimmed")
    assert np.allclose(depths[True], [100, 100 if covered > 0.5 else 110, 110], atol=0.5)
    assert np.allclose(depths[False][:, 1], 100, atol=0.5)


@pytest.mark.parametrize("backend", BACKENDS)
def test_thinning(backend):
    """Points beyond what pixels can tell apart are not drawn, and not missed."""
    count = 800_000
    data = random_cloud(count)
    images = {}
    for thinned in (True, False):
        scene, images[thinned] = draw(data, backend, (200, 200), ThinPoints=thinned)
        assert (scene.mapper.GetLastFramePointsDrawn() == count) != thinned
    expected = draw_truth(scene)
    measured = {thinned: metrics.compare(image, expected, 3.2) for thinned, image in images.items()}
    print(f"PSNR {measured[True]['psnr']:.2f}, {measured[False]['psnr']:.2f} with all points")
    # much of a picture as small as this is near an outline, and outlines are told by the points in their pixels
    assert measured[True]["psnr"] > measured[False]["psnr"] - 1
    assert measured[True]["unfilled"] < 1e-3


def balls(count):
    """Points at random on 25 small balls beside each other, with radii of 1.5 times the mean spacing."""
    random = np.random.default_rng(2)
    normals = random.normal(size=(count, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    centers = np.append(random.integers(-2, 3, (count, 2)) * 0.4, np.zeros((count, 1)), axis=1)
    cloud = polydata(centers + 0.15 * normals, normals)
    spacing = np.sqrt(25 * 4 * np.pi * 0.15**2 / count)
    cloud.GetPointData().AddArray(array(np.full(count, 1.5 * spacing), "radius"))
    return cloud


@pytest.mark.parametrize("backend", BACKENDS)
def test_backs_give_way(backend):
    """Of what is about as fine as its points the front is seen, not the back at outlines and through gaps."""
    _, image = draw(balls(3000), backend)
    towards_viewer = image.normals[..., 2][image.mask]
    backs = np.mean(towards_viewer < -0.3)
    print(f"backs in {100 * backs:.2f}% of the pixels, normals {towards_viewer.mean():.3f} towards the viewer")
    assert backs < 0.013
    assert towards_viewer.mean() == pytest.approx(2 / 3, abs=0.01)  # of a ball


@pytest.mark.parametrize("backend", BACKENDS)
def test_normals_to_either_side(backend):
    """Those of a pixel's points are averaged as if all were turned as the nearest one's is."""
    cloud = random_cloud(100_000)
    vtk_to_numpy(cloud.GetPointData().GetNormals())[::2] *= -1
    scene, image = draw(cloud, backend, (100, 100), ThinPoints=False)
    psnr = metrics.psnr(image.color, draw_truth(scene).color)
    print(f"PSNR {psnr:.2f}")
    assert psnr > 30


@pytest.mark.parametrize("backend", BACKENDS)
def test_blending(backend):
    """Where points are dense a pixel shows what is around its own points, too: noise of normals is averaged."""
    cloud = random_cloud(40_000)
    normals = vtk_to_numpy(cloud.GetPointData().GetNormals())
    normals += np.random.default_rng(1).normal(0, 0.1, normals.shape).astype(np.float32)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    errors = {}
    for blended in (True, False):
        scene, image = draw(cloud, backend, (100, 100), BlendPixels=blended)
        errors[blended] = metrics.compare(image, draw_truth(scene), 3.2)["normal_mean"]
    print(f"normals {errors[True]:.2f} degrees off, {errors[False]:.2f} where pixels are not blended")
    assert errors[True] < 0.85 * errors[False]
