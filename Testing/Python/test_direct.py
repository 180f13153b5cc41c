# SPDX-License-Identifier: BSD-3-Clause
"""vtkDirectPointMapper: bare positions as a lit surface, beside meshes of the same surfaces."""

import os

import numpy as np
import pytest
from scenes import Scene, array, difference, torus, torus_mesh
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkPlane, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkHardwareSelector,
    vtkPolyDataMapper,
    vtkProperty,
    vtkRenderer,
)

from pointsurface import metrics, rendering, truth, vtkDirectPointMapper

TUBE = 0.4
AREA = 4 * np.pi**2 * TUBE  # of the torus
DATA = os.environ.get("POINTSURFACE_SHARED_DATA", "")
SCANS = {  # the share of the picture that shows a surface, at least
    "room-lidar": 0.02,
    "table-mug-stereo-rgb": 0.05,
    "office-kinect-rgb": 0.05,
    "terrain-utm-csite2": 0.1,
}


def positions(points):
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(array(points, kind=np.asarray(points).dtype))
    return data


def bare_torus(count=20000, noise=0.0, seed=1, dense_side=1.0):
    """Random points of the torus and nothing else, moved along the normal by `noise` spacings.

    dense_side: how many times denser the points are at angle pi around the ring than at angle 0.
    """
    random = np.random.default_rng(seed)
    u = 2 * np.pi * random.random(8 * count)
    v = 2 * np.pi * random.random(8 * count)
    density = dense_side ** ((1 - np.cos(u)) / 2) / max(1, dense_side) * (1 + TUBE * np.cos(v)) / (1 + TUBE)
    kept = np.flatnonzero(random.random(8 * count) < density)[:count]
    assert len(kept) == count
    points, normals = torus(u[kept], v[kept])
    spacing = np.sqrt(AREA / count)
    return positions((points + normals * noise * spacing * random.normal(size=(count, 1))).astype(np.float32))


def arrays(mapper):
    image = vtkImageData()
    assert mapper.ReadSurfaceBuffer(image)
    width, height, _ = image.GetDimensions()
    data = image.GetPointData()
    return [vtk_to_numpy(data.GetArray(name)).reshape(height, width, -1) for name in ("Normals", "Depth")]


def compare(cloud, prepare=lambda mapper: None, size=(300, 300)):
    """The errors of a cloud of the torus beside the mesh, from above at an angle."""
    scene = Scene(vtkDirectPointMapper, cloud, size)
    scene.camera.Zoom(0.75)
    prepare(scene.mapper)
    color = scene.color()
    normals, depth = arrays(scene.mapper)
    expected = truth.render_truth(torus_mesh(), scene.renderer, vtkProperty(), size)
    return metrics.compare(metrics.SurfaceImage(color, normals, depth[..., 0]), expected, 3.2)


def cells_along(mapper):
    """How many world units a cell of the image buffer is in a parallel view."""
    image = vtkImageData()
    assert mapper.ReadImageBuffer(image, vtkImageData())
    projection = vtk_to_numpy(image.GetFieldData().GetArray("Projection")).reshape(4, 4)
    return 2 / projection[1, 1] / mapper.GetLastFrameImageSize()[1]


def draw(data, prepare=lambda mapper: None, size=(400, 400), length=1.0, units=1.0):
    """A mapper after one frame in parallel projection, `length` units high about the origin."""
    mapper = vtkDirectPointMapper()
    mapper.SetInputData(data)
    prepare(mapper)
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(length / 2)
    camera.SetPosition(0, 0, 5 * units)
    renderer.ResetCameraClippingRange()
    window = rendering.offscreen_window(renderer, size)
    window.Render()
    mapper.window = window  # lives as long as the mapper
    return mapper


def grid(step=0.02, count=40):
    """A flat grid around the origin with a step between neighbours."""
    x, y = np.meshgrid(np.arange(count) - count / 2, np.arange(count) - count / 2)
    return step * np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)


def test_sampling_distance():
    points = grid()
    twins = np.r_[points, points]
    assert cells_along(draw(positions(twins))) == pytest.approx(0.02, rel=0.02)
    near_pair = np.r_[twins, points[:1] + (0.005, 0, 0)]
    assert cells_along(draw(positions(near_pair))) == pytest.approx(0.02, rel=0.02)
    least = draw(positions(near_pair), lambda m: m.SetSamplingQuantile(0))
    assert cells_along(least) == pytest.approx(0.005, rel=0.02)
    given = draw(positions(twins), lambda m: (m.SetRadius(0.05), m.SetRadiusScale(2)))
    assert cells_along(given) == pytest.approx(0.1, rel=0.05)
    # half of the points four times as far apart: the upper part of the distances counts
    mixed = np.r_[points, grid(0.08, 40) + (0, 0, 1)]
    assert cells_along(draw(positions(mixed))) == pytest.approx(0.08, rel=0.05)


