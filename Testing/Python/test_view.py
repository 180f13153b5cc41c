# SPDX-License-Identifier: BSD-3-Clause
"""The viewer: what its keys do to the picture, and the command view under an X server with keys sent to its window."""

import argparse
import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import vtkRenderWindow
from vtkmodules.vtkRenderingUI import vtkGenericRenderWindowInteractor

from pointsurface import scene, subjects, view
from pointsurface.methods import METHODS
from pointsurface.passes import PASSES
from pointsurface.rendering import read_color

SIZE = 300
MIDDLE = (SIZE // 2, SIZE // 2)


@pytest.fixture(scope="module")
def ball(tmp_path_factory):
    """A sphere of radius 1/2 around (5, 0, 0)."""
    source = vtkSphereSource()
    source.SetCenter(5, 0, 0)
    source.SetThetaResolution(200)
    source.SetPhiResolution(100)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(source.GetOutputPort())
    path = tmp_path_factory.mktemp("ball") / "ball.vtp"
    writer.SetFileName(str(path))
    writer.Write()
    return path


class Session:
    """A viewer of a file, looked at along y, with its texts hidden."""

    def __init__(self, path, *options):
        parser = argparse.ArgumentParser()
        view.add_arguments(parser)
        common = (str(path), "--size", f"{SIZE}x{SIZE}", "--view", "front", "--background", "black", "--radius", "0.02")
        arguments = parser.parse_args([*common, *options])
        subject = subjects.load(arguments.file)
        self.viewer = view.Viewer(subject, arguments, vtkRenderWindow(), vtkGenericRenderWindowInteractor())
        self.viewer.interactor.Initialize()
        self.viewer.window.Render()
        self.press("h")

    def press(self, keys, place=MIDDLE):
        for key in keys:
            self.viewer.interactor.SetEventInformation(*place, 0, 0, key, 0, key)
            self.viewer.interactor.InvokeEvent("CharEvent")

    def picture(self):
        return read_color(self.viewer.window)

    def covered(self):
        return self.picture().max(axis=2) > 0.02

    def line(self, start):
        """The line of the legend that begins so."""
        return next(line for line in self.viewer.legend.GetInput().splitlines() if line.startswith(start))


@pytest.fixture
def session(ball):
    return Session(ball)


def test_legend_and_report(session):
    without = session.picture()
    assert np.array_equal(without[-60:, :60], np.zeros((60, 60, 3)))
    session.press("h")
    with_texts = session.picture()
    assert (with_texts[-60:, :60] > 0.5).sum() > 100, "the legend"
    assert (with_texts[:30, :200] > 0.5).sum() > 100, "the report"
    assert session.line("m").endswith("mapper: pull-push")
    stages = r"project ([\d.]+) +reconstruct ([\d.]+) +shade ([\d.]+) +frame ([\d.]+)"
    figures = re.search(stages, session.viewer.report.GetInput())
    assert float(figures[4]) >= float(figures[3]) > 0
    assert session.viewer.report.GetInput().startswith("19602 points")
    session.press("h")
    assert np.array_equal(session.picture(), without)


def test_mappers(session):
    first = session.picture()
    shown = []
    for _ in METHODS:
        session.press("m")
        shown.append(session.line("m").split()[-1])
        assert session.covered().sum() == pytest.approx((first.max(axis=2) > 0.02).sum(), rel=0.1), shown[-1]
    assert shown == [*list(METHODS)[1:], "pull-push"]
    assert np.array_equal(session.picture(), first)


def test_radius(session):
    small = session.covered().sum()
    session.press("+" * 6)
    assert session.viewer.actor.GetMapper().GetRadiusScale() == pytest.approx(1.25**6)
    assert session.line("+").endswith(f"{1.25**6:.3g} times")
    assert session.covered().sum() > small
    session.press("-" * 6)
    assert session.covered().sum() == small
    session.press("m" * len(METHODS) + "+" + "m" * len(METHODS) + "m")
    assert session.viewer.actor.GetMapper().GetRadiusScale() == pytest.approx(1.25), "of a mapper that was there before"


def test_passes(session):
    plain = session.picture()
    number = str(list(PASSES).index("silhouettes") + 1)
    session.press(number)
    assert session.line("1").endswith("passes: silhouettes")
    lines = session.picture()
    changed = np.abs(lines - plain).max(axis=2) > 0.05
    y, x = np.nonzero(changed)
    outline = np.sqrt((plain.max(axis=2) > 0.02).sum() / np.pi)
    assert changed.sum() > 200
    assert np.abs(np.hypot(x - SIZE / 2, y - SIZE / 2) - outline).max() < 6
    session.press("8" + number)
    assert session.line("1").endswith(f"passes: {list(PASSES)[7]}")
    session.press("8")
    assert np.array_equal(session.picture(), plain)


def test_light(session):
    assert session.line("l").endswith("key and fill")
    while not session.line("l").endswith("left"):
        session.press("l")
    picture = session.picture().mean(axis=2)
    assert picture[150, 80] > picture[150, 220] + 0.2
    session.press("l")
    picture = session.picture().mean(axis=2)
    assert picture[150, 220] > picture[150, 80] + 0.2


def test_clip(session):
    whole = session.covered()
    session.press("c")
    assert session.line("c").endswith("x")
    half = session.covered()
    assert half[:, :145].sum() > 0.9 * whole[:, :145].sum()
    assert half[:, 156:].sum() < 0.02 * whole[:, 156:].sum()
    session.press("[[[[")
    assert session.line("[").endswith("30%")
    assert session.covered().sum() < 0.8 * half.sum()
    session.press("m")
    assert session.covered()[:, 156:].sum() == 0, "the next mapper is clipped, too"
    session.press("ccc" + "m" * (len(METHODS) - 1))
    assert session.line("c").endswith("off")
    assert np.array_equal(session.covered(), whole)


def test_clip_beside_six_planes(ball, capsys):
    """More than a mapper takes are not asked of it."""
    session = Session(ball, *["--clip=0,0,1"] * 6)
    session.press("c")
    assert session.line("c").endswith("x")
    assert session.viewer.actor.GetMapper().GetNumberOfClippingPlanes() == 6
    assert "Traceback" not in capsys.readouterr().err


def test_view(session):
    session.press("v")
    assert session.line("v").endswith("back")
    position = session.viewer.renderer.GetActiveCamera().GetPosition()
    assert position[0] == pytest.approx(5) and position[1] > 1


@pytest.mark.parametrize("method", METHODS)
def test_pick(ball, method):
    session = Session(ball, "--method", method, "--pass", "silhouettes")
    before = session.picture()
    session.press("p", (3, 3))
    assert session.line("p").endswith("nothing")
    place = (110, 190)
    session.press("p", place)
    point, *coordinates = re.search(r"point (\d+) at (\S+) (\S+) (\S+)$", session.line("p")).groups()
    coordinates = [float(x) for x in coordinates]
    assert coordinates == pytest.approx(session.viewer.subject.points.GetPoint(int(point)), abs=1e-5)
    renderer = session.viewer.renderer
    renderer.SetWorldPoint(*coordinates, 1)
    renderer.WorldToDisplay()
    away = np.hypot(*(np.array(renderer.GetDisplayPoint()[:2]) - place))
    assert away < (30 if method == "algebraic-splats" else 6), "splats are larger than points"
    assert coordinates[1] < 0, "on the side that is seen"
    after = session.picture()
    assert (after[..., 0] > 3 * after[..., 1] + 0.1).sum() > 20, "a red mark"
    assert np.abs(after - before)[:60].max() == 0, "passes are as they were"


def test_save(session, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    picture = session.picture()
    session.press("ss")
    assert sorted(os.listdir()) == [f"pointsurface-00{i}.{end}" for i in (1, 2) for end in ("json", "png")]
    assert np.array_equal(read_png("pointsurface-001.png"), np.rint(255 * picture))
    assert session.line("s").endswith("pointsurface-002.png, .json")
    with open("pointsurface-001.json", encoding="utf-8") as file:
        camera = json.load(file)
    session.press("v")
    scene.place_camera(session.viewer.renderer, camera)
    assert np.abs(session.picture() - picture).max() < 0.02
    monkeypatch.setattr(view, "write_png", lambda *_: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    session.press("s")
    assert session.line("s").endswith("No space left on device")


def read_png(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1).astype(int)


def start(path, folder, **environment):
    environment = {**os.environ, **environment}
    environment.pop("VTK_DEFAULT_OPENGL_WINDOW", None)  # the package set it when this process had no display
    return subprocess.Popen(
        [sys.executable, "-m", "pointsurface", "view", str(path), "--size", "400x300", "--view", "front"],
        env=environment, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )  # fmt: skip


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="displays are X's")
@pytest.mark.parametrize("display, words", [("", "DISPLAY is not set"), (":9731", "the display :9731 (DISPLAY) cannot be")])
def test_no_display(ball, tmp_path, display, words):
    process = start(ball, tmp_path, DISPLAY=display)
    said = process.communicate(timeout=60)
    assert process.returncode == 1 and said[0] == ""
    assert words in said[1] and said[1].count("\n") == 1


@contextlib.contextmanager
def x_server():
    if not (shutil.which("Xvfb") and shutil.which("xdotool")):
        pytest.skip("needs the packages xvfb and xdotool")
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "800x600x24", "-nolisten", "tcp", "-noreset"],
        pass_fds=[write_end], stderr=subprocess.DEVNULL,
    )  # fmt: skip
    os.close(write_end)
    try:
        with os.fdopen(read_end) as number:
            yield f":{number.readline().strip()}"
    finally:
        server.terminate()
        server.wait()


