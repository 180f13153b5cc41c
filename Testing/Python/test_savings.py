# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark of savings on small cases: that each side does what it says, and that a picture that changes is told."""

import importlib.util
import os

import numpy as np
import pytest
from pointsurface import vtkPullPushMapper

BENCHMARKS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Benchmarks")
SIZE, COUNT = 128, 40_000


@pytest.fixture(scope="module")
def savings():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(BENCHMARKS)
        patch.setenv("POINTSURFACE_SHARED_DATA", "")  # no models
        spec = importlib.util.spec_from_file_location("savings", os.path.join(BENCHMARKS, "savings.py"))
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        # in this process, and without figures that nobody looks at
        patch.setattr(module, "measure_apart", lambda script, *case: module.measure(*case))
        patch.setattr(module, "FRAMES", 1)
        patch.setattr(module, "PROCESSES", 1)
        yield module


# What tells that a saving was used: less of it than without. Of the others no count is told.
@pytest.mark.parametrize("name", ("levels", "rectangle", "fills", "frustum", "polynomials"))
def test_a_saving_is_used_on_one_side_alone(savings, name):
    used, unused, gap = savings.compare(name, "CPU", COUNT, SIZE)
    print(name, used["told"], unused["told"], "grey levels", gap)
    assert 0 <= used["told"] < unused["told"]
    assert gap <= savings.MOST_DIFFERENCE


def test_an_approximation_is_held_beside_the_truth(savings):
    used, unused, _ = savings.compare("thinning", "CPU", COUNT, SIZE)
    print(used, unused)
    assert used["told"] < unused["told"]
    assert 20 < used["psnr"] < 60 and abs(used["psnr"] - unused["psnr"]) < 1


def test_shuffled_points_stay_shuffled(savings):
    """Chunks of points in any order, or with its ends in each, all reach through the picture, however small it is."""
    counts = {}
    for name in ("order", "frustum", "colour"):
        scene = savings.Scene(savings.SAVINGS[name], "CPU", COUNT, SIZE)
        savings.SAVINGS[name].make(scene, False)
        scene.camera.SetFocalPoint(*scene.nearest_point())
        scene.camera.SetViewAngle(2)
        scene.renderer.ResetCameraClippingRange()
        scene.window.Render()
        counts[name] = scene.mapper.GetLastFramePointsDrawn()
    print(counts)
    assert counts["order"] == COUNT
    assert counts["frustum"] >= COUNT - savings.CHUNK
    assert counts["colour"] < COUNT / 2


def test_table(savings):
    table = savings.make_table(("colour", "ids"), ("CPU",), SIZE, COUNT)
    rows = [line for line in table.splitlines() if " CPU " in line and line.startswith("|")]
    assert len(rows) == 2 and all(row.split("|")[-3].strip() == "0.00" for row in rows)
    assert "or of approximations by 0.5 dB: none." in table


def test_a_saving_that_changes_the_picture_is_told(savings, monkeypatch):
    def change(scene, used):
        scene.actor.GetProperty().SetColor(*(3 * [0.9 if used else 0.8]))

    monkeypatch.setitem(savings.SAVINGS, "wrong", savings.Saving("nothing", "nothing", change, vtkPullPushMapper))
    table = savings.make_table(("wrong",), ("CPU",), SIZE, COUNT)
    assert "or of approximations by 0.5 dB: wrong, CPU." in table


def test_difference(savings):
    one, other = np.zeros((4, 4, 3)), np.zeros((4, 4, 3))
    one[0, 0] = other[0, 0] = 0.5
    other[0, 1] = 0.2
    assert savings.difference(one, other) == pytest.approx(255 * 0.1)
    assert not savings.difference(0 * one, 0 * one) <= savings.MOST_DIFFERENCE  # nothing drawn
