# SPDX-License-Identifier: BSD-3-Clause
"""Each image-space pass by itself on patterns of pixels of which it is plain what has to come out: objects a pixel thin,
corners, concave outlines, and layers closer than the threshold and farther."""

import numpy as np
import pytest
from scenes import Scene, array, polydata
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

from pointsurface import passes

SIZE = (40, 30)
BACKGROUND, COLOR, BEHIND = np.array([(0.2, 0.4, 0.6), (1.0, 0.8, 0.2), (0.4, 0.2, 0.8)])
NEAR, FAR = 1.0, 30.0


def empty():
    return np.zeros(SIZE[::-1])  # distance behind the plane z = 0; 0 is the background


def thin():
    """A lone point, a row, and a diagonal."""
    pattern = empty()
    pattern[20, 20] = 1
    pattern[5, 3:15] = 1
    pattern[3 + np.arange(10), 25 + np.arange(10)] = 1
    return pattern


def block():
    pattern = empty()
    pattern[5:20, 6:30] = 1
    return pattern


def concave():
    pattern = empty()
    pattern[5:13, 5:25] = 1
    pattern[5:25, 5:13] = 1
    return pattern


def layers(step, hole=False):
    """All of the frame, with a part in front of the rest by a step; the hole shows what is behind."""
    pattern = empty() + 5
    pattern[8:20, 10:30] = 5 - step
    if hole:
        pattern[12, 15] = 5
    return pattern


def colors_of(pattern):
    return np.where(pattern[..., None] > 0, np.where(pattern[..., None] < 5, COLOR, BEHIND), BACKGROUND)


def draw(pattern, name=None, leaning=False, **settings):
    """The colours and the distances that come out: a point for each pixel, facing the viewer; those nearer than 5 may lean."""
    y, x = np.nonzero(pattern)
    normals = np.where(leaning & (pattern[y, x] < 5)[:, None], (0.8, 0.0, 0.6), (0.0, 0.0, 1.0))
    cloud = polydata(np.stack([x + 0.5, y + 0.5, -pattern[y, x]], axis=1), normals)
    vertices = vtkCellArray()
    vertices.InsertNextCell(len(x))
    for i in range(len(x)):
        vertices.InsertCellPoint(i)
    cloud.SetVerts(vertices)
    cloud.GetPointData().SetScalars(array(255 * colors_of(pattern)[y, x], "colors", np.uint8))
    scene = Scene(vtkPolyDataMapper, cloud, SIZE)
    scene.renderer.SetBackground(BACKGROUND)
    scene.actor.GetProperty().SetAmbient(1)
    scene.actor.GetProperty().SetDiffuse(0)
    camera = scene.camera
    camera.ParallelProjectionOn()
    camera.SetParallelScale(SIZE[1] / 2)
    camera.SetFocalPoint(SIZE[0] / 2, SIZE[1] / 2, 0)
    camera.SetPosition(SIZE[0] / 2, SIZE[1] / 2, 10)
    camera.SetViewUp(0, 1, 0)
    camera.SetClippingRange(NEAR, FAR)
    if name:
        made = passes.PASSES[name]()
        for key, value in settings.items():
            getattr(made, f"Set{key}")(value)
        passes.apply(scene.renderer, [made])
    color, depth = scene.color(), scene.depth()
    return color, np.where(depth < 1, NEAR + depth * (FAR - NEAR) - 10, 0)


def assert_picture(drawn, pattern, line=None):
    """The pattern in its place and at its depth, in its colour but for the pixels of a line."""
    color, distance = drawn
    expected = colors_of(pattern)
    if line is not None:
        expected = np.where(line[..., None], 0, expected)
    assert np.abs(distance - pattern).max() < 1e-4
    assert np.abs(color - expected).max() < 0.005


def beside(mask, other):
    """Pixels of a mask with one of another at a side; outside of the frame nothing is known."""
    wide = np.pad(other, 1)
    return mask & (wide[1:-1, 2:] | wide[1:-1, :-2] | wide[2:, 1:-1] | wide[:-2, 1:-1])


def blended(pattern, edge):
    """The picture with the pixels of an edge as the mean of those around by the Gaussian kernel."""
    plain = colors_of(pattern)
    wide = np.pad(plain, ((1, 1), (1, 1), (0, 0)))
    exists = np.pad(np.ones(pattern.shape), 1)[..., None]
    total, weights = 0, 0
    for i in range(3):
        for j in range(3):
            part = slice(i, i + SIZE[1]), slice(j, j + SIZE[0])
            weight = 4 >> (abs(i - 1) + abs(j - 1))
            total, weights = total + weight * wide[part], weights + weight * exists[part]
    return np.where(edge[..., None], total / weights, plain)


PATTERNS = {"thin": thin, "block": block, "concave": concave, "empty": empty, "whole": lambda: layers(0)}


