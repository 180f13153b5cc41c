# SPDX-License-Identifier: BSD-3-Clause
"""The command convert as a user types it, read back; and files that are there whole or not at all."""

import json
import os
import signal
import subprocess
import sys
import types

import numpy as np
import pytest
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLPolyDataWriter

from pointsurface import progress, readers, writers

RADIUS = 3.0


def pointsurface(*arguments):
    return subprocess.run([sys.executable, "-m", "pointsurface", *map(str, arguments)], capture_output=True, text=True)


def sphere_points(count=3000):
    """Even points of a sphere around (100, 0, 0), and their outward normals."""
    i = np.arange(count) + 0.5
    z, angle = 1 - 2 * i / count, np.pi * (1 + 5**0.5) * i
    ring = np.sqrt(1 - z * z)
    normals = np.stack([ring * np.cos(angle), ring * np.sin(angle), z], axis=1)
    return RADIUS * normals + (100, 0, 0), normals


def named(values, name):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    return array


def make_cloud(points):
    cloud = vtkPolyData()
    cloud.SetPoints(vtkPoints())
    cloud.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    return cloud


def write(writer, data, path):
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    writer.Write()
    return path


@pytest.fixture(scope="module")
def bare(tmp_path_factory):
    """Points in single precision, nothing else."""
    cloud = make_cloud(sphere_points()[0].astype(np.float32))
    return write(vtkXMLPolyDataWriter(), cloud, tmp_path_factory.mktemp("bare") / "bare.vtp")


@pytest.fixture(scope="module")
def rich(tmp_path_factory):
    """Points in double precision with colours and a measurement."""
    points, normals = sphere_points()
    cloud = make_cloud(points)
    colors = np.rint(255 * (0.5 + 0.5 * normals)).astype(np.uint8)
    cloud.GetPointData().SetScalars(named(colors, "RGB"))
    cloud.GetPointData().AddArray(named(points[:, 2], "height"))
    return write(vtkXMLPolyDataWriter(), cloud, tmp_path_factory.mktemp("rich") / "rich.vtp")


@pytest.fixture(scope="module")
def volume(tmp_path_factory):
    """A volume whose isosurface at 0 is a sphere of radius 10."""
    axis = np.arange(-14.0, 15.0)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    image = vtkImageData()
    image.SetDimensions(29, 29, 29)
    image.SetOrigin(-14, -14, -14)
    image.GetPointData().SetScalars(named((10 - np.sqrt(x**2 + y**2 + z**2)).ravel().astype(np.float32), "distance"))
    return write(vtkXMLImageDataWriter(), image, tmp_path_factory.mktemp("volume") / "ball.vti")


def converted(source, output, *options):
    result = pointsurface("convert", source, output, *options)
    assert result.returncode == 0, result.stderr
    cloud = readers.read(str(output))
    arrays = cloud.GetPointData()
    names = [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())]
    return vtk_to_numpy(cloud.GetPoints().GetData()), {name: vtk_to_numpy(arrays.GetArray(name)) for name in names}


@pytest.mark.parametrize("extension", ["vtp", "ply", "xyz"])
def test_volume_to_points(volume, tmp_path, extension):
    points, arrays = converted(volume, tmp_path / f"points.{extension}", "--isovalue", 0)
    assert len(points) > 1000
    distance = np.linalg.norm(points, axis=1)
    assert np.abs(distance - 10).max() < 0.05
    (normals,) = [values for name, values in arrays.items() if name.lower() == "normals"]
    assert np.sum(normals * points, axis=1).min() > 0.98 * 10, "outward"
    assert ("radius" in arrays) == (extension == "vtp")


@pytest.mark.parametrize("extension", ["vtp", "ply", "xyz"])
def test_normals(bare, tmp_path, extension):
    points, arrays = converted(bare, tmp_path / f"normals.{extension}", "--to", "normals")
    expected, truth = sphere_points()
    assert points == pytest.approx(expected, abs=1e-4), "in the order of the file"
    (normals,) = arrays.values()
    assert np.sum(normals * truth, axis=1).min() > 0.99


def test_radii(bare, tmp_path):
    _, arrays = converted(bare, tmp_path / "radii.vtp", "--to", "radii")
    spacing = np.sqrt(4 * np.pi * RADIUS**2 / 3000)
    assert list(arrays) == ["radius"]
    assert 0.8 * spacing < np.median(arrays["radius"]) < 3 * spacing
    _, wider = converted(bare, tmp_path / "wider.vtp", "--to", "radii", "--neighbors", 40)
    assert not np.array_equal(wider["radius"], arrays["radius"])


