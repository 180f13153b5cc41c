# SPDX-License-Identifier: BSD-3-Clause
"""The commands render and info as a user types them."""

import argparse
import json
import os
import re
import signal
import subprocess
import sys
from ctypes.util import find_library
from unittest.mock import ANY

import numpy as np
import pytest
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

import pointsurface as pointsurface_module
from pointsurface import bench, convert, demo, info, render, view
from pointsurface.methods import METHODS
from pointsurface.passes import PASSES
from pointsurface.readers import read
from pointsurface.rendering import offscreen_window, read_color
from pointsurface.scene import place_camera


def pointsurface(*arguments, **environment):
    return subprocess.run(
        [sys.executable, "-m", "pointsurface", *map(str, arguments)],
        env={**os.environ, **environment}, capture_output=True, text=True,
    )  # fmt: skip


def draw(*arguments):
    """What render reports, as JSON if that is asked for."""
    result = pointsurface("render", *arguments)
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout) if "--json" in arguments else result.stdout


def check_fault(result, *words, code=2):
    """One line that says what is wrong."""
    assert result.returncode == code, result.stderr
    assert result.stdout == "" and result.stderr.count("\n") == 1, result.stderr
    for word in words:
        assert word in result.stderr


def read_png(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1).astype(int)


def covered(path):
    """Where a picture on white shows something."""
    return (read_png(path) < 250).any(axis=2)


@pytest.fixture(scope="module")
def half_sphere(tmp_path_factory):
    """The half x > 0 of a sphere around the origin, with an array "z"."""
    source = vtkSphereSource()
    source.SetThetaResolution(200)
    source.SetPhiResolution(100)
    source.SetStartTheta(270)
    source.SetEndTheta(89.9)
    source.Update()
    cloud = source.GetOutput()
    z = numpy_to_vtk(vtk_to_numpy(cloud.GetPoints().GetData())[:, 2].copy(), deep=True)
    z.SetName("z")
    cloud.GetPointData().AddArray(z)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(cloud)
    path = tmp_path_factory.mktemp("cloud") / "half.vtp"
    writer.SetFileName(str(path))
    writer.Write()
    return path