@pytest.mark.parametrize("pattern", [make() for make in PATTERNS.values()], ids=PATTERNS)
@pytest.mark.parametrize("name", ["background-fill", "occluded-fill", "smoothing", "feature-lines"])
def test_no_change_where_there_is_nothing_to_do(pattern, name):
    """What is thin does not grow or vanish, corners and concave outlines stay."""
    assert_picture(draw(pattern, name), pattern)


@pytest.mark.parametrize("pattern", [make() for make in PATTERNS.values()], ids=PATTERNS)
def test_silhouettes(pattern):
    """A line of a pixel is the pixels of the surface beside the background, and no others."""
    assert_picture(draw(pattern, "silhouettes", Thickness=1), pattern, beside(pattern > 0, pattern == 0))


@pytest.mark.parametrize("pattern", [make() for make in PATTERNS.values()], ids=PATTERNS)
def test_antialiasing(pattern):
    """Pixels on both sides of an edge are the mean of those around by the Gaussian kernel; depths stay."""
    color, distance = draw(pattern, "antialiasing")
    edge = beside(pattern > 0, pattern == 0) | beside(pattern == 0, pattern > 0)
    assert np.abs(distance - pattern).max() < 1e-4
    assert np.abs(color - blended(pattern, edge)).max() < 0.005


def test_concave_corner_as_published():
    """The paper's masks alone fill a pixel of a concave corner in an iteration."""
    pattern = concave()
    _, distance = draw(pattern, "background-fill", KeepOutlines=False, MaximumIterations=1)
    pattern[13, 13] = 1
    assert np.abs(distance - pattern).max() < 1e-4


@pytest.mark.parametrize("step, is_edge", [(0.2, False), (3, True)], ids=["closer", "farther"])
def test_layers(step, is_edge):
    """Layers closer than a threshold of 1 are one surface; others have an edge, and hide what is behind."""
    pattern = layers(step)
    front, back = pattern < 5, pattern == 5
    ring = beside(front, back)
    assert_picture(draw(pattern, "silhouettes", Thickness=1, Threshold=1), pattern, ring if is_edge else None)

    holed = layers(step, hole=True)
    assert_picture(draw(holed, "occluded-fill", LayerDistance=1), pattern if is_edge else holed)
    assert_picture(draw(holed, "background-fill"), holed)

    color, smooth = draw(pattern, "smoothing", LayerDistance=1)
    if is_edge:
        assert_picture((color, smooth), pattern)
    else:
        assert np.abs(smooth - pattern)[ring].min() > 0.1 * step
        assert np.abs(color - colors_of(pattern))[ring].max(axis=-1).min() > 0.05

    color, distance = draw(pattern, "antialiasing", Threshold=1)
    edge = (ring | beside(back, front)) & is_edge
    assert np.abs(distance - pattern).max() < 1e-4
    assert np.abs(color - blended(pattern, edge)).max() < 0.005
    assert_picture(draw(pattern, "feature-lines", LayerDistance=1), pattern)


@pytest.mark.parametrize("distance, is_bent", [(1, False), (5, True)])
def test_feature_lines_within_a_layer(distance, is_bent):
    """Between layers a surface does not bend, however its normals differ."""
    pattern = layers(3)
    color, _ = draw(pattern, "feature-lines", leaning=True, LayerDistance=distance)
    line = color.max(axis=-1) < 0.05
    front = pattern < 5
    assert (np.count_nonzero(line & (beside(front, ~front) | beside(~front, front))) > 30) == is_bent
    assert line.any() == is_bent


@pytest.mark.parametrize("size", [100, 300, 900])
def test_lines_are_as_thin_and_sharp_at_any_resolution(size):
    """The outline of a ball: two pixels thick whatever the size of the picture, and dark nowhere else."""
    ball = vtkSphereSource()
    ball.SetThetaResolution(400)
    ball.SetPhiResolution(200)
    ball.Update()
    scene = Scene(vtkPolyDataMapper, ball.GetOutput(), (size, size))
    scene.renderer.SetBackground(1, 1, 1)
    scene.actor.GetProperty().SetAmbient(1)
    scene.actor.GetProperty().SetDiffuse(0)
    scene.camera.ParallelProjectionOn()
    scene.camera.SetParallelScale(0.6)
    passes.apply(scene.renderer, [passes.PASSES["silhouettes"]()])
    darkness = 1 - scene.color().mean(axis=-1)
    y, x = np.indices((size, size)) + 0.5 - size / 2
    radius = size / 2.4
    near = np.abs(np.hypot(x, y) - radius) < 3
    length = 4 * 2**0.5 * radius  # of the pixels along a circle that have the outside at a side
    assert 0.85 < darkness[near].sum() / (2 * length) < 1.25
    assert darkness[~near].sum() < 1
