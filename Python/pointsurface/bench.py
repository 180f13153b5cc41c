# SPDX-License-Identifier: BSD-3-Clause
"""Measures speed against error: every mapper, beside VTK's own ways to draw points and the mesh itself.

A measurement is of one scene, number of points and viewport: each renderer draws the same points before the same camera
and light, and its picture, depths and (ours) normals are compared with the mesh of the scene, 16 samples a pixel. What is
measured is kept in results.json, so that a run that was stopped goes on where it was.
"""

import csv
import importlib.util
import io
import json
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from statistics import median

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import (
    vtkAppendPolyData,
    vtkFlyingEdges3D,
    vtkGlyph3D,
    vtkTriangleFilter,
)
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource, vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProperty, vtkRenderer

from . import charts
from .errors import WrongUse
from .methods import METHODS, needs_splats, splat_filter
from .metrics import SurfaceImage, compare
from .peers import gaussian_discs
from .progress import announce
from .readers import read
from .rendering import read_color, renderer_string
from .sampling import sample_by_area
from .scene import window_without_screen
from .truth import mend_normals, render_truth, with_normals
from .volumes import gyroid_ball
from .writers import write_whole

FRAMES, WARM_UP = 5, 2
MOST_SECONDS = 4  # of frames, after which there are no more
CASE_SECONDS = 900  # at most, for all renderers of a case
RADIUS = 1.5  # times the mean spacing
BACKGROUND = 0.2
OURS = [name for name in METHODS if name != "algebraic-splats"]  # whose fit is no matter of a frame
TWICE = "2x"  # after a method: with supersampling
GAUSSIAN, POINTS, MESH = "vtkPointGaussianMapper", "points of OpenGL", "mesh"
OPEN3D = "Open3D"  # where it is installed and finds a graphics driver
OPEN3D_SECONDS = 300  # at most, for all of its frames
PEERS = (GAUSSIAN, POINTS, *([OPEN3D] if importlib.util.find_spec("open3d") else []))
POINT_SIZE = 2  # pixels, of what is drawn as points
# The yardstick for errors, slow and plain: where Testing/Reference/ewa_splats.py can be imported.
EWA = "EWA splats"
YARDSTICKS = [EWA] if importlib.util.find_spec("ewa_splats") else []
MOST_SPLATS, MOST_SPLAT_PIXELS = 1_000_000, 512  # that the yardstick is asked for
RENDERERS = [*OURS, *(f"{name} {TWICE}" for name in OURS), *PEERS, *YARDSTICKS, MESH]
MEASURES = {  # name: heading, format, factor
    "psnr": ("PSNR, dB", "{:.2f}", 1),
    "ssim": ("SSIM", "{:.4f}", 1),
    "normal_mean": ("normals, degrees", "{:.2f}", 1),
    "depth": ("depth, % of diagonal", "{:.4f}", 100),
    "iou": ("IoU", "{:.4f}", 1),
    "unfilled": ("unfilled, %", "{:.3f}", 100),
}


# ----------------------------------------------------------------------------------------------------------------------
# Scenes: meshes with normals.
def sphere():
    source = vtkSphereSource()
    source.SetThetaResolution(400)
    source.SetPhiResolution(200)
    return _run(source)


def torus():
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(vtkParametricTorus())
    source.SetUResolution(400)
    source.SetVResolution(200)
    return _run(source)


def gyroid():
    contour = vtkFlyingEdges3D()
    contour.SetInputData(gyroid_ball())
    contour.SetValue(0, 0)
    contour.ComputeScalarsOff()
    mesh = _run(contour)
    mend_normals(mesh)
    return mesh


def thin_sheets():
    """Ten squares, each a hundredth of its side behind the other and a little smaller."""
    sheets = vtkAppendPolyData()
    for i in range(10):
        half = 0.5 - 0.03 * i
        plane = vtkPlaneSource()
        plane.SetOrigin(-half, -half, 0.01 * i)
        plane.SetPoint1(half, -half, 0.01 * i)
        plane.SetPoint2(-half, half, 0.01 * i)
        plane.SetResolution(20, 20)
        sheets.AddInputConnection(plane.GetOutputPort())
    return _run(sheets)