def test_nothing_is_estimated_but_the_sampling_distance():
    """Once for each cloud, whatever changes besides."""
    texts = []

    def watch(mapper):
        mapper.AddObserver("ProgressEvent", lambda *_: texts.append(mapper.GetProgressText()))

    mapper = draw(positions(grid()), watch)
    assert set(texts) - {None} == {"Estimating the sampling distance", "Ordering points"}
    count = len(texts) - texts.count(None)
    mapper.SetDepthTolerance(0.01)
    mapper.window.Render()
    assert mapper.GetLastFrameReconstructions() == 1
    assert len(texts) - texts.count(None) == count


def test_an_aborted_estimate_is_made_in_the_next_frame():
    texts = []

    def abort(mapper):
        mapper.AddObserver("WarningEvent", lambda *_: texts.append("warning"))
        mapper.tag = mapper.AddObserver("ProgressEvent", lambda *_: mapper.AbortExecuteOn())

    mapper = draw(positions(grid()), abort)
    assert texts == ["warning"]
    assert cells_along(mapper) < 0.01, "single pixels"
    mapper.RemoveObserver(mapper.tag)
    mapper.window.Render()
    assert texts == ["warning"]
    assert cells_along(mapper) == pytest.approx(0.02, rel=0.02)


def test_resolution_depends_on_the_points_alone():
    """Not on units, another actor, or the clipping range; the paper's equations do."""

    def shape(units, clipping, published):
        scene = Scene(vtkDirectPointMapper, positions(units * grid()), (300, 200))
        scene.mapper.SetPublishedResolution(published)
        scene.camera.SetPosition(0, 0, 0.7 * units)
        scene.camera.SetFocalPoint(0, 0, 0)
        scene.camera.SetViewUp(0, 1, 0)
        scene.camera.SetClippingRange(units * clipping[0], units * clipping[1])
        other = vtkSphereSource()
        other.SetRadius(0.001 * units)
        mapper, actor = vtkPolyDataMapper(), vtkActor()
        mapper.SetInputConnection(other.GetOutputPort())
        actor.SetMapper(mapper)
        scene.renderer.AddActor(actor)
        scene.window.Render()
        return tuple(scene.mapper.GetLastFrameImageSize())

    first = shape(1, (0.5, 1), False)
    assert 10 < first[0] < 200
    assert shape(1000, (0.5, 1), False) == first
    assert shape(1, (0.01, 10), False) == first
    assert shape(1, (0.5, 1), True) != shape(1, (0.1, 10), True)
    assert shape(1, (0.5, 1), True) != shape(1000, (0.5, 1), True)


@pytest.mark.parametrize("noise, normals, iou", [(0, 2.5, 0.94), (0.5, 7, 0.88), (1, 12, 0.8)])
def test_error(noise, normals, iou):
    """Normals in degrees; every pixel filled; the farthest points help."""
    errors = compare(bare_torus(noise=noise))
    print(errors)
    assert errors["normal_mean"] < normals
    assert errors["unfilled"] < 0.001
    assert errors["iou"] > iou
    if noise > 0.5:
        return  # beyond the tolerance of this small cloud, the farthest points add nothing
    nearest_only = compare(bare_torus(noise=noise), lambda m: m.FarthestPointsOff())
    assert errors["normal_mean"] < nearest_only["normal_mean"]


def test_density():
    """Ten times denser on one side than on the other."""
    errors = compare(bare_torus(dense_side=10))
    even = compare(bare_torus())
    rigid = compare(bare_torus(dense_side=10), lambda m: m.AdaptiveResolutionOff())
    print(errors, even, rigid)
    assert errors["unfilled"] <= 0.005
    assert errors["normal_mean"] <= 1.5 * even["normal_mean"]
    assert rigid["unfilled"] > 2 * errors["unfilled"]  # or there was nothing to remedy


def changes(scene, move, frames=60):
    """Mean difference of neighbouring frames, in grey levels."""
    pictures = []
    for _ in range(frames):
        pictures.append(scene.color())
        move(scene.camera)
        scene.renderer.ResetCameraClippingRange()
    return np.mean([difference(a, b) for a, b in zip(pictures, pictures[1:])])


def test_zoom_does_not_pop():
    mesh = changes(Scene(vtkPolyDataMapper, torus_mesh()), lambda camera: camera.Zoom(1.01))
    cloud = changes(Scene(vtkDirectPointMapper, bare_torus()), lambda camera: camera.Zoom(1.01))
    print(f"mesh {mesh:.3f}, cloud {cloud:.3f}")
    assert cloud <= 1.5 * mesh


