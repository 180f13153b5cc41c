# SPDX-License-Identifier: BSD-3-Clause
"""The command bench: what a measurement holds, how a run goes on, and who is on the Pareto front."""

import json
import os
import subprocess
import sys
import time
import types

import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Reference"))  # the yardstick

from pointsurface import bench, bench_report, bench_scenes, bench_stage  # noqa: E402
from pointsurface.bench_scenes import Case  # noqa: E402
from pointsurface.errors import WrongUse  # noqa: E402
from pointsurface.volumes import gyroid_ball  # noqa: E402


def pointsurface(*arguments):
    return subprocess.run([sys.executable, "-m", "pointsurface", *map(str, arguments)], capture_output=True, text=True)


def result(milliseconds, psnr, **others):
    known = dict.fromkeys((*bench_stage.TIMES, *bench_report.MEASURES), 1.0)
    return {**known, "milliseconds": milliseconds, "psnr": psnr, **others}


def results(rows, automatic="CPU", seconds=60):
    picked = {"CPU": "surface-splats", "OpenGL": "pull-push"}
    return {"rows": rows, "picked": picked, "automatic": automatic, "renderer": "a renderer", "seconds": seconds}


def figures_of_all(milliseconds=2.0):
    names = [name for name in bench_stage.RENDERERS if not name.endswith("CPU")]
    rows = {name: result(milliseconds + i, 20.0 + i) for i, name in enumerate(names)}
    rows[bench_stage.MESH]["normal_mean"] = None
    return results(rows)


def report(tmp_path, measured, command="command"):
    bench_report.write_report(str(tmp_path), measured, len(measured), command)
    return (tmp_path / "RESULTS.md").read_text()


def section(text, heading):
    return text.split(f"## {heading}\n")[1].split("\n## ")[0]


def test_pareto_front():
    rows = {
        "fast": result(1, 20),
        "beaten": result(3, 25),
        "good": result(2, 30),
        "as good, slower": result(4, 30),
        "best": result(9, 40),
        bench_stage.MESH: result(0.1, 99),  # is the truth, and beats none
        bench_stage.FLYING_EDGES: result(0.1, 99),  # likewise
        bench_stage.EWA: result(None, 50),  # the yardstick
    }
    assert bench_report.pareto(rows) == ["fast", "good", "best"]


POINTS = next(iter(bench_stage.POINTS))


def test_exceptions_are_peers_that_none_of_ours_is_as_fast_as_and_as_good():
    rows = {"pull-push": result(10, 30), "direct": result(20, 40), "image-space": result(30, 45)}
    rows |= {bench_stage.GAUSSIAN: result(10, 30), POINTS: result(15, 35), bench_stage.FILL: result(15, 50)}
    rows[bench_stage.EWA] = result(None, 50)
    assert bench_report.exceptions(rows) == {POINTS: "direct", bench_stage.FILL: None}
    rows[POINTS] = result(15, 25)
    rows[bench_stage.FILL] = result(35, 42)
    assert bench_report.exceptions(rows) == {}


def test_exceptions_are_told_with_scene_and_figures(tmp_path):
    plain = {"pull-push": result(10, 30), "direct": result(20, 40), bench_stage.MESH: result(10, 50)}
    measured = [
        (Case("torus", 1000, 64), results({**plain, POINTS: result(15, 35)})),
        (Case("gyroid", 1000, 64), results({**plain, POINTS: result(15, 25)})),
        (Case("/far/a.ply", 1000, 64), results({**plain, POINTS: result(15, 41)})),
    ]
    text = report(tmp_path, measured)
    told = section(text, "Exceptions")
    assert f"| [torus, 1000 points, 64 x 64](#torus-1000-points-64-x-64) | {POINTS} | 15.0 | 35.0 | direct | 20.0 | 40.0 |" in told
    assert "a.ply, 1000" in told and f"| {POINTS} | 15.0 | 41.0 | none |  |  |" in told
    assert "gyroid" not in told and "/far" not in text
    assert "none." in section(report(tmp_path, measured[1:2]), "Exceptions")
    fronts = section(text, "The fronts")
    assert f"| pull-push: 10.0, 30.0; {POINTS}: 15.0, 35.0; direct: 20.0, 40.0 | 10.0, 50.0 |" in fronts