def small_spheres():
    """Ten thousand of them, anywhere in a cube."""
    centers = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.random.default_rng(0).random((10_000, 3), np.float32), deep=True))
    centers.SetPoints(points)
    ball = vtkSphereSource()
    ball.SetRadius(0.012)
    ball.SetThetaResolution(16)
    ball.SetPhiResolution(10)
    glyphs = vtkGlyph3D()
    glyphs.SetInputData(centers)
    glyphs.SetSourceConnection(ball.GetOutputPort())
    glyphs.ScalingOff()
    return _run(glyphs)


SCENES = {
    "sphere": sphere,
    "torus": torus,
    "gyroid": gyroid,
    "thin sheets": thin_sheets,
    "small spheres": small_spheres,
}


def make_mesh(name):
    """The triangles of a scene by its name in SCENES, or of a file with polygons. Raises WrongUse."""
    mesh = SCENES[name]() if name in SCENES else read(name, tell=True)
    if isinstance(mesh, vtkImageData) or mesh.GetNumberOfPolys() + mesh.GetNumberOfStrips() == 0:
        raise WrongUse(f"{name} has no polygons, so that there is no truth to measure with")
    if mesh.GetPointData().GetNormals() is None:
        mesh = with_normals(mesh)
    triangles = vtkTriangleFilter()
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    triangles.SetInputData(mesh)
    return _run(triangles)


def _run(algorithm):
    algorithm.Update()
    return algorithm.GetOutput()


# ----------------------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Case:
    """A scene with so many points in a square viewport of so many pixels along a side."""

    scene: str
    points: int
    pixels: int

    def __str__(self):
        return f"{self.scene}, {self.points} points, {self.pixels} x {self.pixels}"


def quick_cases():
    return [Case("torus", 100_000, 512), Case("torus", 1_000_000, 512), Case("gyroid", 100_000, 512)]


def full_cases(files):
    """All scenes and files, then one scene at more viewports and points, from 1/64 point a pixel to 64."""
    cases = [Case(scene, 100_000, 512) for scene in (*SCENES, *files)]
    cases += [Case("gyroid", count, pixels) for count in (100_000, 1_000_000) for pixels in (512, 1024, 2048)]
    cases += [Case("torus", int(512 * 512 * density), 512) for density in (1 / 64, 1 / 16, 1 / 4, 1, 4, 16, 64)]
    cases += [Case("gyroid", 20_000_000, 1024)]
    return list(dict.fromkeys(cases))


