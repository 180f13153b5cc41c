# SPDX-License-Identifier: BSD-3-Clause
"""vtkSurfaceSplatMapper beside its double-precision reference, its back ends beside each other, and what it promises."""

import os
import sys

import numpy as np
import pytest
from scenes import (
    Scene,
    array,
    assert_baseline,
    even_directions,
    polydata,
    spacing_on_sphere,
    torus,
    torus_cloud,
    torus_mesh,
)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet, vtkPlane
from vtkmodules.vtkRenderingCore import vtkActor, vtkProperty, vtkRenderer, vtkRenderWindow
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass

from pointsurface import metrics, truth, vtkPointSurfacePass, vtkPullPushMapper, vtkSurfaceSplatMapper

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Reference"))
from surface_splats import Options, draw_surface_splats  # noqa: E402

BACKENDS = ["CPU", "OpenGL"]
DIFFERING_SHARE = 1e-3
TOLERANCE = 1e-4


def spheres(count, seed=7):
    """Two spheres at random points, one partly before the other, with scalars and a radius for each point."""
    random = np.random.default_rng(seed)
    normals = random.normal(size=(count, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    size = np.where(np.arange(count) % 2, 1.0, 0.5)[:, None]
    shift = np.where(np.arange(count) % 2, 0.0, 1.1)[:, None] * (0.4, 0.2, 1.0)
    tilted = normals + 0.1 * random.normal(size=(count, 3))
    data = polydata((normals * size + shift).astype(np.float32), tilted)
    radii = 1.5 * np.sqrt(8 * np.pi / count) * random.uniform(0.8, 1.2, count)
    data.GetPointData().AddArray(array(radii, "radius"))
    data.GetPointData().SetScalars(array(normals[:, 1], "height"))
    return data


def values(data, name, kind=float):
    return vtk_to_numpy(data.GetPointData().GetArray(name)).astype(kind)


def surface(mapper):
    """The surface buffer's arrays by name, (height, width) or (height, width, components)."""
    image = vtkImageData()
    assert mapper.ReadSurfaceBuffer(image)
    width, height, _ = image.GetDimensions()
    data = image.GetPointData()
    layers = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    return {name: layer.reshape(height, width, *layer.shape[1:]) for name, layer in layers.items()}


def rows(matrix):
    return np.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])


class Frame:
    """A mapper after one frame, and its camera."""

    def __init__(self, data, size, backend, parallel=False, zoom=1.5, culling=False, colors=False, clip=False, **properties):
        scene = Scene(vtkSurfaceSplatMapper, data, size)
        self.scene, self.mapper, self.data = scene, scene.mapper, data
        self.mapper.SetBackend(getattr(vtkSurfaceSplatMapper, backend))
        self.mapper.SetScalarVisibility(colors)
        self.mapper.SetScalarRange(-1, 1)
        self.mapper.RecordPointIdsOn()
        if clip:
            plane = vtkPlane()
            plane.SetNormal(-0.8, 0.6, 0)
            self.mapper.AddClippingPlane(plane)
        for name, value in properties.items():
            getattr(self.mapper, f"Set{name}")(value)
        scene.actor.GetProperty().SetBackfaceCulling(culling)
        scene.camera.SetParallelProjection(parallel)
        scene.renderer.ResetCamera()
        scene.camera.Zoom(zoom)
        scene.renderer.ResetCameraClippingRange()
        scene.window.Render()
        assert self.mapper.GetLastFrameBackend() == getattr(vtkSurfaceSplatMapper, backend)

    def expected(self, options):
        camera, size = self.scene.camera, self.scene.window.GetSize()
        data = self.data
        colors = None
        if self.mapper.GetScalarVisibility():
            colors = vtk_to_numpy(self.mapper.MapScalars(1)).astype(float) / 255
        points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
        return draw_surface_splats(
            points, values(data, "Normals"), values(data, "radius"), rows(camera.GetViewTransformMatrix()),
            rows(camera.GetProjectionTransformMatrix(size[0] / size[1], -1, 1)), size, colors, options,
        )  # fmt: skip