def test_what_is_picked_beside_what_is_best(tmp_path):
    rows = {"pull-push": result(10, 39.6), "surface-splats": result(20, 40), "direct": result(5, 39.4)}
    rows |= {"pull-push, OpenGL": result(100, 39), "surface-splats, OpenGL": result(300, 39.2), "pull-push 2x": result(1, 99)}
    assert bench_report.best(bench_report.by_backend(results(rows), "CPU")) == "pull-push"
    told = section(report(tmp_path, [(Case("torus", 1000, 64), results(rows))]), "What is picked")
    assert "Picked is what measures best in 1 of 2." in told
    assert "| CPU | surface-splats | 20.0 | 1 | 40.00 | 1.00 | pull-push | 10.0 | 1 | 39.60 | 1.00 |" in told
    assert "| OpenGL | pull-push | 100.0 | 1 | 39.00 | 1.00 |  |  |  |  |  |" in told
    # direct beats neither, pull-push is no faster with less error: both picks are on the front
    assert "none of ours beats it in both time and PSNR, in 2, and clearly beaten in 0." in told and "beaten by" not in told
    # by a GPU the rows with no back end in their names are those of OpenGL
    swapped = {name.replace("OpenGL", "CPU"): row for name, row in rows.items()}
    assert bench_report.by_backend(results(swapped, "OpenGL"), "OpenGL").keys() == {"pull-push", "surface-splats", "direct"}
    assert bench_report.by_backend(results(swapped, "OpenGL"), "CPU")["pull-push"]["milliseconds"] == 100


def test_what_beats_what_is_picked(tmp_path):
    rows = {"pull-push": result(8.9, 40.4), "surface-splats": result(10, 40), "direct": result(10, 40)}
    rows |= {"image-space": result(9, 41), "pull-push 2x": result(1, 99)}
    rows |= {"pull-push, OpenGL": result(10, 30), "surface-splats, OpenGL": result(9.5, 35)}
    faster = {**rows, "pull-push, OpenGL": result(9, 30)}
    measured = [(Case("torus", 1000, 64), results(rows)), (Case("gyroid", 1000, 64), results(faster))]
    assert bench_report.beaters(bench_report.by_backend(results(rows), "CPU"), "surface-splats") == ["image-space", "pull-push"]
    told = section(report(tmp_path, measured), "What is picked")
    assert "none of ours beats it in both time and PSNR, in 1, and clearly beaten in 2." in told
    beaten = told.split("What is not on the front:")[1].split("All that is picked")[0]
    assert beaten.count("| OpenGL |") == 1 and beaten.count("| CPU |") == 2
    assert "| CPU | surface-splats | 10.0 | 1 | 40.00 | 1.00 | image-space | 9.0 | 1 | 41.00 | 1.00 | yes |" in beaten
    assert "| OpenGL | pull-push | 10.0 | 1 | 30.00 | 1.00 | surface-splats | 9.5 | 1 | 35.00 | 1.00 | no |" in beaten


def test_many_points_beside_few(tmp_path):
    def case(points, times, errors):
        figures = zip(("pull-push", "surface-splats"), times, errors)
        rows = {name: result(9, psnr, processor_milliseconds=milliseconds) for name, milliseconds, psnr in figures}
        return Case("gyroid", points, 64), results({**rows, bench_stage.MESH: result(1, 50)})

    few, many = case(1_000_000, (10, 20), (40, 41)), case(20_000_000, (21, 39), (41, 40.4))
    told = section(report(tmp_path, [few, many]), "As many points as there may be")
    assert "| gyroid, 64 x 64 | surface-splats, picked | 20.0 | 39.0 | 1.95 | 41.00 | 40.40 | -0.60 | no |" in told
    assert "| gyroid, 64 x 64 | pull-push | 10.0 | 21.0 | 2.10 | 40.00 | 41.00 | +1.00 | no |" in told
    few, many = case(1_000_000, (10, 20), (40, 41)), case(20_000_000, (20, 39), (39.6, 40.6))
    assert section(report(tmp_path, [few, many]), "As many points as there may be").count("| yes |") == 2
    assert "As many points" not in report(tmp_path, [few])