def wait_for(condition, process):
    for _ in range(600):
        if condition():
            return
        assert process.poll() is None, process.communicate()
        time.sleep(0.1)
    raise TimeoutError


def test_keys_sent_to_a_window_of_x(ball, tmp_path):
    with x_server() as display:
        environment = {**os.environ, "DISPLAY": display}

        def do(*words):
            return subprocess.run(["xdotool", *words], env=environment, capture_output=True, text=True)

        process = start(ball, tmp_path, DISPLAY=display)
        wait_for(lambda: do("search", "--name", "pointsurface: points of ball.vtp").stdout, process)
        do("mousemove", "215", "160")
        # keys that come before the window listens are lost: until the first one has done something
        wait_for(lambda: (do("key", "s"), time.sleep(0.5), os.listdir(tmp_path))[2], process)
        time.sleep(1)
        first = len(os.listdir(tmp_path)) // 2
        do("key", "m", "plus", "6", "l", "p", "s", "q")
        said = process.communicate(timeout=60)
        assert process.returncode == 0, said[1]
        assert "Traceback" not in said[1]
        point, y = re.search(r"picked point (\d+) at \S+ (\S+) \S+ \.\.\.", said[1]).groups()
        assert 0 <= int(point) < 19602 and float(y) == pytest.approx(-0.5, abs=0.05)
        before = read_png(tmp_path / "pointsurface-001.png")
        after = read_png(tmp_path / f"pointsurface-{first + 1:03d}.png")
        assert before.shape == after.shape == (300, 400, 3)
        assert (before[-100:, :100] > 200).sum() > 300, "the legend"
        ball_before, ball_after = (image[100:200, 150:250].astype(int) for image in (before, after))
        assert np.abs(ball_before - ball_after).max(axis=2).mean() > 5, "another light"
        assert (ball_after[..., 0] > 2 * ball_after[..., 1] + 20).sum() > 10, "the mark"


def test_interrupt(ball, tmp_path):
    with x_server() as display:
        process = start(ball, tmp_path, DISPLAY=display)
        environment = {**os.environ, "DISPLAY": display}
        search = ["xdotool", "search", "--name", "pointsurface: points of ball.vtp"]
        wait_for(lambda: subprocess.run(search, env=environment, capture_output=True).stdout, process)
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=60)
        assert process.returncode == 130, said
        assert "Traceback" not in said[1]