class Stage:
    """A cloud and its mesh before one camera, in one window after the other."""

    def __init__(self, case):
        self.size = (case.pixels, case.pixels)
        self.mesh = make_mesh(case.scene)
        self.cloud = sample_by_area(self.mesh, case.points)
        vtk_to_numpy(self.cloud.GetPointData().GetArray("radius"))[:] *= RADIUS / 2  # it is twice the mean spacing
        self.actor = vtkActor()
        self.renderer = vtkRenderer()
        self.renderer.SetBackground([BACKGROUND] * 3)
        self.renderer.AddActor(self.actor)
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(0.5, -0.6, 1)
        self.renderer.ResetCamera(self.mesh.GetBounds())
        self.renderer.CreateLight()  # the headlight, which the truth needs before anything is drawn

    def truth(self):
        return render_truth(self.mesh, self.renderer, vtkProperty(), self.size)

    def make_mapper(self, name):
        """The mapper of a renderer's name, and whether it draws colours as they are."""
        if name == MESH:
            mapper = vtkPolyDataMapper()
            mapper.SetInputData(self.mesh)
            return mapper, False
        if name in PEERS:
            cloud = self._lit_cloud()
            if name == GAUSSIAN:
                return gaussian_discs(cloud, 0.7), True
            vertices = vtkVertexGlyphFilter()
            vertices.SetInputData(cloud)
            mapper = vtkPolyDataMapper()
            mapper.SetInputConnection(vertices.GetOutputPort())
            return mapper, True
        method = name.removesuffix(f" {TWICE}")
        mapper = METHODS[method]()
        cloud = _run(splat_filter(self.cloud)) if needs_splats(method, self.cloud) else self.cloud
        mapper.SetInputData(cloud)
        mapper.SetSupersampling(1 if method == name else 2)
        return mapper, False

    def _lit_cloud(self):
        """The points in the colours that the headlight gives them: the peers light them not, or not as a surface."""
        towards = np.array(self.renderer.GetActiveCamera().GetViewPlaneNormal())
        normals = vtk_to_numpy(self.cloud.GetPointData().GetNormals())
        grey = np.rint(255 * np.abs(normals @ towards)).astype(np.uint8)
        colors = numpy_to_vtk(np.repeat(grey[:, None], 3, axis=1), deep=True)
        colors.SetName("Colors")
        lit = vtkPolyData()
        lit.ShallowCopy(self.cloud)
        lit.GetPointData().SetScalars(colors)
        return lit

    def measure(self, name, truth):
        """Milliseconds of a frame, of the clock and of all threads, and the measures of its picture."""
        if name == EWA:
            return self._measure_ewa_splats(truth)
        if name == OPEN3D:
            return self._measure_open3d(truth)
        mapper, unlit = self.make_mapper(name)
        self.actor.SetMapper(mapper)
        self.actor.SetProperty(vtkProperty())
        self.actor.GetProperty().SetLighting(not unlit)
        self.actor.GetProperty().SetPointSize(POINT_SIZE)
        window = window_without_screen(self.renderer, self.size)
        image = SurfaceImage(read_color(window), self._normals(mapper), self.depth(window))
        result = compare(image, truth, self.mesh.GetLength())
        if not hasattr(mapper, "ReadSurfaceBuffer"):
            result["normal_mean"] = result["normal_95"] = None
        result["milliseconds"], result["processor_milliseconds"] = self._time_frames(window)
        result["renderer"] = renderer_string(window)
        window.RemoveRenderer(self.renderer)
        return result

    def _measure_ewa_splats(self, truth):
        """The errors of the yardstick, whose time says nothing; None where there are too many points or pixels for it."""
        if self.cloud.GetNumberOfPoints() > MOST_SPLATS or self.size[0] > MOST_SPLAT_PIXELS:
            return None
        from ewa_splats import draw_ewa_splats

        camera = self.renderer.GetActiveCamera()
        matrix = camera.GetViewTransformMatrix()
        view = np.array([[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])
        focal_length = self.size[1] / 2 / np.tan(np.radians(camera.GetViewAngle()) / 2)
        data = self.cloud.GetPointData()
        arrays = self.cloud.GetPoints().GetData(), data.GetNormals(), data.GetArray("radius")
        normals, depth = draw_ewa_splats(*map(vtk_to_numpy, arrays), view, focal_length, self.size)
        grey = np.where(depth > 0, np.abs(normals[..., 2]), BACKGROUND)  # by the headlight
        image = SurfaceImage(np.repeat(grey[..., None], 3, axis=-1), normals, depth)
        return {**compare(image, truth, self.mesh.GetLength()), "milliseconds": None, "processor_milliseconds": None}

    def _measure_open3d(self, truth):
        """By a process of its own; None, and a line that says why, where Open3D cannot draw."""
        camera = self.renderer.GetActiveCamera()
        eyes = []
        for _ in range(WARM_UP + FRAMES):
            eyes.append(camera.GetPosition())
            camera.Azimuth(1)
        camera.Azimuth(-len(eyes))
        lit = self._lit_cloud()
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, name) for name in ("scene.npz", "result.npz")]
            np.savez(
                paths[0],
                points=vtk_to_numpy(lit.GetPoints().GetData()).astype(float),
                colors=vtk_to_numpy(lit.GetPointData().GetScalars()) / 255,
                point_size=POINT_SIZE,
                size=self.size,
                background=BACKGROUND,
                center=camera.GetFocalPoint(),
                up=camera.GetViewUp(),
                eyes=eyes,
                angle=camera.GetViewAngle(),
                range=camera.GetClippingRange(),
                warm_up=WARM_UP,
            )
            program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "open3d_peer.py")
            command = [sys.executable, program, *paths]
            try:
                run = subprocess.run(command, capture_output=True, text=True, timeout=OPEN3D_SECONDS)
            except subprocess.TimeoutExpired:
                announce(f"{OPEN3D} is left out, it took over {OPEN3D_SECONDS} seconds")
                return None
            if run.returncode:
                reason = run.stderr.strip().splitlines() or ["it says no reason"]
                announce(f"{OPEN3D} is left out, it cannot draw here: {reason[-1]}")
                return None
            result = dict(np.load(paths[1]))
        image = SurfaceImage(result["color"], np.zeros_like(result["color"]), result["depth"].astype(float))
        measures = compare(image, truth, self.mesh.GetLength())
        measures["normal_mean"] = measures["normal_95"] = None
        return {**measures, **{name: float(result[name]) for name in ("milliseconds", "processor_milliseconds")}}

    def _normals(self, mapper):
        if not hasattr(mapper, "ReadSurfaceBuffer"):
            return np.zeros((*self.size[::-1], 3))
        buffer = vtkImageData()
        mapper.ReadSurfaceBuffer(buffer)
        return vtk_to_numpy(buffer.GetPointData().GetArray("Normals")).reshape(*self.size[::-1], 3).astype(float)

    def depth(self, window):
        """Distance from the eye along the view direction, 0 where nothing is drawn."""
        values = vtkFloatArray()
        window.GetZbufferData(0, 0, self.size[0] - 1, self.size[1] - 1, values)
        depth = vtk_to_numpy(values).reshape(self.size[::-1]).astype(float)
        near, far = self.renderer.GetActiveCamera().GetClippingRange()
        return np.where(depth < 1, near * far / (far - depth * (far - near)), 0)

    def _time_frames(self, window):
        """Medians after warm-up, camera moving; of fewer frames where they take long, of one at least."""
        camera = self.renderer.GetActiveCamera()
        times, start = [], time.perf_counter()
        while len(times) <= WARM_UP or (len(times) < WARM_UP + FRAMES and time.perf_counter() < start + MOST_SECONDS):
            camera.Azimuth(1)
            times.append(_time_frame(window))
        camera.Azimuth(-len(times))
        return [median(column) for column in zip(*times[WARM_UP:])]