def test_measurement_of_a_sphere():
    measured = bench_stage.measure_case(Case("sphere", 20_000, 128))
    assert measured["picked"] == {"CPU": "surface-splats", "OpenGL": "pull-push"} and measured["seconds"] > 0
    rows = measured["rows"]
    left_out = ("direct, CPU", "direct, OpenGL", f"pull-push, {measured['automatic']}", f"surface-splats, {measured['automatic']}")
    wanted = [name for name in bench_stage.RENDERERS if name not in left_out]
    assert list(rows) == [name for name in wanted if name != bench_stage.OPEN3D or name in rows]
    for name, figures in rows.items():
        print(name, figures)
        assert name == bench_stage.EWA or min(figures[time] for time in bench_stage.TIMES) > 0
        assert figures["unfilled"] < 0.02 or name == POINTS
        assert (figures["normal_95"] is None) == (figures["normal_mean"] is None)
        assert (figures["normal_mean"] is None) == (name in (*bench_stage.PEERS, bench_stage.MESH))
    assert all(rows[name]["normal_mean"] < 2 for name in (*bench_stage.OURS, bench_stage.ALGEBRAIC, bench_stage.EWA))
    assert rows[bench_stage.EWA]["psnr"] > rows[bench_stage.GAUSSIAN]["psnr"] + 5  # lit and placed as the others are
    # the mesh is the truth but for what supersampling does at its outline; the peers are rough
    assert rows[bench_stage.MESH]["depth"] < 1e-4
    assert rows[bench_stage.MESH]["psnr"] > max(rows[peer]["psnr"] for peer in bench_stage.PEERS if peer in rows) + 5
    # larger points cover more, and vtkPointFillPass fills what points of a pixel leave
    unfilled = [rows[name]["unfilled"] for name in bench_stage.POINTS]
    assert unfilled == sorted(unfilled, reverse=True) and unfilled[0] > 0.02 > 0.002 > rows[bench_stage.FILL]["unfilled"]
    assert rows[bench_stage.FILL]["psnr"] > rows[POINTS]["psnr"] + 5
    # the fit is of the first frame alone
    fitted = rows[bench_stage.ALGEBRAIC]
    assert fitted["first_milliseconds"] > 5 * fitted["milliseconds"]


def test_isosurface_is_made_anew_in_every_frame(monkeypatch):
    monkeypatch.setitem(bench_stage.ISOSURFACES, "small", bench_scenes.Isosurface(lambda: gyroid_ball(32), 0))
    monkeypatch.setattr(bench_stage, "FRAMES", 2)
    values = []
    move = bench_stage.IsosurfaceStage.move

    def follow(stage, frame):
        move(stage, frame)
        values.append(stage.extract.GetValue(0))

    monkeypatch.setattr(bench_stage.IsosurfaceStage, "move", follow)
    rows = bench_stage.measure_case(Case("small", 0, 64))["rows"]
    assert list(rows) == [*bench_stage.OURS, bench_stage.FLYING_EDGES]
    print({name: row["psnr"] for name, row in rows.items()})
    assert all(row["frames"] == 2 and row["psnr"] > 15 for row in rows.values())
    one = values[1 : 3 + bench_stage.WARM_UP + 2]  # of the first renderer, between two at the value asked for
    assert one[0] == one[-1] == 0 and sorted(set(one)) == one[:-1]
    # the image of the truth is of the same mesh
    assert rows[bench_stage.FLYING_EDGES]["psnr"] > max(rows[name]["psnr"] for name in bench_stage.OURS)