def test_render(half_sphere, tmp_path):
    picture = tmp_path / "half.png"
    result = pointsurface(
        "render", half_sphere, picture, "--size", "120x90", "--view", "front", "--color", "#00ff00", "--radius", "0.012",
        "--background", "white", "--json",
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    report = json.loads(result.stdout)
    assert report["points"] > 5000 and report["method"] == "pull-push" and report["renderer"]
    assert all(milliseconds >= 0 for milliseconds in report["milliseconds"].values())
    image = read_png(picture)
    assert image.shape == (90, 120, 3)
    covered = image[:, :, 0] < 200
    assert (image[0, 0] == 255).all()
    green = image[covered]
    assert (green[:, 1] > green[:, 0]).all()
    # seen from the front, half of a disc, as high as it is wide twice
    rows, columns = covered.any(axis=1).sum(), covered.any(axis=0).sum()
    assert rows == pytest.approx(2 * columns, abs=8)  # in perspective the open side is seen a little from within
    assert covered.sum() == pytest.approx(np.pi / 4 * rows * columns, rel=0.06)


@pytest.mark.skipif("POINTSURFACE_SHARED_DATA" not in os.environ, reason="the shared models are not at hand")
def test_dragon_covers_what_its_mesh_covers(tmp_path):
    shared = os.environ["POINTSURFACE_SHARED_DATA"]
    picture = tmp_path / "dragon.png"
    report = draw(os.path.join(shared, "clouds", "dragon.vtp"), picture, "--background", "white", "--json")
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(read(os.path.join(shared, "meshes", "dragon.vtp")))
    actor, renderer = vtkActor(), vtkRenderer()
    actor.SetMapper(mapper)
    renderer.AddActor(actor)
    window = offscreen_window(renderer, (800, 600))
    place_camera(renderer, report["camera"])
    mesh = read_color(window).any(axis=2)
    assert mesh.sum() > 50_000
    assert (covered(picture) ^ mesh).sum() < 0.03 * mesh.sum()


def test_scalars_and_view(half_sphere, tmp_path):
    picture = tmp_path / "half.png"
    result = pointsurface("render", half_sphere, picture, "--size", "90x90", "--view", "right", "--scalars", "z")
    assert result.returncode == 0, result.stderr
    assert result.stdout == ""
    image = read_png(picture)
    bottom, top = image[20, 45], image[70, 45]  # row 0 is the lowest
    assert bottom[2] > bottom[0] + 30, "low is blue"
    assert top[0] > top[2] + 30, "high is red"


def test_help():
    """Of each command, with a word on every option; and what the exit codes mean."""
    result = pointsurface("--help")
    assert result.returncode == 0 and "Exit codes: 0 done" in result.stdout
    for command in (bench, convert, demo, info, render, view):
        name = command.__name__.split(".")[1]
        assert re.search(rf"^    {name} +\w", result.stdout, re.M) and command.__doc__
        parser = argparse.ArgumentParser()
        command.add_arguments(parser)
        assert [action.dest for action in parser._actions if not action.help] == []
        parser.format_help()


def test_info(half_sphere):
    result = pointsurface("info", half_sphere, "--json")
    assert result.returncode == 0, result.stderr
    content = json.loads(result.stdout)
    assert content["kind"] == "points"
    assert content["bounds"][:2] == pytest.approx([0, 0.5], abs=1e-3)
    arrays = {array["name"]: array for array in content["arrays"]}
    assert arrays["z"]["range"] == pytest.approx([-0.5, 0.5])
    assert arrays["z"]["components"] == 1
    text = pointsurface("info", half_sphere).stdout
    assert "radii        none: a mapper estimates them" in text
    assert "normals      of the file" in text


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["--scalars", "w"], 'no point array "w"; it has: Normals, z'),
        (["--color", "mud"], "mud is no colour"),
        (["--radius", "-1"], "-1 is no number over 0"),
        (["--method", "magic"], "magic"),
        (["--isovalue", "3"], "is no volume"),
        (["--supersampling", "9"], "9"),
        (["--cmap", "gray"], "--cmap is of an array: it needs --scalars"),
        (["--range", "0,1"], "--range is of an array"),
        (["--scalars", "z", "--range", "1,0"], "1,0 is no range"),
        (["--clip", "0,0,0"], "a plane's normal is not 0,0,0"),
        (["--clip", "1,0"], "1,0 is not 3 finite numbers"),
        (["--clip", "1,0,0@1,2"], "1,2 is not 3 finite numbers"),
        (["--clip", "1,0,0"] * 7, "7 planes to clip by are more than six"),
        (["--light", "10"], "10 is not 2 or 3 finite numbers"),
        (["--light", "0,0,-1"], "an intensity is over 0"),
        (["--pass", "blur"], "blur"),
        (["--view", "front", "--camera", "c.json"], "--camera"),
        (["--orbit", "1"], "1 is no whole number of 2 or more"),
        (["--orbit", "8"], "p.png is the name of one picture"),
    ],
)
def test_wrong_use(half_sphere, tmp_path, arguments, words):
    check_fault(pointsurface("render", half_sphere, tmp_path / "p.png", *arguments), words)
    assert not os.path.exists(tmp_path / "p.png")


def test_folder_that_is_not_there(half_sphere, tmp_path):
    check_fault(pointsurface("render", half_sphere, tmp_path / "absent" / "p.png"), "is no folder")
    check_fault(pointsurface("render", half_sphere, tmp_path / "p.gif"), "p.gif is for an animation: it needs --orbit")
    check_fault(pointsurface("render", half_sphere, tmp_path / "p.jpg"), "p.jpg does not end with .png")