def test_orbit_does_not_flicker():
    def turn(camera):
        camera.Elevation(0.5)

    mesh = changes(Scene(vtkPolyDataMapper, torus_mesh()), turn, 20)
    remedied = changes(Scene(vtkDirectPointMapper, bare_torus()), turn, 20)
    scene = Scene(vtkDirectPointMapper, bare_torus())
    scene.mapper.WeightedNormalsOff()
    plain = changes(scene, turn, 20)
    print(f"mesh {mesh:.3f}, weighted normals {remedied:.3f}, without {plain:.3f}")
    assert remedied <= 2 * mesh
    assert plain > 2 * remedied


def test_back_ends_agree():
    pictures = []
    for backend in ("CPU", "OpenGL"):
        scene = Scene(vtkDirectPointMapper, bare_torus(dense_side=10), (203, 151))
        getattr(scene.mapper, f"SetBackendTo{backend}")()
        pictures.append(scene.color())
        assert scene.mapper.GetLastFrameBackend() == getattr(vtkDirectPointMapper, backend)
    assert difference(*pictures) < 0.05
    assert np.mean(np.abs(pictures[0] - pictures[1]).max(axis=-1) > 4 / 255) < 0.002


@pytest.mark.parametrize("backend", ["CPU", "OpenGL"])
def test_shading_before_splatting(backend):
    """Light is nearly the same as on mean normals; what else VTK does with a surface is the same."""
    depths, pictures, cells = [], [], []
    for early in (False, True):
        scene = Scene(vtkDirectPointMapper, bare_torus(5000), (120, 90))
        getattr(scene.mapper, f"SetBackendTo{backend}")()
        scene.mapper.SetShadeBeforeSplatting(early)
        scene.mapper.SetSupersampling(2)
        scene.mapper.AddClippingPlane(vtkPlane())
        scene.mapper.GetClippingPlanes().GetItem(0).SetNormal(0.8, 0, 0.6)
        scene.actor.GetProperty().SetDiffuse(0.6)
        scene.actor.GetProperty().SetSpecular(0.3)
        pictures.append(scene.color())
        depths.append(scene.depth())
        selector = vtkHardwareSelector()
        selector.SetRenderer(scene.renderer)
        selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_POINTS)
        selector.SetArea(0, 0, 119, 89)
        cells.append(vtk_to_numpy(selector.Select().GetNode(0).GetSelectionList()).copy())
        scene.renderer.SetUseDepthPeeling(True)  # takes colours apart from depths
        scene.actor.GetProperty().SetOpacity(0.5)
        pictures.append(scene.color())
    assert np.array_equal(*depths)
    assert np.array_equal(*cells) and len(cells[0]) > 300
    for opaque_or_not in (0, 1):
        assert 0.05 < difference(pictures[opaque_or_not], pictures[2 + opaque_or_not], depths[0] < 1) < 3
    # half of the light, before the background
    background = np.array((0.1, 0.2, 0.3))
    for picture, half in (pictures[:2], pictures[2:]):
        assert difference(half, 0.5 * (picture + background), depths[0] < 1) < 2


@pytest.mark.parametrize("points", [1, 2, 3])
def test_few_points(points):
    mapper = draw(positions(0.1 * np.eye(3)[:points]))
    normals, depth = arrays(mapper)
    assert np.count_nonzero(depth) >= 1
    assert np.allclose(np.linalg.norm(normals[depth[..., 0] > 0], axis=-1), 1, atol=1e-5)


@pytest.mark.parametrize("backend", ["CPU", "OpenGL"])
def test_twins_alone(backend):
    mapper = draw(positions(np.zeros((100, 3))), lambda m: getattr(m, f"SetBackendTo{backend}")())
    assert np.count_nonzero(arrays(mapper)[1]) >= 1


@pytest.mark.parametrize("name", SCANS)
def test_scan(name):
    """One line of code, no parameter set."""
    path = os.path.join(DATA, "scans", name + ".vtp")
    if not DATA or not os.path.exists(path):
        pytest.skip("../shared/data is absent")
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    scene = Scene(vtkDirectPointMapper, reader.GetOutput(), (400, 300))
    warnings = []
    scene.mapper.AddObserver("WarningEvent", lambda *_: warnings.append(1))
    scene.camera.SetFocalPoint(*scene.actor.GetCenter())
    scene.renderer.ResetCamera()
    color = scene.color()
    normals, depth = arrays(scene.mapper)
    covered = depth[..., 0] > 0
    assert len(warnings) == (1 if "rgb" in name else 0)  # of the points that are not finite
    assert covered.mean() > SCANS[name]
    assert np.all(np.isfinite(normals)) and np.all(np.isfinite(depth))
    # closed: few pixels are empty amid others
    inside = covered[:, :-2] & covered[:, 2:]
    assert np.mean(~covered[:, 1:-1][inside]) < 0.01
    # lit: neither flat nor noise; scans with colours show them
    assert color[covered].std() > 0.02
    assert ("rgb" in name) == bool(np.ptp(color[covered], axis=-1).max() > 0.1)
