# SPDX-License-Identifier: BSD-3-Clause
"""The command bench: what a measurement holds, how a run goes on, and who is on the Pareto front."""

import json
import os
import subprocess
import sys
import time
import types

import pytest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Reference"))  # the yardstick

from pointsurface import bench  # noqa: E402
from pointsurface.errors import WrongUse  # noqa: E402


def pointsurface(*arguments):
    return subprocess.run([sys.executable, "-m", "pointsurface", *map(str, arguments)], capture_output=True, text=True)


def result(milliseconds, psnr):
    return {"milliseconds": milliseconds, "psnr": psnr}


def test_pareto_front():
    results = {
        "fast": result(1, 20),
        "beaten": result(3, 25),
        "good": result(2, 30),
        "as good, slower": result(4, 30),
        "best": result(9, 40),
        bench.MESH: result(0.1, 99),  # is the truth, and beats none
        bench.EWA: result(None, 50),  # the yardstick
    }
    assert bench.pareto(results) == ["fast", "good", "best"]


def test_exceptions_are_peers_that_none_of_ours_is_as_fast_as_and_as_good():
    ours, better = result(10, 30), result(20, 40)
    results = {"ours": ours, "better": better, bench.GAUSSIAN: result(10, 30), bench.POINTS: result(15, 35)}
    results[bench.EWA] = result(None, 50)
    assert bench.exceptions(results) == [bench.POINTS]
    results[bench.POINTS] = result(15, 25)
    assert bench.exceptions(results) == []


def test_measurement_of_a_sphere():
    measured = bench.measure_case(bench.Case("sphere", 20_000, 128))
    assert list(measured) == [name for name in bench.RENDERERS if name != bench.OPEN3D or name in measured]
    for name, figures in measured.items():
        print(name, figures)
        assert name == bench.EWA or figures["milliseconds"] > 0
        assert figures["unfilled"] < 0.02
        assert (figures["normal_mean"] is None) == (name in (*bench.PEERS, bench.MESH))
    assert all(measured[name]["normal_mean"] < 2 for name in (*bench.OURS, bench.EWA))
    assert measured[bench.EWA]["psnr"] > measured[bench.GAUSSIAN]["psnr"] + 5  # lit and placed as the others are
    # the mesh is the truth but for what supersampling does at its outline; the peers are rough
    assert measured[bench.MESH]["depth"] < 1e-4
    assert measured[bench.MESH]["psnr"] > max(measured[peer]["psnr"] for peer in bench.PEERS if peer in measured) + 5


def test_open3d_where_it_is_there():
    """Its picture is that of points of VTK, whose size is the same."""
    if bench.OPEN3D not in bench.PEERS:
        pytest.skip("Open3D is not installed")
    stage = bench.Stage(bench.Case("sphere", 20_000, 128))
    truth = stage.truth()
    figures = stage.measure(bench.OPEN3D, truth)
    if figures is None:
        pytest.skip("Open3D finds no graphics driver")
    points = stage.measure(bench.POINTS, truth)
    print(figures, points)
    assert figures["milliseconds"] > 0 and figures["processor_milliseconds"] > 0 and figures["normal_mean"] is None
    assert abs(figures["psnr"] - points["psnr"]) < 3 and abs(figures["iou"] - points["iou"]) < 0.02
    assert figures["depth"] < 2 * points["depth"]


@pytest.mark.parametrize(
    ("does", "reason"), [("raise RuntimeError('no driver')", "no driver"), ("import time; time.sleep(60)", "over 2 seconds")]
)
def test_open3d_that_cannot_draw_is_left_out(tmp_path, monkeypatch, capsys, does, reason):
    monkeypatch.setattr(bench, "OPEN3D_SECONDS", 2)
    (tmp_path / "open3d.py").write_text(does)
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
    stage = bench.Stage(bench.Case("sphere", 100, 32))
    assert stage.measure(bench.OPEN3D, None) is None
    said = capsys.readouterr().err
    assert "Open3D is left out" in said and reason in said


def test_frames_that_take_long_are_fewer(monkeypatch):
    stage = bench.Stage(bench.Case("sphere", 100, 32))
    drawn = []
    monkeypatch.setattr(bench, "_time_frame", lambda window: drawn.append(len(drawn)) or (1.0 + len(drawn), 2.0))
    assert stage._time_frames(None) == [bench.WARM_UP + (bench.FRAMES + 1) / 2 + 1, 2.0]
    assert len(drawn) == bench.WARM_UP + bench.FRAMES
    drawn.clear()
    monkeypatch.setattr(bench, "MOST_SECONDS", 0.1)
    monkeypatch.setattr(bench, "_time_frame", lambda window: time.sleep(0.07) or drawn.append(1) or (len(drawn), 2.0))
    assert stage._time_frames(None) == [bench.WARM_UP + 1, 2.0]  # one after warm-up