SCENES = [
    dict(count=4000, size=(160, 120)),
    dict(count=4000, size=(160, 120), parallel=True, colors=True),
    dict(count=4000, size=(161, 97), culling=True),
    dict(count=3000, size=(97, 133), zoom=6, colors=True),
    dict(count=4000, size=(150, 150), BlendRadius=1.0, DepthTolerance=0.5),
    dict(count=4000, size=(150, 150), BlendRadius=2.0),
    dict(count=900, size=(3, 2)),
    dict(count=900, size=(1, 1)),
]


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("scene", SCENES, ids=str)
def test_agreement(scene, backend):
    scene = dict(scene)
    frame = Frame(spheres(scene.pop("count")), backend=backend, **scene)
    expected = frame.expected(
        Options(
            frame.mapper.GetBlendRadius(),
            frame.mapper.GetDepthTolerance(),
            scene.get("culling", False),
        )
    )
    drawn = surface(frame.mapper)
    covered = (expected.depth > 0) | (drawn["Depth"] > 0)
    near = expected.near_decision & covered
    differs = covered & (((expected.depth > 0) != (drawn["Depth"] > 0)) | (expected.ids != drawn["PointIds"]))
    same = covered & ~near & ~differs
    worst = {
        "normal": np.abs(expected.normals - drawn["Normals"])[same].max(initial=0),
        "depth": (np.abs(expected.depth - drawn["Depth"])[same] / expected.depth[same]).max(initial=0),
    }
    if expected.colors is not None:
        worst["color"] = np.abs(expected.colors - drawn["Colors"])[same].max(initial=0)
    print(
        f"covered {covered.sum()}, near a decision {near.sum()} ({(near & differs).sum()} differing), "
        f"differing {(differs & ~near).sum()}, worst {worst}"
    )
    assert covered.sum() >= 0.1 * covered.size
    assert near.sum() <= max(1, 0.05 * covered.sum())
    assert (differs & ~near).sum() <= DIFFERING_SHARE * covered.sum()
    assert all(difference <= TOLERANCE for difference in worst.values())


@pytest.mark.parametrize("mapper_class", [vtkSurfaceSplatMapper, vtkPullPushMapper])
def test_a_frame_shows_nothing_of_earlier_ones(mapper_class):
    """What is made anew is what is covered, and what shading reads beside it; the rest is of frames long ago."""
    near, far = [(azimuth, 15) for azimuth in range(4)], [(azimuth, 60) for azimuth in range(0, 180, 45)]

    def make_scene():
        scene = Scene(mapper_class, spheres(900), (160, 120))
        scene.mapper.SetBackendToCPU()
        scene.mapper.RecordPointIdsOn()
        scene.mapper.SetRadiusScale(2)  # so that pull-push has normals that point away beside outlines
        return scene

    def show(scene, azimuth, angle):
        scene.camera.SetPosition(3, 0, 2)
        scene.camera.Azimuth(azimuth)
        scene.camera.SetViewAngle(angle)
        scene.renderer.ResetCameraClippingRange()
        return scene.color()

    one = make_scene()
    for view in near + far:
        fresh = make_scene()
        assert (show(one, *view) == show(fresh, *view)).all()
        assert one.mapper.GetLastFrameReconstructions() == 1
        expected = surface(fresh.mapper)
        assert all((layer == expected[name]).all() for name, layer in surface(one.mapper).items())
        pixels = one.mapper.GetLastFrameSurfaceBytesUploaded() / 36
        covered, rectangle = (expected["Depth"] > 0).sum(), np.prod(one.mapper.GetLastFrameRectangle()[2:])
        assert covered <= pixels and (view in near or pixels <= 0.9 * rectangle)


BACKEND_SCENES = [
    dict(),
    dict(parallel=True, colors=True),
    dict(culling=True),
    dict(zoom=8),
    dict(Supersampling=2, colors=True),
    dict(count=400_000),  # thinned
    dict(RadiusScale=0.3),  # gaps all over
    dict(RadiusScale=3, clip=True),  # by a plane that large discs reach over from beyond
]