def test_cut_and_seen_from_above(half_sphere, tmp_path):
    whole, cut = tmp_path / "whole.png", tmp_path / "cut.png"
    options = ("--size", "90x90", "--view", "right", "--background", "white", "--radius", "0.012")
    draw(half_sphere, whole, *options)
    draw(half_sphere, cut, *options, "--clip=0,0,1", "--clip=0,-1,0@0,0.2,0")
    everywhere, kept = covered(whole), covered(cut)
    rows, columns = np.nonzero(kept)
    # seen along -x, y to the right and z up: what is left is z > 0 and y < 0.2
    assert not kept[:44].any() and kept[46:].any()
    assert columns.max() < 45 + 0.2 / 0.5 * 30 + 4
    assert kept.sum() == pytest.approx(everywhere.sum() * 0.5 * 0.75, rel=0.1)
    assert not (kept & ~everywhere).any()


def test_camera_file_gives_the_picture_again(half_sphere, tmp_path):
    first, again, turned = (tmp_path / f"{name}.png" for name in ("first", "again", "turned"))
    report = draw(half_sphere, first, "--size", "90x90", "--view", "iso", "--json")
    (tmp_path / "camera.json").write_text(json.dumps(report))
    assert draw(half_sphere, again, "--size", "90x90", "--camera", tmp_path / "camera.json", "--json") == {
        **report, "pictures": [str(again)], "milliseconds": ANY
    }  # fmt: skip
    assert np.array_equal(read_png(first), read_png(again))
    camera = {**report["camera"], "view_angle": 60}
    (tmp_path / "camera.json").write_text(json.dumps(camera))
    draw(half_sphere, turned, "--size", "90x90", "--camera", tmp_path / "camera.json")
    background = read_png(first)[0, 0]
    seen = [(read_png(path) != background).any(axis=2).sum() for path in (first, turned)]
    ratio = (np.tan(np.radians(30)) / np.tan(np.radians(report["camera"]["view_angle"] / 2))) ** 2
    assert seen[0] / seen[1] == pytest.approx(ratio, rel=0.1)


@pytest.mark.parametrize(
    "camera, words",
    [
        ("{", "is no JSON"),
        ("[1]", 'has no "position" of three numbers'),
        ('{"position": [1, 2, 3], "focal_point": [0, 0, "a"]}', 'has no "focal_point"'),
        ('{"position": [1, 2, 3], "focal_point": [0, 0, 0], "view_up": [0, 0, 1], "view_angle": -3}', '"view_angle"'),
    ],
)
def test_wrong_camera_file(half_sphere, tmp_path, camera, words):
    (tmp_path / "camera.json").write_text(camera)
    check_fault(pointsurface("render", half_sphere, tmp_path / "p.png", "--camera", tmp_path / "camera.json"), words)
    check_fault(pointsurface("render", half_sphere, tmp_path / "p.png", "--camera", tmp_path / "absent.json"), "absent")


def test_light(half_sphere, tmp_path):
    picture = tmp_path / "p.png"
    options = ("--size", "90x90", "--view", "right", "--color", "white")

    def brightness_of_sides(*light):
        draw(half_sphere, picture, *options, *light)
        image = read_png(picture).mean(axis=2)
        return image[45, 25], image[45, 65]

    left, right = brightness_of_sides("--light=-70,0")
    assert left > right + 60
    left, right = brightness_of_sides("--light=70,0", "--light=70,0,0.1")
    assert right > left + 60
    dim = brightness_of_sides("--light=70,0,0.5")[1]
    assert dim < right - 30


def test_color_map_and_range(half_sphere, tmp_path):
    picture = tmp_path / "p.png"
    options = ("--size", "90x90", "--view", "right", "--scalars", "z", "--light", "0,0")
    draw(half_sphere, picture, *options, "--cmap", "gray", "--range=-0.5,0")
    image = read_png(picture)
    assert (np.ptp(image[20:70, 45], axis=1) < 6).all(), "no colour"
    assert image[25, 45].max() < 130 and image[60, 45].min() > 160, "white from the middle on"
    draw(half_sphere, picture, *options, "--cmap", "viridis")
    low, high = read_png(picture)[20, 45], read_png(picture)[70, 45]
    assert low[2] > low[1], "violet"
    assert high[1] > high[2] + 60 and high[0] > high[2], "yellow"