@pytest.mark.parametrize("scene", bench.SCENES)
def test_scenes_have_triangles_and_normals(scene):
    mesh = bench.make_mesh(scene)
    assert mesh.GetNumberOfPolys() > 1000
    assert mesh.GetPolys().GetMaxCellSize() == 3
    assert mesh.GetPointData().GetNormals() is not None


def test_a_run_goes_on_where_it_was_stopped(tmp_path, monkeypatch, capsys):
    cases = [bench.Case("torus", count, 64) for count in (1000, 10_000)]
    renderers = {name: dict.fromkeys((*bench.MEASURES, "processor_milliseconds"), 1.0) for name in bench.RENDERERS}
    figures = {name: {**known, **result(2.0 + i, 20.0 + i), "renderer": "x"} for i, (name, known) in enumerate(renderers.items())}
    figures[bench.MESH]["normal_mean"] = None
    measured = []

    def measure(case):
        if len(measured) == 1:
            raise KeyboardInterrupt
        measured.append(case)
        return figures

    monkeypatch.setattr(bench, "quick_cases", lambda: cases)
    monkeypatch.setattr(bench, "_measure_apart", measure)
    arguments = types.SimpleNamespace(files=[], full=False, output=str(tmp_path), measure=None)
    with pytest.raises(KeyboardInterrupt):
        bench.run(arguments)
    assert list(json.loads((tmp_path / "results.json").read_text())) == [str(cases[0])]
    stopped = "1 of 2 measurements are made"
    assert stopped in (tmp_path / "RESULTS.md").read_text()

    monkeypatch.setattr(bench, "_measure_apart", lambda case: measured.append(case) or figures)
    bench.run(arguments)
    assert measured == cases
    assert "RESULTS.md" in capsys.readouterr().out
    report = (tmp_path / "RESULTS.md").read_text()
    assert stopped not in report
    assert "## Torus, 10000 points, 64 x 64" in report and f"| {bench.OURS[0]} * | 2.0 | 1.0 | 20.00 |" in report
    rows = (tmp_path / "results.csv").read_text().splitlines()
    assert len(rows) == 1 + 2 * len(bench.RENDERERS)
    pictures = {name for name in os.listdir(tmp_path) if name.endswith(".png")}
    assert pictures == {"torus-1000-points-64-x-64.png", "torus-10000-points-64-x-64.png", "over-points.png", "over-density.png", "RESULTS.png"}


def test_a_case_that_fails_or_takes_too_long_is_left_out(tmp_path, monkeypatch, capsys):
    cases = [bench.Case(name, 1000, 64) for name in ("no-such-file.ply", "sphere")]
    monkeypatch.setattr(bench, "quick_cases", lambda: cases)
    arguments = types.SimpleNamespace(files=[], full=False, output=str(tmp_path), measure=None)
    with pytest.raises(WrongUse, match="not measured, see above: no-such-file.ply, 1000 points"):
        bench.run(arguments)
    assert "its process ended with 2" in capsys.readouterr().err
    assert list(json.loads((tmp_path / "results.json").read_text())) == [str(cases[1])]
    assert "1 of 2 measurements are made" in (tmp_path / "RESULTS.md").read_text()

    monkeypatch.setattr(bench, "CASE_SECONDS", 0.01)
    assert bench._measure_apart(cases[1]) is None
    assert "over 0.01 seconds" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--measure", "no-such-file.ply", 1000, 64), "no-such-file.ply"),
        (("--measure", "torus", "many", 64), "points and pixels are numbers"),
        (("a.ply",), "--full alone"),
    ],
)
def test_wrong_use(arguments, said):
    run = pointsurface("bench", *arguments)
    assert run.returncode == 2 and len(run.stderr.splitlines()) == 1 and said in run.stderr


def test_a_file_that_is_no_results(tmp_path):
    (tmp_path / "results.json").write_text("{")
    with pytest.raises(WrongUse, match="remove it"):
        bench.run(types.SimpleNamespace(files=[], full=False, output=str(tmp_path), measure=None))