def test_points_whose_radii_grow_along_x():
    """By a count of those in a slice of the sphere, whose area is even along x: the spacing that their radii tell."""
    cloud = bench_scenes.make_points(bench_scenes.make_mesh("sphere"), 50_000, bench_scenes.SPREADS["sphere, radii 1 to 10"])
    points, radii = vtk_to_numpy(cloud.GetPoints().GetData()), vtk_to_numpy(cloud.GetPointData().GetArray("radius"))
    assert abs(len(points) - 50_000) < 1500
    assert abs(radii.max() / radii.min() - 10) < 0.3
    x = points[:, 0] - points[:, 0].min()
    for low in (0, 0.45, 0.9):  # of a diameter of 1
        inside = (x >= low) & (x < low + 0.1)
        spacing = (0.1 * 3.14159 / inside.sum()) ** 0.5
        assert 0.9 < radii[inside].mean() / (1.5 * spacing) < 1.1, low
    assert cloud.GetPointData().GetNormals() is not None
    bare = bench_scenes.make_points(bench_scenes.make_mesh("sphere"), 100, bench_scenes.SPREADS["sphere, no normals"])
    assert bare.GetPointData().GetNormals() is None and bare.GetNumberOfPoints() == 100


def test_noisy_points():
    """Their distances from the centre of a sphere of radius 0.5."""
    spread = bench_scenes.SPREADS["sphere, no normals, noise 0.5"]
    cloud = bench_scenes.make_points(bench_scenes.make_mesh("sphere"), 10_000, spread)
    points = vtk_to_numpy(cloud.GetPoints().GetData())
    spacing = (3.14159 / 10_000) ** 0.5
    assert points.dtype == "float32" and 0.48 < ((points**2).sum(axis=1) ** 0.5).std() / spacing < 0.52


def test_open3d_where_it_is_there():
    """Its picture is that of points of VTK, whose size is the same."""
    if bench_stage.OPEN3D not in bench_stage.PEERS:
        pytest.skip("Open3D is not installed")
    stage = bench_stage.Stage(Case("sphere", 20_000, 128))
    truth = stage.truth()
    figures = stage.measure(bench_stage.OPEN3D, truth)
    if figures is None:
        pytest.skip("Open3D finds no graphics driver")
    points = stage.measure("points of OpenGL, 2 px", truth)
    print(figures, points)
    assert figures["milliseconds"] > 0 and figures["processor_milliseconds"] > 0 and figures["normal_mean"] is None
    assert abs(figures["psnr"] - points["psnr"]) < 3 and abs(figures["iou"] - points["iou"]) < 0.02
    assert figures["depth"] < 2 * points["depth"]


@pytest.mark.parametrize(
    ("does", "reason"), [("raise RuntimeError('no driver')", "no driver"), ("import time; time.sleep(60)", "over 2 seconds")]
)
def test_open3d_that_cannot_draw_is_left_out(tmp_path, monkeypatch, capsys, does, reason):
    monkeypatch.setattr(bench_stage, "OPEN3D_SECONDS", 2)
    (tmp_path / "open3d.py").write_text(does)
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
    stage = bench_stage.Stage(Case("sphere", 100, 32))
    assert stage.measure(bench_stage.OPEN3D, None) is None
    said = capsys.readouterr().err
    assert "Open3D is left out" in said and reason in said


def test_frames_that_take_long_are_fewer(monkeypatch):
    warm_up, frames = bench_stage.WARM_UP, bench_stage.FRAMES
    assert frames >= 20
    stage = bench_stage.Stage(Case("sphere", 100, 32))
    drawn = []
    monkeypatch.setattr(bench_stage, "_time_frame", lambda window: drawn.append(len(drawn)) or (1.0 + len(drawn), 2.0))
    assert stage._time_frames(None) == [warm_up + (frames + 1) / 2 + 1, 2.0, frames]
    assert len(drawn) == warm_up + frames
    drawn.clear()
    monkeypatch.setattr(bench_stage, "MOST_SECONDS", 0.1)
    monkeypatch.setattr(bench_stage, "_time_frame", lambda window: time.sleep(0.07) or drawn.append(1) or (len(drawn), 2.0))
    assert stage._time_frames(None) == [warm_up + 1, 2.0, 1]  # one after warm-up


@pytest.mark.parametrize("scene", bench_scenes.SCENES)
def test_scenes_have_triangles_and_normals(scene):
    mesh = bench_scenes.make_mesh(scene)
    assert mesh.GetNumberOfPolys() > 1000
    assert mesh.GetPolys().GetMaxCellSize() == 3
    assert mesh.GetPointData().GetNormals() is not None


def options(folder, **others):
    return types.SimpleNamespace(**{"files": [], "full": False, "output": str(folder), "measure": None, "data": None, **others})


