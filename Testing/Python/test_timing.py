# SPDX-License-Identifier: BSD-3-Clause
"""The stages of a frame are measured where they are spent: ratios of times of one run, of work far above what timing costs."""

import time
from statistics import median

import pytest
from scenes import MAPPERS, Scene, torus_cloud

from pointsurface import rendering

# for the driver not to leave out, and of no effect to be seen
MUCH_WORK = """//VTK::Light::Impl
  float work = fragOutput0.r;
  for (int i = 0; i < 3000; ++i) { work = sin(work + fragOutput0.g); }
  fragOutput0.r += 1e-6 * work;
"""


@pytest.fixture
def scene():
    """Larger than a tile of a software rasteriser, and empty at its borders, whose tiles are done in no time."""
    scene = Scene(MAPPERS[0], torus_cloud(), (300, 300))
    scene.camera.Zoom(0.6)
    if "llvmpipe" not in rendering.renderer_string(scene.window):
        pytest.skip("the work is chosen for a rasteriser in software")
    scene.mapper.SetBackendToCPU()
    return scene


def draw(scene):
    """Seconds of a frame with a view of its own."""
    scene.camera.Azimuth(3)
    scene.window.WaitForCompletion()
    start = time.perf_counter()
    scene.window.Render()
    scene.window.WaitForCompletion()
    return time.perf_counter() - start


def share_of_shading(scene):
    seconds = draw(scene)
    return 1e-3 * scene.mapper.GetLastFrameShadeMilliseconds() / seconds


def test_shading(scene):
    """A shader with much to do takes most of a frame, and that is told of the stage."""
    scene.actor.GetShaderProperty().AddFragmentShaderReplacement("//VTK::Light::Impl", True, MUCH_WORK, False)
    draw(scene)
    shares = [share_of_shading(scene) for _ in range(5)]
    print(shares)
    assert 0.5 < median(shares) < 1


def test_time_to_draw(scene):
    """What levels of detail go by covers what the processor does."""
    spent, told = [], []
    for _ in range(10):
        draw(scene)
        spent.append(scene.mapper.GetLastFrameProjectMilliseconds() + scene.mapper.GetLastFrameReconstructMilliseconds())
        told.append(1e3 * scene.mapper.GetTimeToDraw())
    print(spent, told)
    assert median(told) > 0.5 * median(spent)
