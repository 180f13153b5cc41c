# SPDX-License-Identifier: BSD-3-Clause
"""The error table's program on one model and view: what it measures must be right, and the default must lead."""

import importlib.util
import os

import numpy as np
import pytest

BENCHMARKS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Benchmarks")


@pytest.fixture(scope="module")
def errors():
    spec = importlib.util.spec_from_file_location("errors", os.path.join(BENCHMARKS, "errors.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def torus(errors):
    return errors.make_model("torus", errors.read_mesh("torus"), seed=0)


def test_own_shading_is_that_of_vtk(errors, torus):
    """The true surface, lit by VTK with one sample a pixel, and lit from its normals and depth."""
    scene = errors.Scene(torus, "oblique")
    truth = errors.render_truth(torus.mesh, scene.renderer, scene.lit, errors.SIZE, supersampling=1)
    shaded = errors.shade_image(truth.normals, truth.depth, scene.focal_length())
    assert np.count_nonzero(truth.mask) > 20000
    assert np.ptp(truth.color[truth.mask]) > 0.8  # from the shadow to the highlight
    assert np.abs(shaded - truth.color).max() < 2 / 255
    assert np.abs(shaded - truth.color).mean() < 0.3 / 255


def test_depth_buffer_is_made_linear(errors, torus):
    scene = errors.Scene(torus, "whole")
    truth = errors.draw_truth(scene)
    mapper = errors.vtkPolyDataMapper()
    mapper.SetInputData(torus.mesh)
    scene.draw(mapper, scene.lit)
    depth = scene.read_depth()
    assert np.array_equal(depth > 0, truth.mask)
    assert np.abs(depth - truth.depth).max() < 1e-4 * torus.mesh.GetLength()


def test_views_show_what_they_say(errors, torus):
    whole, zoomed = (errors.draw_truth(errors.Scene(torus, view)) for view in ("whole", "zoomed"))
    rows, columns = np.nonzero(whole.mask)
    half = np.array(errors.SIZE) / 2
    reach = max(np.abs(columns + 0.5 - half[0]).max() / half[0], np.abs(rows + 0.5 - half[1]).max() / half[1])
    assert reach == pytest.approx(errors.FILLED, abs=0.01)
    assert np.mean(zoomed.mask) > 0.5
    middle = half.astype(int)
    assert zoomed.depth[middle[1], middle[0]] == pytest.approx(whole.depth[middle[1], middle[0]], rel=0.01)


def test_inner_outlines_are_pixels_in_front_of_a_step(errors):
    depth = np.full((6, 8), 2.0)
    depth[2:5, 3:6] = 1  # nine pixels, all but one of them at the rim
    depth[0] = 0  # nothing there: no inner outline
    truth = errors.SurfaceImage(None, None, depth)
    assert errors.inner_outlines(truth, 1) == 8 / 40
    assert errors.inner_outlines(truth, 101) == 0  # 1% of which is more than the step


def test_wrong_depth_is_split(errors):
    """Of ten pixels two are too near, one of them as one of its samples is, one too far, one barely off, one empty."""
    truth = errors.SurfaceImage(None, None, np.full((2, 5), 10.0))
    image = errors.SurfaceImage(None, None, truth.depth.copy())
    image.depth.flat[:5] = 9, 9, 12, 10.005, 0
    samples = np.full((2, 5, 4, 4), 10.0)
    samples[0, 1, 2, 3] = 9.005
    split = errors.split_wrong_depth(image, truth, samples, diagonal=1)
    assert split == {"too_near": 2 / 9, "too_far": 1 / 9, "no_sample": 2 / 9}


def test_truth_beside_itself(errors):
    """A step that the displaced truth passes in one column of pixels, and none that it passes along the columns."""
    samples = np.full((6, 8, 4, 4), 10.0)
    samples[:, 3, :, 2:] = 11  # from the middle of the pixels of this column on
    samples[:, 4:] = 11
    assert errors.shift_truth(samples, diagonal=1) == [1 / 8, 0]
    assert errors.shift_truth(samples.transpose(1, 0, 3, 2), diagonal=1) == [0, 1 / 8]
    assert errors.shift_truth(samples, diagonal=200) == [0, 0]


def make_rows(errors, model, view, **changes):
    """Rows of every kind, all alike but for the changes, which are by kind."""
    kinds = (errors.PUBLISHED, errors.CULLED, errors.DEFAULT, errors.SUPERSAMPLED, errors.GAUSSIAN, errors.SPLATS)
    same = dict.fromkeys(errors.COLUMNS, 0.5)
    same |= dict(psnr=30, too_near=0.3, too_far=0.2, no_sample=0.1, shifted=(0.02, 0.03), inner_outlines=0)
    return [errors.Row(model, view, kind, kind, {**same, **changes.get(kind, {})}) for kind in kinds]


def test_summary_tells_reasons(errors):
    noise = {view: dict.fromkeys(errors.COLUMNS, 0.1) for view in errors.VIEWS}
    changes = {errors.DEFAULT: {"psnr": 36, "normal_mean": 0.9, "depth": 0.9}, errors.CULLED: {"depth": 0.9}}
    rows = make_rows(errors, "torus", "zoomed", **changes)
    summary = errors.format_summary(rows, noise, "horse")
    assert (
        "default (published): torus, zoomed: normals, mean, degrees 0.90 (0.50, with culling 0.50) "
        "(backface culling, which is published, is off by default). torus, zoomed: depth"
    ) in summary
    assert "default, culling (published): torus, zoomed: depth, % of diagonal 90.0000 (50.0000) (not explained)." in summary
    assert "Default against EWA splats, mean lead over 1 views (minus: behind): PSNR, dB +6.00, behind in 0;" in summary
    assert "normals, mean, degrees -0.40, behind in 1;" in summary
    assert "30.000 too near, 20.000 too far, 10.000 where no sample agrees) (points at random leave" in summary
    assert "of one model, horse, and used for all of them" in summary
    table = errors.format_wrong_depth(rows + make_rows(errors, "horse", "zoomed"))
    assert table.count("\n| torus |") == 6
    assert "| torus | default | 50.000 | 30.000 | 20.000 | 10.000 | 2.000 | 3.000 |" in table


def test_head_tells_radii(errors, torus):
    """Points at random have the radius that the protocol says, of a mean spacing that nothing but the area tells."""
    assert errors.measure_radius(torus) == pytest.approx(errors.RADIUS, rel=1e-3)


def test_report(errors):
    name = "bunny" if errors.read_mesh("bunny") is not None else "torus"
    report = errors.make_report([name], ["whole"])
    lines = [line for line in report.splitlines() if line.startswith(f"| {name} | whole |") and "| noise |" not in line]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    psnr, ssim, normal_mean, normal_95, depth, iou, unfilled, wrong_depth = range(8)
    figures = {row[2]: [float(cell) for cell in row[3:]] for row in cells}
    ours = [errors.PUBLISHED, errors.CULLED, errors.DEFAULT, errors.SUPERSAMPLED]
    labels = list(figures)
    assert labels[:4] == ours and labels[6:] == [errors.SPLATS, errors.OUR_SPLATS, errors.SUPERSAMPLED_SPLATS]
    assert labels[4].startswith(errors.GAUSSIAN) and labels[5].startswith(errors.POINTS)

    default, finer = figures[errors.DEFAULT], figures[errors.SUPERSAMPLED]
    gaussian = figures[labels[4]]
    assert default[psnr] > 34 and default[ssim] > 0.965 and default[iou] > 0.985
    assert default[normal_mean] < 1.7 and default[normal_95] < 5
    assert default[depth] < 0.05 and default[unfilled] < 0.2
    assert finer[psnr] > default[psnr] + 1 and finer[normal_mean] < default[normal_mean]
    assert default[psnr] > gaussian[psnr] + 5
    assert 35 < figures[errors.SPLATS][psnr] < 50
    assert "Behind the published algorithm by more than noise, default (published): " in report


def test_what_is_not_there_is_left_out(errors, monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(errors, "DATA", str(tmp_path))
    with pytest.raises(SystemExit, match="add torus"):
        errors.make_report(["bunny"], ["whole"])
    assert f"bunny: not in {tmp_path}, left out" in capsys.readouterr().err


def test_every_departure_is_known(errors):
    assert {"SubpixelCenters", "FillPixels"} <= set(errors.departures())
    assert "ReleaseDataFlag" not in errors.departures()