def changed_sphere(half_sphere, path, change):
    """The half sphere with its points changed; it is read back from a file."""
    cloud = read(str(half_sphere))
    change(vtk_to_numpy(cloud.GetPoints().GetData()), cloud.GetPointData())
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(cloud)
    writer.SetFileName(str(path))
    writer.Write()
    return path


def test_radii_and_samples(half_sphere, tmp_path):
    """Discs of a radius that is told, scaled; and samples, of which outlines are smooth."""
    picture = tmp_path / "p.png"
    options = ("--size", "200x200", "--view", "right", "--background", "white", "--color", "black")
    shares = []
    for radius in ((), ("--radius", "0.001"), ("--radius", "0.001", "--radius-scale", "20"), ("--radius-scale", "0.05")):
        draw(half_sphere, picture, *options, *radius)
        shares.append(covered(picture).mean())
    assert shares[2] == pytest.approx(shares[0], rel=0.01)
    assert max(shares[1], shares[3]) < 0.97 * shares[0], "discs of a fraction of a pixel leave gaps, and end at the outline"
    between = []
    for samples in (1, 4):
        draw(half_sphere, picture, *options, "--supersampling", samples)
        gray = read_png(picture).max(axis=2)
        between.append(((gray > 150) & (gray < 250)).sum())
    assert between[0] < 20 < 60 < between[1], "pixels between the surface's colour and the background's"


def test_parallel_camera_file(half_sphere, tmp_path):
    seen = []
    for scale in (0.6, 1.2):
        camera = {"position": [5, 0, 0], "focal_point": [0, 0, 0], "view_up": [0, 0, 1], "parallel_scale": scale}
        (tmp_path / "camera.json").write_text(json.dumps(camera))
        options = ("--size", "90x90", "--camera", tmp_path / "camera.json", "--background", "white", "--json")
        report = draw(half_sphere, tmp_path / "p.png", *options)
        assert report["camera"] == camera
        seen.append(covered(tmp_path / "p.png").sum())
    assert seen[0] == pytest.approx(np.pi * (0.5 * 45 / 0.6) ** 2, rel=0.05)
    assert seen[1] == pytest.approx(seen[0] / 4, rel=0.1)


def test_scalars_that_are_vectors_or_not_finite(half_sphere, tmp_path):
    """Vectors count by their length; a range is that of finite values."""

    def measure(points, data):
        values = points[:, 2].copy()
        values[0] = np.inf
        vectors = np.zeros_like(points)
        vectors[:, 2] = points[:, 2] + 0.5
        for name, array in (("measured", values), ("vectors", vectors)):
            data.AddArray(numpy_to_vtk(array, deep=True))
            data.GetArray(data.GetNumberOfArrays() - 1).SetName(name)

    path = changed_sphere(half_sphere, tmp_path / "measured.vtp", measure)
    pictures = []
    for name, low, high in (("z", -0.5, 0.5), ("measured", None, None), ("vectors", 0, 1)):
        told = (f"--range={low},{high}",) if name == "vectors" else ()
        draw(path, tmp_path / "p.png", "--size", "90x90", "--view", "right", "--scalars", name, *told)
        pictures.append(read_png(tmp_path / "p.png"))
    assert np.ptp(pictures[0][20:70, 45], axis=0).max() > 100, "colours"
    for picture in pictures[1:]:
        assert np.abs(picture - pictures[0]).mean() < 0.5


def test_clipped_through_the_middle(half_sphere, tmp_path):
    """What a plane goes through if that is not told; the file's points are at x from 0 to 0.5."""
    widths = []
    for clip in ((), ("--clip=1,0,0",)):
        options = ("--size", "120x120", "--view", "front", "--background", "white", "--radius", "0.012", *clip)
        draw(half_sphere, tmp_path / "p.png", *options)
        widths.append(covered(tmp_path / "p.png").any(axis=0).sum())
    assert widths[1] == pytest.approx(widths[0] / 2, abs=4)