def test_a_run_goes_on_where_it_was_stopped(tmp_path, monkeypatch, capsys):
    cases = [Case("torus", count, 64) for count in (1000, 10_000)]
    figures = figures_of_all()
    measured = []

    def measure(case):
        if len(measured) == 1:
            raise KeyboardInterrupt
        measured.append(case)
        return figures

    monkeypatch.setattr(bench, "quick_cases", lambda: cases)
    monkeypatch.setattr(bench, "_measure_apart", measure)
    with pytest.raises(KeyboardInterrupt):
        bench.run(options(tmp_path))
    assert list(json.loads((tmp_path / "results.json").read_text())) == [str(cases[0])]
    stopped = "1 of 2 measurements are made"
    assert stopped in (tmp_path / "RESULTS.md").read_text()

    monkeypatch.setattr(bench, "_measure_apart", lambda case: measured.append(case) or figures)
    bench.run(options(tmp_path))
    assert measured == cases
    said = capsys.readouterr().out
    assert "RESULTS.md" in said and "Measured in 2.0 minutes" in said
    report = (tmp_path / "RESULTS.md").read_text()
    assert stopped not in report
    assert "By `python3 -m pointsurface bench`, on a renderer, in 2 minutes" in report
    assert "### Torus, 10000 points, 64 x 64" in report and f"| {bench_stage.OURS[0]} * | 2.0 | 1.0 | 1 | 1 | 20.00 |" in report
    rows = (tmp_path / "results.csv").read_text().splitlines()
    assert len(rows) == 1 + 2 * len(figures["rows"])
    assert {"normal_95", "frames", "first_milliseconds"} < set(rows[0].split(","))
    pictures = {name for name in os.listdir(tmp_path) if name.endswith(".png")}
    own = {"torus-1000-points-64-x-64.png", "torus-10000-points-64-x-64.png"}
    assert pictures == own | {"RESULTS.png", "RESULTS-points.png", "RESULTS-density.png"}
    assert all(f"]({name})" in report for name in pictures - own)
    assert all(f"]({name})" not in report for name in own)


def test_shared_models_are_measured_by_their_names(tmp_path, monkeypatch):
    """In a folder that an option names, or the environment; the program in Testing/Benchmarks finds that beside the project."""
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "a.vtp").write_text("")
    (tmp_path / "volumes").mkdir()
    (tmp_path / "volumes" / "ct-head-promed0051.vti").write_text("")
    monkeypatch.setenv("POINTSURFACE_SHARED_DATA", "")
    scenes = {case.scene for case in bench.full_cases([])}
    assert "a" not in scenes and not any("head" in scene for scene in scenes)
    seen = []
    monkeypatch.setattr(bench, "_measure_apart", lambda case: seen.append(case.scene) or figures_of_all())
    monkeypatch.setattr(bench, "write_report", lambda folder, measured, wanted, command: seen.append(command))
    bench.run(options(tmp_path / "results", full=True, data=str(tmp_path)))
    assert {"a", "isosurface of a CT head, bone"} < set(seen) and "isosurface of an MR head" not in seen
    assert seen[-1] == "python3 -m pointsurface bench --full"
    assert len(seen) < 60 and scenes < set(seen)

    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Benchmarks", "bench.py")
    run = subprocess.run([sys.executable, program, "--help"], capture_output=True, text=True)
    assert run.returncode == 0 and "--data" in run.stdout and "EWA" in run.stdout


def test_a_case_that_fails_or_takes_too_long_is_left_out(tmp_path, monkeypatch, capsys):
    cases = [Case(name, 1000, 64) for name in ("no-such-file.ply", "sphere")]
    monkeypatch.setattr(bench, "quick_cases", lambda: cases)
    with pytest.raises(WrongUse, match="not measured, see above: no-such-file.ply, 1000 points"):
        bench.run(options(tmp_path))
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


@pytest.mark.parametrize("text", ["{", '{"torus": {"mesh": {}}}'])
def test_a_file_that_is_no_results(tmp_path, text):
    (tmp_path / "results.json").write_text(text)
    with pytest.raises(WrongUse, match="remove it"):
        bench.run(options(tmp_path))