@pytest.mark.parametrize("scene", BACKEND_SCENES, ids=str)
def test_back_ends_make_the_same_picture(scene):
    scene = dict(scene)
    data = spheres(scene.pop("count", 20000))
    pictures = [255 * Frame(data, (300, 240), backend, **scene).scene.color() for backend in BACKENDS]
    differences = np.abs(pictures[0] - pictures[1]).max(axis=-1)
    print(f"mean {differences.mean():.4f}, over 8 grey levels {np.mean(differences > 8):.5f}")
    assert differences.mean() < 0.2
    assert np.mean(differences > 8) <= 1e-3
    assert np.ptp(pictures[0]) > 30


def test_any_number_of_threads_makes_the_same():
    def draw(backend, threads):
        if not vtkSMPTools.SetBackend(backend):
            return None
        vtkSMPTools.Initialize(threads)
        frame = Frame(spheres(30000), (200, 160), "CPU", colors=True)
        return surface(frame.mapper)

    usual = vtkSMPTools.GetBackend()
    try:
        results = [draw(backend, threads) for backend in ("Sequential", "STDThread", "TBB") for threads in (1, 2, 4)]
    finally:
        vtkSMPTools.SetBackend(usual)
        vtkSMPTools.Initialize()
    results = [result for result in results if result]
    assert len(results) >= 3
    for other in results[1:]:
        assert all(np.array_equal(results[0][name], other[name]) for name in other)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_gap_in_the_front_is_closed(backend):
    """With margins of splats the far side of a sphere is not seen through its near one."""
    frame = Frame(spheres(30000), (200, 160), backend, RadiusScale=0.8)
    shares = []
    for blend_radius in (1, 1.5):
        frame.mapper.SetBlendRadius(blend_radius)
        frame.scene.window.Render()
        drawn = surface(frame.mapper)
        shares.append(np.mean(drawn["Normals"][drawn["Depth"] > 0, 2] < -0.3))
    print(f"backs seen without margins {shares[0]:.5f}, with them {shares[1]:.5f}")
    assert shares[0] > 0.005 and shares[1] < 0.1 * shares[0]


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_back_before_the_front_is_seen(backend):
    """A sheet seen from behind, half as wide as the one behind it, which is seen from the front."""
    x, y = (side.ravel() for side in np.meshgrid(np.linspace(-1, 1, 100), np.linspace(-1, 1, 100)))
    far = np.stack([x, y, 0 * x], axis=-1)
    near = [0.5, 0.5, 0] * far + [0, 0, 0.5]
    normals = np.repeat([[0.0, 0, 1], [0, 0, -1]], len(far), axis=0)
    frame = Frame(polydata(np.concatenate([far, near]), normals), (160, 160), backend, True, Radius=0.03)
    frame.scene.camera.SetPosition(0, 0, 5)
    frame.scene.camera.SetFocalPoint(0, 0, 0)
    frame.scene.camera.SetViewUp(0, 1, 0)
    frame.scene.renderer.ResetCamera()
    frame.scene.window.Render()
    drawn = surface(frame.mapper)
    covered, backs = drawn["Depth"] > 0, drawn["Normals"][..., 2] < -0.9
    share = backs.sum() / covered.sum()
    print(f"back seen in {share:.4f} of the pixels")
    assert abs(share - 0.25) < 0.01, "half as wide: a quarter"
    assert np.allclose(drawn["Depth"][covered & ~backs].min() - drawn["Depth"][backs], 0.5, atol=1e-3)


def cloud_of_torus(count, seed=3):
    """Random points of the torus, radii of 1.5 times their spacing."""
    random = np.random.default_rng(seed)
    u, v = 2 * np.pi * random.random((2, 3 * count))
    kept = np.flatnonzero(random.random(3 * count) < (1 + 0.4 * np.cos(v)) / 1.4)[:count]
    assert len(kept) == count
    cloud = polydata(*(x.astype(np.float32) for x in torus(u[kept], v[kept])))
    cloud.GetPointData().AddArray(array(np.full(count, 1.5 * np.sqrt(4 * np.pi**2 * 0.4 / count)), "radius"))
    return cloud