def test_occlusion_is_of_the_size_of_the_scene(half_sphere, tmp_path):
    """SSAO in the hollow side, whatever the unit is."""

    def enlarge(points, _):
        points *= 1000

    paths = half_sphere, changed_sphere(half_sphere, tmp_path / "large.vtp", enlarge)
    options = ("--size", "90x90", "--view", "left", "--background", "white")
    draw(half_sphere, tmp_path / "p.png", *options)
    plain = read_png(tmp_path / "p.png")
    pictures = []
    for path in paths:
        draw(path, tmp_path / "p.png", *options, "--pass=ssao")
        pictures.append(read_png(tmp_path / "p.png"))
    assert np.abs(pictures[0] - plain).mean() > 2
    assert np.abs(pictures[0] - pictures[1]).mean() < 0.2 * np.abs(pictures[0] - plain).mean()


@pytest.mark.parametrize("method", METHODS)
def test_every_method_draws_the_surface(half_sphere, tmp_path, method):
    picture = tmp_path / "p.png"
    options = ("--radius", "0.02") if method in ("pull-push", "surface-splats") else ()
    report = draw(
        half_sphere, picture, "--size", "60x60", "--view", "right", "--background", "white", "--method", method, *options,
        "--json",
    )  # fmt: skip
    assert report["method"] == method
    seen = covered(picture)
    y, x = np.indices(seen.shape)
    distance = np.hypot(x - 29.5, y - 29.5)
    radius = np.sqrt(seen.sum() / np.pi)
    assert radius == pytest.approx(18.6, abs=1)
    assert seen[distance < 0.9 * radius].mean() > 0.99 and not seen[distance > 1.1 * radius].any()


def test_passes(half_sphere, tmp_path):
    plain, drawn = tmp_path / "plain.png", tmp_path / "drawn.png"
    options = ("--size", "120x120", "--view", "right", "--background", "white", "--color", "tan")
    draw(half_sphere, plain, *options)
    dark = (read_png(plain).max(axis=2) < 60).sum()
    chains = (
        ("background-fill", "occluded-fill", "smoothing", "antialiasing"),
        ("ssao", "silhouettes"),
        ("feature-lines", "silhouettes", "edl", "fxaa"),
    )
    assert {name for names in chains for name in names} == set(PASSES)
    for names in chains:
        draw(half_sphere, drawn, *options, *(f"--pass={name}" for name in names))
        has_lines = (read_png(drawn).max(axis=2) < 60).sum() > dark + 50
        assert has_lines == ("silhouettes" in names), names
        assert covered(drawn).sum() == pytest.approx(covered(plain).sum(), rel=0.2), names
        assert not np.array_equal(read_png(drawn), read_png(plain)), names


def flat_side(mask):
    """Where the half of a ball is flat: the one end of its columns that is as high as all of it."""
    heights = mask.sum(axis=0)
    heights = heights[heights > 0]
    return "left" if heights[2] > 1.3 * heights[-3] else "right" if heights[-3] > 1.3 * heights[2] else "none"


def test_orbit_to_frames(half_sphere, tmp_path):
    report = draw(
        half_sphere, tmp_path / "turn-%02d.png", "--orbit", 4, "--size", "60x60", "--view", "front", "--background", "white",
        "--json",
    )  # fmt: skip
    names = [f"turn-{i:02d}.png" for i in range(4)]
    assert sorted(os.listdir(tmp_path)) == names
    assert report["pictures"] == [str(tmp_path / name) for name in names]
    from_front, _, from_back, _ = (covered(tmp_path / name) for name in names)
    assert flat_side(from_front) == "left" and flat_side(from_back) == "right"