def test_what_the_file_has_is_kept_or_made_anew(tmp_path):
    """Normals and radii of the file, if no neighbours are told."""
    points, truth = sphere_points()
    cloud = make_cloud(points.astype(np.float32))
    cloud.GetPointData().SetNormals(named(np.tile(np.float32([0, 0, 1]), (len(points), 1)), "Normals"))
    cloud.GetPointData().AddArray(named(np.full(len(points), 9, np.float32), "radius"))
    path = write(vtkXMLPolyDataWriter(), cloud, tmp_path / "told.vtp")
    for content, name, is_made in (
        ("normals", "Normals", lambda normals: np.sum(normals * truth, axis=1).min() > 0.99),
        ("radii", "radius", lambda radii: radii.max() < 1),
    ):
        kept = converted(path, tmp_path / "kept.vtp", "--to", content)[1][name]
        assert np.array_equal(kept, vtk_to_numpy(cloud.GetPointData().GetArray(name)))
        made = converted(path, tmp_path / "made.vtp", "--to", content, "--neighbors", 12)[1][name]
        assert is_made(made)


def test_splats_of_the_lowest_order_that_will_do(bare, tmp_path):
    orders = [
        set(converted(bare, tmp_path / "splats.vtp", "--to", "splats", "--order", 3, *tolerance)[1]["SplatOrder"])
        for tolerance in ((), ("--tolerance", RADIUS), ("--tolerance", 1e-3 * RADIUS))
    ]
    assert orders[:2] == [{3}, {1}] and max(orders[2]) > 1


def test_splats(bare, tmp_path):
    points, arrays = converted(bare, tmp_path / "splats.vtp", "--to", "splats", "--order", 2)
    assert 20 < len(points) < 1000
    assert arrays["SplatCoefficients"].shape[1] == 6 and set(arrays["SplatOrder"]) == {2}
    assert arrays["Residual"].max() < 0.01 * RADIUS
    picture = tmp_path / "splats.png"
    result = pointsurface("render", tmp_path / "splats.vtp", picture, "--method", "algebraic-splats", "--json")
    assert result.returncode == 0, result.stderr
    assert json.loads(result.stdout)["points"] == len(points), "what are splats already is drawn as it is"


def test_colors_and_what_a_format_cannot_hold(rich, tmp_path):
    points, normals = sphere_points()
    for extension in ("ply", "xyz", "vtp"):
        output = tmp_path / f"rich.{extension}"
        result = pointsurface("convert", rich, output, "--json")
        assert result.returncode == 0, result.stderr
        report = json.loads(result.stdout)
        cloud = readers.read(str(output))
        assert report["points"] == len(points)
        assert (report["left_out"] == []) == (extension == "vtp")
        assert any('"height"' in text for text in report["left_out"]) == (extension != "vtp")
        colors = vtk_to_numpy(cloud.GetPointData().GetScalars())
        assert np.array_equal(colors, np.rint(255 * (0.5 + 0.5 * normals)))
        assert vtk_to_numpy(cloud.GetPoints().GetData()) == pytest.approx(points, abs=1e-5 if extension == "ply" else 1e-14)


@pytest.mark.parametrize("extension", ["vtp", "ply", "xyz"])
def test_far_coordinates_keep_their_digits(tmp_path, extension):
    points = sphere_points()[0] + (4e6, 0, 0)
    path = tmp_path / f"far.{extension}"
    assert writers.write_cloud(str(path), make_cloud(points)) == []
    if extension == "ply":  # VTK's reader rounds
        content = path.read_bytes()
        found = np.frombuffer(content[content.index(b"end_header\n") + 11 :], "<f8").reshape(-1, 3)
    else:
        found = vtk_to_numpy(readers.read(str(path)).GetPoints().GetData())
    assert np.array_equal(found, points)


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["{bare}", "out.stl"], "out.stl has an unknown extension; known for writing are vtp, ply, xyz"),
        (["{bare}", "absent/out.vtp"], "absent is no folder"),
        (["{bare}", "out.ply", "--to", "radii"], "out.ply cannot hold radii; a file of the extension vtp can"),
        (["{bare}", "out.xyz", "--to", "splats"], "cannot hold splats"),
        (["{bare}", "out.vtp", "--to", "mesh"], "mesh"),
        (["{bare}", "out.vtp", "--order", "2"], "--order is of splats"),
        (["{bare}", "out.vtp", "--neighbors", "9"], "--neighbors needs"),
        (["{bare}", "out.vtp", "--to", "splats", "--order", "5"], "5 is no whole number of 1 to 4"),
        (["{bare}", "out.vtp", "--to", "normals", "--neighbors", "-3"], "-3 is no whole number of 4 or more"),
        (["{bare}", "out.vtp", "--isovalue", "1"], "is no volume"),
        (["{volume}", "out.vtp", "--isovalue", "1000"], "no surface at isovalue 1000"),
        (["absent.ply", "out.vtp"], "absent.ply does not exist"),
    ],
)
def test_wrong_use(bare, volume, tmp_path, arguments, words):
    paths = [text.format(bare=bare, volume=volume) for text in arguments]
    result = subprocess.run(
        [sys.executable, "-m", "pointsurface", "convert", *paths], capture_output=True, text=True, cwd=tmp_path
    )
    assert result.returncode == 2, result.stderr
    assert words in result.stderr and result.stderr.count("\n") == 1 and result.stdout == ""
    assert os.listdir(tmp_path) == []


@pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="needs a folder that nobody may write to")
def test_folder_that_may_not_be_written(bare):
    result = pointsurface("convert", bare, "/proc/out.vtp")
    assert result.returncode == 2
    assert result.stderr.splitlines()[-1].startswith("pointsurface: /proc/out.vtp: ")
    assert "Traceback" not in result.stderr


def test_full_disk(tmp_path):
    with pytest.raises(OSError, match="out.xyz") as caught:
        with writers.whole_file(str(tmp_path / "out.xyz")):
            raise OSError("3 requested and 2 written")
    assert caught.value.strerror == "3 requested and 2 written"
    assert os.listdir(tmp_path) == []


def interruptible():
    signal.signal(signal.SIGINT, signal.default_int_handler)  # shells ignore it in the background


def test_interrupt_leaves_no_file(tmp_path):
    points, normals = sphere_points(200_000)
    cloud = make_cloud(points)
    cloud.GetPointData().SetNormals(named(normals.astype(np.float32), "Normals"))
    path = write(vtkXMLPolyDataWriter(), cloud, tmp_path / "large.vtp")
    output = tmp_path / "out.vtp"
    output.write_text("of an earlier run")
    command = [sys.executable, "-m", "pointsurface", "convert", path, output, "--to", "splats", "--order", "4"]
    process = subprocess.Popen(
        [*map(str, command), "--neighbors", "400"], stderr=subprocess.PIPE, text=True, preexec_fn=interruptible
    )
    said = []
    for line in process.stderr:
        said.append(line)
        if "fitting splats" in line:
            process.send_signal(signal.SIGINT)
            break
    rest = process.stderr.read()
    assert process.wait(timeout=120) == 130, said + [rest]
    assert "Traceback" not in rest and "writing" not in rest
    assert sorted(os.listdir(tmp_path)) == ["large.vtp", "out.vtp"]
    assert output.read_text() == "of an earlier run"


def test_interrupt_while_writing(tmp_path):
    (tmp_path / "kept.vtp").write_text("whole")
    with pytest.raises(KeyboardInterrupt):
        with writers.whole_file(str(tmp_path / "kept.vtp")) as temporary:
            with open(temporary, "w", encoding="utf-8") as file:
                file.write("ha")
            raise KeyboardInterrupt
    assert os.listdir(tmp_path) == ["kept.vtp"]
    assert (tmp_path / "kept.vtp").read_text() == "whole"


class Terminal:
    """Standard error that is a terminal."""

    def __init__(self):
        self.text = ""

    def isatty(self):
        return True

    def write(self, text):
        self.text += text

    def flush(self):
        pass


def test_progress_takes_a_bar_where_there_is_one(monkeypatch):
    moves = []

    class Bar:
        def __init__(self, **options):
            self.n = 0
            moves.append(options["desc"])

        def __enter__(self):
            return self

        def __exit__(self, *_):
            moves.append("end")

        def update(self, amount):
            self.n += amount
            moves.append(round(self.n, 3))

    monkeypatch.setitem(sys.modules, "tqdm", types.SimpleNamespace(tqdm=Bar))
    monkeypatch.setattr(sys, "stderr", Terminal())
    with progress.shown("reading") as show:
        show(0.25)
        show(0.75)
    assert moves == ["reading", 0.25, 0.75, "end"]


def test_progress_is_a_line_a_second_without_a_bar(monkeypatch):
    now = iter((0.0, 0.5, 1.25, 1.25, 2.0))
    monkeypatch.setattr(progress.time, "monotonic", lambda: next(now))
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setitem(sys.modules, "tqdm", None)
    with progress.shown("reading") as show:
        for fraction in (0.2, 0.4, 0.6):
            show(fraction)
    assert terminal.text == "reading: 40% ...\n"


NOISY = """
import itertools, os, sys
from pointsurface import formats, progress, readers

progress.time.monotonic = itertools.count().__next__  # a second each time that it is asked
formats.FORMATS["vtp"] = formats.FORMATS["vtp"]._replace(prints=2)
make_reader = formats.make_reader


def make_noisy(form, path):
    reader = make_reader(form, path)
    reader.AddObserver("StartEvent", lambda *_: os.write(2, b"noise"))
    return reader


formats.make_reader = make_noisy
readers.read(sys.argv[1], tell=True)
os.write(2, b"heard")
"""


def test_progress_is_seen_where_a_reader_prints(bare):
    """What it prints itself is not, until it has ended."""
    said = subprocess.run([sys.executable, "-c", NOISY, str(bare)], capture_output=True, text=True).stderr
    assert f"reading {bare}: " in said
    assert "noise" not in said
    assert said.endswith("heard")
