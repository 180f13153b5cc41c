# SPDX-License-Identifier: BSD-3-Clause
"""Lines of illustration: the styles, their agreement between a cloud and its mesh, and their stability in motion."""

import os
import runpy
import sys

import numpy as np
import pytest
import vtkmodules.vtkRenderingFreeType  # noqa: F401  draws text
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkTextActor

from pointsurface import rendering, sampling, styles, vtkImageSpacePointMapper, vtkPullPushMapper
from scenes import grow

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Examples", "Python")
DATA = os.environ.get("POINTSURFACE_SHARED_DATA", "")
SIZE = 400


def shared(path):
    path = os.path.join(DATA, path)
    if not DATA or not os.path.exists(path):
        pytest.skip("../shared/data is absent")
    return path


@pytest.fixture(scope="module")
def dragon():
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(shared("meshes/dragon.vtp"))
    reader.Update()
    return reader.GetOutput()


@pytest.fixture(scope="module")
def cloud(dragon):
    return sampling.sample_by_area(dragon, 400_000)


class Scene:
    """A surface on white; lines are red, and nothing else is as red as they are."""

    def __init__(self, mapper, data):
        mapper.SetInputData(data)
        mapper.ScalarVisibilityOff()
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(0.4, 0.8, 0.8)
        actor.GetProperty().BackfaceCullingOn()
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(1, 1, 1)
        self.renderer.AddActor(actor)
        self.window = rendering.offscreen_window(self.renderer, (SIZE, SIZE))
        self.renderer.ResetCamera()
        self.renderer.GetActiveCamera().Zoom(1.4)

    def lines(self, style, thickness=2.0):
        """Pixels that are more line than not."""
        self.passes = styles.apply(self.renderer, style, thickness, color=(1, 0, 0))
        return self.line_pixels()

    def line_pixels(self):
        color = rendering.read_color(self.window)
        return (color[..., 0] - color[..., 1]) > 0.5


def mean_distance(lines, others):
    """From each pixel of a line to the nearest one of the others, up to 8 pixels; both ways."""
    def one_way(a, b):
        total = np.zeros(a.shape)
        for steps in range(8):
            total += ~grow(b, steps)  # steps along the axes and diagonals
        return total[a].mean()

    return max(one_way(lines, others), one_way(others, lines))


@pytest.mark.parametrize("style", ["silhouettes", "feature lines"])
@pytest.mark.parametrize("mapper_class", [vtkImageSpacePointMapper, vtkPullPushMapper])
def test_a_cloud_has_the_lines_of_its_mesh(dragon, cloud, mapper_class, style):
    found = Scene(mapper_class(), cloud).lines(style)
    mesh = Scene(vtkPolyDataMapper(), dragon).lines(style)
    distance = mean_distance(found, mesh)
    print(f"{style}: {np.count_nonzero(found)} and {np.count_nonzero(mesh)} pixels, mean distance {distance:.3f}")
    assert min(np.count_nonzero(found), np.count_nonzero(mesh)) > 1000
    assert distance < 1


def test_lines_do_not_blink_in_an_orbit(cloud):
    scene = Scene(vtkImageSpacePointMapper(), cloud)
    frames = [scene.lines("both")]
    step = 1.0  # degrees; the farthest points move by 0.0175 * 200 pixels
    for _ in range(29):
        scene.renderer.GetActiveCamera().Azimuth(step)
        frames.append(scene.line_pixels())
    near = [grow(frame, 4) for frame in frames]
    blinking = sum(
        np.count_nonzero(frames[i] & ~near[i - 1] & ~near[i + 1]) for i in range(1, len(frames) - 1)
    )
    total = sum(np.count_nonzero(frame) for frame in frames[1:-1])
    print(f"{blinking} of {total} line pixels blink: {blinking / total:.3%}")
    assert total > 28 * 2000
    assert blinking < 0.01 * total


def test_lines_are_as_thick_as_asked_for(dragon):
    scene = Scene(vtkPolyDataMapper(), dragon)
    counts = [np.count_nonzero(scene.lines("silhouettes", thickness)) for thickness in (1, 3, 5)]
    assert 2.3 * counts[0] < counts[1] < 3.7 * counts[0]
    assert counts[1] < counts[2]


def test_text_gets_no_lines(dragon):
    scene = Scene(vtkPolyDataMapper(), dragon)
    before = scene.lines("both")
    text = vtkTextActor()
    text.SetInput("Dragon")
    text.GetTextProperty().SetColor(0, 0, 1)
    text.SetPosition(10, 10)
    scene.renderer.AddActor(text)
    assert np.array_equal(scene.line_pixels(), before)
    assert np.any(rendering.read_color(scene.window)[:40, :120, 2] > rendering.read_color(scene.window)[:40, :120, 0])


def test_plain_is_the_renderer_as_it_was_and_other_names_are_refused(dragon):
    scene = Scene(vtkPolyDataMapper(), dragon)
    before = rendering.read_color(scene.window)
    assert np.any(scene.lines("both"))
    assert styles.apply(scene.renderer, "plain") == []
    assert np.array_equal(rendering.read_color(scene.window), before)
    with pytest.raises(ValueError, match="silhouettes"):
        styles.apply(scene.renderer, "sketch")


@pytest.mark.parametrize(
    "arguments", [("clouds/dragon.vtp",), ("volumes/ct-head-promed0051.vti", "300")], ids=["dragon", "bone"]
)
def test_an_example_draws_each_style(arguments, tmp_path, monkeypatch):
    """Each style's example draws a user's file; lines are what is dark and was not without them."""
    dark = {}
    for style in styles.STYLES:
        name = f"style_{style.replace(' ', '_')}"
        picture = tmp_path / f"{name}.png"
        monkeypatch.setattr(sys, "argv", [name, str(picture), shared(arguments[0]), *arguments[1:]])
        runpy.run_path(os.path.join(EXAMPLES, f"{name}.py"), run_name="__main__")
        reader = vtkPNGReader()
        reader.SetFileName(str(picture))
        reader.Update()
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
        assert pixels.shape == (400 * 400, 3)
        assert np.count_nonzero(pixels.min(axis=1) < 200) > 0.2 * len(pixels), "a surface is seen"
        dark[style] = pixels[:, :2].max(axis=1) < 60
    lines = {style: dark[style] & ~dark["plain"] for style in dark}
    print({style: np.count_nonzero(lines[style]) for style in lines})
    for style in ("silhouettes", "feature lines"):
        assert np.count_nonzero(lines[style]) > 2000
        assert np.mean(lines["both"][lines[style]]) > 0.3, f"both has {style}"  # thinner lines, or fewer
