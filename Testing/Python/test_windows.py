# SPDX-License-Identifier: BSD-3-Clause
"""A cloud in windows of all kinds: viewports, several renderers, several windows, tiles, samples, layers."""

import functools

import numpy as np
import pytest
from scenes import (
    BACKENDS,
    MAPPERS,
    Scene,
    assert_baseline,
    assert_same_surface,
    cloud_and_mesh,
    difference,
    grow,
    torus_cloud,
    variants,
)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkHardwareSelector, vtkPolyDataMapper, vtkRenderer

from pointsurface import rendering, vtkDirectPointMapper, vtkPullPushMapper, vtkSurfaceSplatMapper


def scene_of(mapper_class, backend="CPU", size=(200, 200)):
    scene = Scene(mapper_class, torus_cloud(), size)
    getattr(scene.mapper, f"SetBackendTo{backend}")()
    return scene


@functools.lru_cache(maxsize=None)
def within(viewport):
    return lambda scene: scene.renderer.SetViewport(*viewport)


VIEWPORTS = [(0.13, 0.21, 0.77, 0.9), (0.5, 0, 1, 0.5), (0, 0.5, 0.33, 1)]


@pytest.mark.parametrize("mapper_class, backend, viewport", variants(VIEWPORTS))
def test_viewport(mapper_class, backend, viewport):
    cloud, mesh = cloud_and_mesh(mapper_class, within(viewport), size=(350, 300))
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    assert_same_surface(cloud, mesh)


@pytest.mark.parametrize("mapper_class", MAPPERS)
@pytest.mark.parametrize("backend", BACKENDS)
def test_one_mapper_in_several_renderers(mapper_class, backend):
    """Four views of one actor: each shows what a window of its own would show, and a still frame makes nothing."""
    scene = scene_of(mapper_class, backend, (301, 299))
    quarters = [(0, 0, 0.5, 0.5), (0.5, 0, 1, 0.5), (0, 0.5, 0.5, 1), (0.5, 0.5, 1, 1)]
    renderers = [scene.renderer, *(vtkRenderer() for _ in quarters[1:])]
    for i, (renderer, quarter) in enumerate(zip(renderers, quarters)):
        renderer.SetViewport(*quarter)
        renderer.SetBackground(0.1, 0.2, 0.3)
        if i > 0:
            renderer.AddActor(scene.actor)
            renderer.GetActiveCamera().DeepCopy(scene.camera)
            scene.window.AddRenderer(renderer)
        renderer.GetActiveCamera().Azimuth(40 * i)
        renderer.ResetCameraClippingRange()
    scene.color()
    together = scene.color()
    assert scene.mapper.GetLastFrameReconstructions() == 0, "each view is made once and kept"
    for renderer in renderers:
        for other in renderers:
            other.SetDraw(other is renderer)
        alone = scene.color()
        x, y = renderer.GetOrigin()
        width, height = renderer.GetSize()
        inside = slice(y, y + height), slice(x, x + width)
        assert np.array_equal(together[inside], alone[inside])
        assert alone[inside].std() > 0.05


@pytest.mark.parametrize("mapper_class", MAPPERS)
@pytest.mark.parametrize("backend", BACKENDS)
def test_one_mapper_in_two_windows(mapper_class, backend):
    """VTK moves a mapper's resources to the window that draws it; the picture is the same as ever."""
    first, second = (scene_of(mapper_class, backend, size) for size in [(200, 200), (160, 240)])
    expected = first.color(), second.color()
    second.renderer.RemoveActor(second.actor)
    second.renderer.AddActor(first.actor)
    for _ in range(2):
        assert np.array_equal(first.color(), expected[0])
        assert np.array_equal(second.color(), expected[1])


@pytest.mark.parametrize("mapper_class, backend, scale", variants([2, 3]))
def test_tiles(mapper_class, backend, scale):
    """A picture made of tiles is that of a window of that size; at the seams no more than elsewhere differs."""
    small = scene_of(mapper_class, backend, (150, 120))
    large = scene_of(mapper_class, backend, (150 * scale, 120 * scale))
    large.camera.DeepCopy(small.camera)
    tiled = rendering.read_color(small.window, scale)
    whole = large.color()
    assert tiled.shape == whole.shape
    wrong = np.abs(tiled - whole).max(axis=-1) > 16 / 255
    # cells that points are gathered in are laid over each tile anew, which shows along outlines
    assert wrong.mean() < (0.02 if mapper_class is vtkDirectPointMapper else 0.004)
    for i in range(1, scale):
        for seam in (wrong[:, 150 * i - 1 : 150 * i + 1], wrong[120 * i - 1 : 120 * i + 1]):
            assert seam.mean() < 0.05


@pytest.mark.parametrize("mapper_class", MAPPERS)
@pytest.mark.parametrize("backend", BACKENDS)
def test_resize(mapper_class, backend):
    scene = scene_of(mapper_class, backend)
    first = scene.color()
    for size in [(400, 300), (37, 201), (1, 1), (200, 200)]:
        scene.window.SetSize(*size)
        fresh = scene_of(mapper_class, backend, size)
        fresh.camera.DeepCopy(scene.camera)
        assert np.array_equal(scene.color(), fresh.color())
    assert np.array_equal(scene.color(), first)


@functools.lru_cache(maxsize=None)
def smooth_mesh():
    _, mesh = cloud_and_mesh(MAPPERS[0], live=True)
    return rendering.box_average(rendering.read_color(mesh.window, 4), 4)