def _time_frame(window):
    window.WaitForCompletion()
    start, processor = time.perf_counter(), time.process_time()
    window.Render()
    window.WaitForCompletion()
    return 1e3 * (time.perf_counter() - start), 1e3 * (time.process_time() - processor)


def measure_case(case):
    """The results of all renderers, by name."""
    stage = Stage(case)
    truth = stage.truth()
    results = {name: stage.measure(name, truth) for name in RENDERERS}
    return {name: result for name, result in results.items() if result}


# ----------------------------------------------------------------------------------------------------------------------
def add_arguments(parser):
    """The benchmark's part of the command line."""
    parser.add_argument("files", nargs="*", help="meshes to measure with beside the generated scenes (with --full)")
    parser.add_argument("--full", action="store_true", help="all scenes, viewports and densities; takes long")
    parser.add_argument(
        "--output", default="pointsurface-bench", metavar="DIR", help="folder of the results; default: %(default)s"
    )
    parser.add_argument("--measure", nargs=3, metavar=("SCENE", "POINTS", "PIXELS"), help="print one measurement as JSON")


def run(arguments):
    """Measures what has not been measured yet, and writes the report. Raises WrongUse."""
    if arguments.measure:
        scene, points, pixels = arguments.measure
        if not (points.isdigit() and pixels.isdigit() and int(points) > 0 and int(pixels) > 10):
            raise WrongUse(f"--measure {scene} {points} {pixels}: points and pixels are numbers, of pixels 11 or more")
        print(json.dumps(measure_case(Case(scene, int(points), int(pixels)))))
        return
    if arguments.files and not arguments.full:
        raise WrongUse("files are measured with --full alone")
    for file in arguments.files:
        make_mesh(file)
    cases = full_cases(arguments.files) if arguments.full else quick_cases()
    os.makedirs(arguments.output, exist_ok=True)
    path = os.path.join(arguments.output, "results.json")
    results = _read_results(path)
    failed = []
    try:
        for i, case in enumerate(cases):
            if str(case) not in results:
                announce(f"{i + 1} of {len(cases)}: {case}")
                result = _measure_apart(case)
                if result is None:
                    failed.append(str(case))
                    continue
                results[str(case)] = result
                write_whole(path, json.dumps(results, indent=1).encode())
    finally:  # also of a run that is stopped
        measured = [(case, results[str(case)]) for case in cases if str(case) in results]
        if measured:
            _write_report(arguments.output, measured, len(cases))
    if failed:  # the others are worth having
        raise WrongUse(f"not measured, see above: {'; '.join(failed)}")
    print(f"Results in {arguments.output}: results.json, results.csv, RESULTS.md and plots")