def errors(mapper_class, data, size=(300, 300), **properties):
    scene = Scene(mapper_class, data, size)
    scene.camera.Zoom(0.8)
    for name, value in properties.items():
        getattr(scene.mapper, f"Set{name}")(value)
    color = scene.color()
    drawn = surface(scene.mapper)
    expected = truth.render_truth(torus_mesh(), scene.renderer, vtkProperty(), size)
    image = metrics.SurfaceImage(color, drawn["Normals"].astype(float), drawn["Depth"].astype(float))
    return metrics.compare(image, expected, 3.2), scene


def test_errors_are_below_those_of_pull_push():
    data = cloud_of_torus(40000)
    (splats, _), (pulled, _) = (errors(mapper, data) for mapper in (vtkSurfaceSplatMapper, vtkPullPushMapper))
    print(f"PSNR {splats['psnr']:.2f}, pull-push {pulled['psnr']:.2f}; normals {splats['normal_mean']:.2f} degrees")
    assert splats["psnr"] > pulled["psnr"] + 1
    assert splats["normal_mean"] < pulled["normal_mean"]
    assert splats["unfilled"] < 1e-3


def test_thinning():
    """Points beyond what pixels can tell apart are not drawn, and not missed."""
    data = cloud_of_torus(600_000)
    (thinned, scene), (full, whole) = (
        errors(vtkSurfaceSplatMapper, data, (160, 160), ThinPoints=on) for on in (True, False)
    )
    drawn = scene.mapper.GetLastFramePointsDrawn()
    assert whole.mapper.GetLastFramePointsDrawn() == 600_000
    assert drawn < 0.2 * 600_000
    print(f"PSNR {thinned['psnr']:.2f} with {drawn} points, {full['psnr']:.2f} with all")
    assert thinned["psnr"] > full["psnr"] - 1.5
    assert thinned["unfilled"] < 1e-3
    scene.camera.Zoom(10)
    scene.window.Render()
    zoomed = scene.mapper.GetLastFramePointsDrawn()
    scene.mapper.ThinPointsOff()
    scene.window.Render()
    assert 0 < zoomed == scene.mapper.GetLastFramePointsDrawn() < 600_000, "only what is outside is left out"