@pytest.mark.parametrize("mapper_class, backend, samples", variants([2, 4, 8]))
def test_multisampling(mapper_class, backend, samples):
    """Samples of a window leave the surface as it is: same place, closed, same light. Its outline blends."""
    scene, _ = cloud_and_mesh(mapper_class)
    getattr(scene.mapper, f"SetBackendTo{backend}")()
    truth = smooth_mesh()
    plain = scene.color()
    mask = scene.depth() < 1
    mask = np.pad(mask, 2, mode="edge")  # of what goes on outside of the window
    outline = (grow(mask, 2) & grow(~mask, 2))[2:-2, 2:-2]
    outline[:, [0, -1]] = outline[[0, -1]] = True
    scene.window.SetMultiSamples(samples)
    smooth = scene.color()
    assert 255 * np.abs(plain - smooth)[~outline].max() < 1.5
    errors = [np.mean((image - truth)[outline] ** 2) for image in (plain, smooth)]
    print(f"outline: {10 * np.log10(errors[0] / errors[1]):.2f} dB better")
    assert errors[1] < OUTLINE_ERROR[mapper_class] * errors[0]


# Of the squared error without samples. The other mappers' outlines lie half a pixel or more outside of the true one.
OUTLINE_ERROR = {**dict.fromkeys(MAPPERS, 0.9), vtkPullPushMapper: 0.8, vtkSurfaceSplatMapper: 0.6}


@pytest.mark.parametrize("mapper_class", MAPPERS)
@pytest.mark.parametrize("backend", BACKENDS)
def test_multisampled_outline_hides_what_is_drawn_later(mapper_class, backend):
    """A pixel that is covered in part shows what lies behind, whether that was drawn before or after the cloud."""
    scene = scene_of(mapper_class, backend)
    scene.window.SetMultiSamples(4)
    behind = scene.add_floor()
    later = scene.color()
    scene.renderer.RemoveActor(scene.actor)
    scene.renderer.AddActor(scene.actor)
    assert np.array_equal(later, scene.color())
    behind.VisibilityOff()
    assert difference(later, scene.color()) > 10


@pytest.mark.parametrize("mapper_class", MAPPERS)
@pytest.mark.parametrize("backend", BACKENDS)
def test_release_and_render_again(mapper_class, backend):
    scene = scene_of(mapper_class, backend)
    first = scene.color()
    scene.mapper.ReleaseGraphicsResources(scene.window)
    assert np.array_equal(scene.color(), first)
    scene.window.Finalize()
    assert np.array_equal(scene.color(), first)
    scene.mapper.SetSupersampling(2)
    scene.color()
    scene.actor.ReleaseGraphicsResources(scene.window)
    scene.mapper.SetSupersampling(1)
    assert np.array_equal(scene.color(), first)


@pytest.mark.parametrize("mapper_class", [vtkPullPushMapper, vtkSurfaceSplatMapper])
def test_release_of_what_is_thinned_and_selected(mapper_class):
    scene = Scene(mapper_class, torus_cloud(60_000), (50, 50))
    scene.mapper.SetBackendToOpenGL()

    def selected():
        selector = vtkHardwareSelector()
        selector.SetRenderer(scene.renderer)
        selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_POINTS)
        selector.SetArea(0, 0, 49, 49)
        return vtk_to_numpy(selector.Select().GetNode(0).GetSelectionList())

    picture, ids = scene.color(), selected()
    assert scene.mapper.GetLastFramePointsDrawn() < 30_000 and len(ids) > 200
    scene.window.Finalize()
    assert np.array_equal(scene.color(), picture)
    assert np.array_equal(selected(), ids)


@pytest.mark.parametrize("mapper_class", MAPPERS)
@pytest.mark.parametrize("backend", BACKENDS)
def test_layers(mapper_class, backend):
    """A cloud in the layer in front covers what is behind, and nothing else."""
    scene = scene_of(mapper_class, backend)
    alone = scene.color()
    covered = scene.depth() < 1
    back = vtkRenderer()
    back.SetBackground(0.8, 0.1, 0.5)
    plane = vtkPlaneSource()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(plane.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetColor(0.2, 0.9, 0.2)
    back.AddActor(actor)
    back.SetLayer(0)
    scene.renderer.SetLayer(1)
    scene.window.SetNumberOfLayers(2)
    scene.window.AddRenderer(back)
    picture = scene.color()
    assert np.array_equal(picture[covered], alone[covered])
    behind = {tuple(color) for color in np.rint(255 * picture[~covered]).astype(int)}
    assert behind == {(204, 26, 128), (51, 230, 51)}


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_culled_actor(mapper_class):
    """An actor that VTK's culler leaves out has no surface buffer of that frame, and an old one is not passed off."""
    scene = scene_of(mapper_class)
    scene.color()
    from vtkmodules.vtkCommonDataModel import vtkImageData

    buffer = vtkImageData()
    assert scene.mapper.ReadSurfaceBuffer(buffer)
    scene.actor.VisibilityOff()
    scene.color()
    scene.actor.VisibilityOn()
    assert np.array_equal(scene.color().shape, (200, 200, 3))


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_picture(mapper_class):
    scene = scene_of(mapper_class, size=(300, 150))
    scene.renderer.SetViewport(0.1, 0.1, 0.55, 0.9)
    second = vtkRenderer()
    second.SetViewport(0.6, 0.2, 0.95, 1)
    second.SetBackground(0.3, 0.1, 0.1)
    second.AddActor(scene.actor)
    scene.window.AddRenderer(second)
    second.GetActiveCamera().SetPosition(0, 0, 8.848)
    second.GetActiveCamera().SetClippingRange(5, 12)
    scene.color()
    assert_baseline(scene.window, f"Windows-{mapper_class.__name__}")