def _read_results(path):
    try:
        with open(path) as file:
            return json.load(file)
    except FileNotFoundError:
        return {}
    except ValueError as error:
        raise WrongUse(f"{path} is no results file: {error}; remove it to measure anew") from error


def _measure_apart(case):
    """In a process of its own, so that no measurement finds the memory as another left it; None where it fails."""
    command = [sys.executable, "-m", "pointsurface", "bench", "--measure", case.scene, str(case.points), str(case.pixels)]
    try:
        result = subprocess.run(command, stdout=subprocess.PIPE, text=True, timeout=CASE_SECONDS)
    except subprocess.TimeoutExpired:
        announce(f"{case} is left out, it took over {CASE_SECONDS} seconds")
        return None
    if result.returncode:
        announce(f"{case} is left out, its process ended with {result.returncode}")
        return None
    return json.loads(result.stdout.splitlines()[-1])


# ----------------------------------------------------------------------------------------------------------------------
def pareto(results):
    """The names of the renderers that no other one beats in both milliseconds and PSNR; truth and yardstick are apart."""
    names = [name for name in results if name not in (MESH, EWA)]

    def beats(a, b):
        a, b = results[a], results[b]
        pair = (a["milliseconds"], -a["psnr"]), (b["milliseconds"], -b["psnr"])
        return pair[0] != pair[1] and all(x <= y for x, y in zip(*pair))

    return [name for name in names if not any(beats(other, name) for other in names)]


def exceptions(results):
    """The peers that none of ours is as fast as at no larger error."""
    return [
        peer
        for peer in PEERS
        if peer in results
        and not any(
            results[ours]["milliseconds"] <= results[peer]["milliseconds"] and results[ours]["psnr"] >= results[peer]["psnr"]
            for ours in results
            if ours not in (*PEERS, EWA, MESH)
        )
    ]


def _write_report(folder, measured, wanted):
    write_whole(os.path.join(folder, "results.csv"), _csv(measured).encode())
    write_whole(os.path.join(folder, "RESULTS.md"), _markdown(measured, wanted).encode())
    for case, results in measured:
        name = str(case).replace(",", "").replace(" ", "-").replace(os.sep, "-")
        _write_pareto_plot(os.path.join(folder, f"{name}.png"), case, results)
    _write_pareto_plot(os.path.join(folder, "RESULTS.png"), *_shown(measured))
    _write_series(folder, measured, "points", lambda case: case.points, "milliseconds")
    _write_series(folder, measured, "pixels", lambda case: case.pixels**2, "milliseconds")
    _write_series(folder, measured, "density", lambda case: case.points / case.pixels**2, "psnr")


def _shown(measured):
    """The case, and its results, that stands for all where one is to be shown: the first one of a million points."""
    return next((each for each in measured if each[0].points >= 1_000_000), measured[0])