@pytest.mark.parametrize("backend", BACKENDS)
def test_thinned_points_are_means(backend, capfd):
    """Normals that err by 20 degrees and colours that are black or white: with groups of several points the picture is
    nearly as even as with all of them."""
    random = np.random.default_rng(3)
    count = 400_000
    points = np.append(random.uniform(-1, 1, (count, 2)), np.zeros((count, 1)), axis=1)
    normals = np.append(np.tan(np.radians(20)) * random.normal(size=(count, 2)) / 2**0.5, np.ones((count, 1)), axis=1)
    cloud = polydata(points, normals)
    cloud.GetPointData().AddArray(array(np.full(count, 1.5 * (4 / count) ** 0.5), "radius"))
    white = np.repeat(255 * random.integers(0, 2, (count, 1)), 3, axis=1).astype(np.uint8)
    cloud.GetPointData().SetScalars(array(white, "colors"))
    spread = {}
    for thinned in (True, False):
        scene = Scene(vtkSurfaceSplatMapper, cloud, (100, 100))
        scene.mapper.SetBackend(getattr(vtkSurfaceSplatMapper, backend))
        scene.mapper.SetThinPoints(thinned)
        scene.camera.SetPosition(0, 0, 5)
        scene.renderer.ResetCamera()
        scene.window.Render()
        drawn = scene.mapper.GetLastFramePointsDrawn()
        assert drawn < count / 8 if thinned else drawn == count
        layers = surface(scene.mapper)
        inner = np.s_[30:70, 30:70]
        spread[thinned] = layers["Normals"][inner][..., :2].std(), layers["Colors"][inner][..., 0].std()
        assert layers["Colors"][inner][..., 0].mean() == pytest.approx(0.5, abs=0.02)
    assert "ERR|" not in capfd.readouterr().err
    print(f"spread of normals, colours {spread[True]}, {spread[False]} of all points")
    # one of so many points alone would spread as many times as the root of their number
    assert np.all(np.array(spread[True]) < 1.6 * np.array(spread[False]))


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("culling", [False, True])
def test_thinning_leaves_out_no_surface(backend, culling):
    """Two sheets with normals apart, in each pixel many points of both: each stays whole, in its place."""
    random = np.random.default_rng(4)
    count = 300_000
    side = np.where(np.arange(count) % 2, 1, -1)
    points = np.column_stack([random.uniform(-1, 1, (count, 2)), 1e-4 * side])
    cloud = polydata(points, np.column_stack([np.zeros((count, 2)), side]))
    cloud.GetPointData().AddArray(array(np.full(count, 1.5 * (8 / count) ** 0.5), "radius"))
    scene = Scene(vtkSurfaceSplatMapper, cloud, (90, 90))
    scene.mapper.SetBackend(getattr(vtkSurfaceSplatMapper, backend))
    scene.actor.GetProperty().SetBackfaceCulling(culling)
    for z in (5, -5):
        scene.camera.SetPosition(0, 0, z)
        scene.renderer.ResetCamera()
        scene.window.Render()
        assert scene.mapper.GetLastFramePointsDrawn() < count / 6
        layers = surface(scene.mapper)
        inner = np.s_[25:65, 25:65]
        assert np.all(layers["Depth"][inner] > 0)
        assert np.all(layers["Normals"][inner][..., 2] > 0.99)
        distance = scene.camera.GetDistance()
        assert np.allclose(layers["Depth"][inner], distance - 1e-4, atol=2e-5)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("thinned", [False, True])
def test_texture_coordinates_in_bytes_are_no_colours(backend, thinned):
    cloud = torus_cloud(100_000)
    cloud.GetPointData().SetTCoords(array(np.tile((1, 2), (100_000, 1)), "coordinates", np.uint8))
    scene = Scene(vtkSurfaceSplatMapper, cloud, (60, 60))
    scene.mapper.SetBackend(getattr(vtkSurfaceSplatMapper, backend))
    scene.mapper.SetThinPoints(thinned)
    scene.window.Render()
    assert (scene.mapper.GetLastFramePointsDrawn() < 50_000) == thinned
    layers = surface(scene.mapper)
    assert np.allclose(layers["Colors"][layers["Depth"] > 0][:, :2], (1, 2), atol=1e-4)