def test_nothing_is_cut_off_in_a_turn(half_sphere, tmp_path):
    """Of what is flat from where the turn begins, and deep from its side."""

    def flatten(points, _):
        points[:, 0] *= 0.05

    path = changed_sphere(half_sphere, tmp_path / "flat.vtp", flatten)
    options = ("--size", "90x90", "--background", "white", "--radius", "0.02")
    draw(path, tmp_path / "turn-%d.png", "--orbit", 4, "--view", "right", *options)
    draw(path, tmp_path / "side.png", "--view", "front", *options)
    turned, side = (covered(tmp_path / name).sum() for name in ("turn-1.png", "side.png"))
    assert side > 100 and turned == pytest.approx(side, rel=0.2)


@pytest.mark.parametrize("name", ["turn.gif", "turn.apng"])
def test_orbit_to_an_animation(half_sphere, tmp_path, name):
    image = pytest.importorskip("PIL.Image", reason="Pillow is not installed")
    draw(half_sphere, tmp_path / name, "--orbit", 4, "--size", "60x60", "--view", "front", "--background", "white")
    with image.open(tmp_path / name) as animation:
        assert animation.n_frames == 4 and animation.size == (60, 60)
        animation.seek(0)
        first = np.asarray(animation.convert("L"))
        animation.seek(2)
        third = np.asarray(animation.convert("L"))
    assert flat_side(first < 220) == "left" and flat_side(third < 220) == "right"
    assert os.listdir(tmp_path) == [name]


def test_animation_without_pillow(half_sphere, tmp_path):
    (tmp_path / "PIL.py").write_text("raise ImportError")
    path = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    result = pointsurface("render", half_sphere, tmp_path / "turn.gif", "--orbit", 4, PYTHONPATH=path)
    check_fault(result, "turn.gif needs the package Pillow")


def test_unknown_color_map_names_matplotlib(half_sphere, tmp_path):
    (tmp_path / "matplotlib.py").write_text("raise ImportError")
    path = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    arguments = ("render", half_sphere, tmp_path / "p.png", "--scalars", "z", "--cmap", "magma")
    check_fault(pointsurface(*arguments, PYTHONPATH=path), "magma is no colour map; known are rainbow, gray", "matplotlib")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="displays are X's")
@pytest.mark.parametrize("command", ["render", "demo"])
def test_display_that_cannot_be_opened(half_sphere, tmp_path, command):
    output = (tmp_path / "p.png",) if command == "render" else ("--output", tmp_path)
    result = pointsurface(command, half_sphere, *output, DISPLAY=":9731")
    check_fault(result, "the display :9731 (DISPLAY) cannot be opened", code=1)


@pytest.mark.skipif(
    not hasattr(pointsurface_module, "vtkPointSurfaceEGLRenderWindow") and bool(find_library("OSMesa")),
    reason="VTK draws by OSMesa",
)
@pytest.mark.parametrize("method", ["pull-push", "auto"])
@pytest.mark.parametrize(
    "environment, words",
    [
        ({"__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent"}, "EGL finds no device"),
        ({"MESA_GL_VERSION_OVERRIDE": "2.1"}, "version 3.2 or later"),
    ],
    ids=["no EGL", "OpenGL 2.1"],
)
def test_no_opengl(half_sphere, tmp_path, environment, words, method):
    result = pointsurface("render", half_sphere, tmp_path / "p.png", "--method", method, **environment)
    check_fault(result, words, code=1)


def test_interrupt_between_frames_leaves_whole_ones(half_sphere, tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-m", "pointsurface", "render", str(half_sphere), str(tmp_path / "f-%04d.png"), "--orbit", "5000"],
        stderr=subprocess.PIPE, text=True, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )  # fmt: skip
    for line in process.stderr:
        if "drawing the turn" in line:
            break
    process.send_signal(signal.SIGINT)
    rest = process.stderr.read()
    assert process.wait(timeout=60) == 130 and "Traceback" not in rest
    frames = sorted(os.listdir(tmp_path))
    assert 0 < len(frames) < 5000
    assert all(re.fullmatch(r"f-\d{4}\.png", name) for name in frames)
    assert read_png(tmp_path / frames[-1]).shape == (600, 800, 3)