def _write_pareto_plot(path, case, results):
    """Error against milliseconds; a line joins a method with what it is at twice the resolution."""
    series = {}
    for name, result in results.items():
        if name != EWA:
            series.setdefault(name.removesuffix(f" {TWICE}"), []).append((result["milliseconds"], result["psnr"]))
    series = {name if len(points) == 1 else f"{name}, also {TWICE}": points for name, points in series.items()}
    front = sorted((results[name]["milliseconds"], results[name]["psnr"]) for name in pareto(results))
    charts.write_scatter(path, str(case), "milliseconds a frame", "PSNR, dB", series, front)


def _write_series(folder, measured, what, key, measure):
    """A plot over what varies, of the scene and the rest that most cases have in common."""
    groups = {}
    for case, results in measured:
        rest = (case.scene, case.pixels if what != "pixels" else case.points)
        groups.setdefault(rest, {})[key(case)] = results
    (scene, _), group = max(groups.items(), key=lambda item: len(item[1]))
    if len(group) < 2:
        return
    heading = {"milliseconds": "milliseconds a frame", "psnr": "PSNR, dB"}[measure]
    label = "points a pixel" if what == "density" else what
    drawn = [name for name in RENDERERS if name != EWA and all(name in results for results in group.values())]
    series = {name: sorted((x, results[name][measure]) for x, results in group.items()) for name in drawn}
    path = os.path.join(folder, f"over-{what}.png")
    charts.write_scatter(path, scene, label, heading, series, logarithmic=measure == "milliseconds")


def _csv(measured):
    text = io.StringIO()
    columns = ["milliseconds", "processor_milliseconds", *MEASURES]
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["scene", "points", "pixels", "drawn by", *columns])
    for case, results in measured:
        for name, result in results.items():
            writer.writerow([case.scene, case.points, case.pixels, name, *(result[column] for column in columns)])
    return text.getvalue()


def _markdown(measured, wanted):
    renderer = next(iter(measured[0][1].values()))["renderer"]
    lines = [
        "# Speed against error",
        "",
        f"By `python3 -m pointsurface bench`, on {renderer}. Milliseconds: the median of {FRAMES} frames, camera moving, of",
        f"the clock and of all threads; of fewer where {MOST_SECONDS} seconds hold no more. Points are sampled uniformly by area, at random, with exact normals and a radius of",
        f"{RADIUS} times the mean spacing; vtkPointGaussianMapper draws opaque discs of 0.7 of it, triangle scale 1, points",
        f"of OpenGL are {POINT_SIZE} pixels large; both draw colours of points that were lit one by one. Truth: the mesh, 16 samples a",
        "pixel. A star stands at what none but the mesh beats in both time and PSNR.",
    ]
    if YARDSTICKS:
        lines += [f"{EWA} are the two-pass splatter of Testing/Reference, which is the yardstick of errors, not of time."]
    if any(OPEN3D in results for _, results in measured):
        lines += [f"{OPEN3D}'s offscreen renderer draws such points too, each frame with its reading back."]
    if len(measured) < wanted:
        lines += [f"{len(measured)} of {wanted} measurements are made; the same command goes on."]
    lines += ["", f"![PSNR against milliseconds: {_shown(measured)[0]}](RESULTS.png)"]
    failing = []
    for case, results in measured:
        front = pareto(results)
        failing += [f"{case}: {peer}" for peer in exceptions(results)]
        headings = ["drawn by", "ms", "ms, threads", *(heading for heading, _, _ in MEASURES.values())]
        lines += ["", f"## {str(case)[0].upper()}{str(case)[1:]}", ""]
        lines += ["| " + " | ".join(headings) + " |", "| --- |" + " ---: |" * (len(headings) - 1)]
        for name, result in results.items():
            times = (result[column] for column in ("milliseconds", "processor_milliseconds"))
            cells = ["" if time is None else f"{time:.1f}" for time in times]
            for column, (_, layout, factor) in MEASURES.items():
                cells.append("" if result[column] is None else layout.format(factor * result[column]))
            lines.append(f"| {name}{' *' if name in front else ''} | " + " | ".join(cells) + " |")
    lines += ["", "## Exceptions", ""]
    lines += ["Peers that none of ours is as fast as at no larger error: " + ("; ".join(failing) or "none") + "."]
    return "\n".join(lines) + "\n"