@pytest.mark.parametrize("backend", BACKENDS)
def test_clouds_of_a_joint_surface_are_thinned_by_their_own_density(backend):
    """A sparse one, whose points pixels tell apart, is drawn whole beside a dense one, as it is alone."""
    window, renderer = vtkRenderWindow(), vtkRenderer()
    window.SetOffScreenRendering(True)
    window.SetSize(320, 160)
    window.AddRenderer(renderer)
    mappers, buffers = [], []
    for count, x in ((5000, 0), (300_000, 2.2)):
        directions = even_directions(count)
        cloud = polydata(directions + (x, 0, 0), directions)
        cloud.GetPointData().AddArray(array(np.full(count, 1.5 * spacing_on_sphere(count)), "radius"))
        mappers.append(vtkSurfaceSplatMapper())
        mappers[-1].SetBackend(getattr(vtkSurfaceSplatMapper, backend))
        mappers[-1].SetInputData(cloud)
        actor = vtkActor()
        actor.SetMapper(mappers[-1])
        renderer.AddActor(actor)
    sparse, dense = mappers
    renderer.ResetCamera()
    for joint in (False, True):
        if joint:
            steps, surfaces = vtkRenderStepsPass(), vtkPointSurfacePass()
            steps.SetOpaquePass(surfaces)
            renderer.SetPass(steps)
        window.Render()
        assert sparse.GetLastFramePointsDrawn() == 5000
        assert 1000 < dense.GetLastFramePointsDrawn() < 50_000
        buffers.append(surface(sparse)["Normals"][:, :150])
    assert surfaces.GetLastFrameJointClouds() == 2
    assert np.allclose(*buffers, atol=1e-5)
    if backend == "OpenGL":
        dense.SetRadiusScale(0.5)  # larger groups
        window.Render()
        assert dense.GetLastFrameBytesUploaded() == 32 * dense.GetLastFramePointsDrawn(), "of the cloud that they are of"
        assert sparse.GetLastFrameBytesUploaded() == 0


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_copies_of_thinned_points(kind):
    """They are of the blocks that are shown, by any size of groups, and made anew of points that move."""
    data = spheres(150_001)
    arrays = vtk_to_numpy(data.GetPoints().GetData()).astype(kind), values(data, "Normals"), values(data, "radius")
    tree = vtkMultiBlockDataSet()
    ends = (0, 50_001, 100_003, 150_001)  # odd: pairs of points reach over where blocks end
    for number, (begin, end) in enumerate(zip(ends, ends[1:])):
        points, normals, radii = (each[begin:end] for each in arrays)
        hidden = number == 1  # before the others, so that none of its points is drawn unseen
        block = polydata((points + hidden * np.array((-0.4, 0, 0.2))).astype(kind), normals)
        block.GetPointData().AddArray(array(radii, "radius"))
        tree.SetBlock(number, block)

    def draw(scene, angle, distance=8):
        scene.camera.SetPosition(distance * np.sin(angle), 0.5, distance * np.cos(angle))
        scene.renderer.ResetCameraClippingRange()
        scene.window.Render()
        return surface(scene.mapper)

    def make_scene():
        scene = Scene(vtkSurfaceSplatMapper, tree, (90, 80), data.GetBounds())
        scene.mapper.SetBackendToCPU()
        scene.mapper.RecordPointIdsOn()
        scene.mapper.SetBlockVisibility(2, False)
        return scene

    def assert_same(a, b):
        assert all(np.array_equal(a[name], b[name]) for name in a)

    scene = make_scene()
    first = draw(scene, 0)
    drawn = scene.mapper.GetLastFramePointsDrawn()
    assert 0 < drawn < 60_000, "thinned"
    ids = first["PointIds"][first["PointIds"] >= 0]
    assert not np.any((ids >= ends[1]) & (ids < ends[2])), "a hidden block's point"
    others = [draw(scene, angle, 16) for angle in (0.1, 0.2, 0.3, 0.4)]  # as many views as are kept
    assert scene.mapper.GetLastFramePointsDrawn() < drawn
    assert_same(draw(scene, 0), first)
    assert scene.mapper.GetLastFrameReconstructions() == 1
    assert not np.array_equal(others[0]["Depth"], first["Depth"])

    moved = tree.GetBlock(0)
    vtk_to_numpy(moved.GetPoints().GetData())[:] *= 0.9
    moved.GetPoints().Modified()
    moved.Modified()
    again = draw(scene, 0)
    assert not np.array_equal(again["Depth"], first["Depth"])
    assert_same(again, draw(make_scene(), 0))


def test_statistics():
    for backend, passes in (("CPU", 2), ("OpenGL", 4)):
        frame = Frame(spheres(5000), (200, 150), backend)
        mapper = frame.mapper
        assert mapper.GetLastFramePointsDrawn() == 5000
        assert mapper.GetLastFramePasses() == passes  # with ids
        assert mapper.GetLastFrameReconstructions() == 1
        assert mapper.GetLastFrameProjectMilliseconds() > 0
        assert mapper.GetLastFrameReconstructMilliseconds() > 0


def test_baseline():
    """The torus, closed and lit, and what of it covers the mesh's silhouette."""
    measured, scene = errors(vtkSurfaceSplatMapper, torus_cloud(20000))
    assert measured["iou"] > 0.98 and measured["unfilled"] < 1e-3
    assert_baseline(scene.window, "SurfaceSplats")
