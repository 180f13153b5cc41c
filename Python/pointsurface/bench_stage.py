# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark's measurements: one scene before one camera and light, drawn by one renderer after the other.

Each picture, its depths and (ours) normals are compared with the mesh of the scene, 16 samples a pixel.
"""

import importlib.util
import os
import subprocess
import sys
import tempfile
import time
from functools import cached_property
from statistics import median

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProperty, vtkRenderer

from . import vtkIsosurfacePoints, vtkPointSurfaceMapper, vtkPointSurfaceMapperFactory
from .bench_scenes import ISOSURFACES, SPREADS, Spread, contour, make_mesh, make_points
from .methods import METHODS, needs_splats, splat_filter
from .metrics import SurfaceImage, compare
from .peers import fill_points, gaussian_discs, gl_points
from .progress import announce
from .rendering import read_color, renderer_string
from .scene import window_without_screen
from .subjects import ISOSURFACE_RADIUS_SCALE
from .truth import render_truth

FRAMES, WARM_UP = 20, 2
MOST_SECONDS = 4  # of a renderer's frames, after which there are no more
BACKGROUND = 0.2

BACKENDS = ("CPU", "OpenGL")
ALGEBRAIC = "algebraic-splats"
OURS = [name for name in METHODS if name != ALGEBRAIC]
TWICE = "2x"  # after a method: with supersampling
TWO_BACKENDS = ("pull-push", "surface-splats", "direct")  # methods that are measured by both, the last one without normals
# Renderers of ours: method, supersampling and back end.
OUR_WAYS = {name: (name, 1, "Automatic") for name in METHODS}
OUR_WAYS |= {f"{name} {TWICE}": (name, 2, "Automatic") for name in OURS}
OUR_WAYS |= {f"{name}, {backend}": (name, 1, backend) for backend in BACKENDS for name in TWO_BACKENDS}

GAUSSIAN, FILL, MESH = "vtkPointGaussianMapper", "vtkPointFillPass", "mesh"
POINTS = {f"points of OpenGL, {size} px": size for size in (1, 2, 4)}  # their sizes in pixels
OPEN3D = "Open3D"  # where it is installed and finds a graphics driver
OPEN3D_SECONDS = 300  # at most, for all of its frames
POINT_SIZE = 2  # pixels, of Open3D's points
PEERS = (GAUSSIAN, *POINTS, FILL, *([OPEN3D] if importlib.util.find_spec("open3d") else []))
# The yardstick for errors, slow and plain: where Testing/Reference/ewa_splats.py can be imported.
EWA = "EWA splats"
YARDSTICKS = [EWA] if importlib.util.find_spec("ewa_splats") else []
MOST_SPLATS, MOST_SPLAT_PIXELS = 1_000_000, 512  # that the yardstick is asked for
MOST_FITTED = 1_000_000  # points that algebraic splats are fitted to
RENDERERS = [*OUR_WAYS, *PEERS, *YARDSTICKS, MESH]
FLYING_EDGES = "vtkFlyingEdges3D, mesh"

TIMES = ("milliseconds", "processor_milliseconds", "frames", "first_milliseconds")
NORMALS = ("normal_mean", "normal_95")  # measures that no peer has
DEPTHS = ("depth", "wrong_depth")


class Stage:
    """A cloud and its mesh before one camera, in one window after the other."""

    renderers = RENDERERS

    def __init__(self, case):
        self.size = (case.pixels, case.pixels)
        self.make_data(case)
        self.azimuth = 0  # degrees
        self.actor = vtkActor()
        self.renderer = vtkRenderer()
        self.renderer.SetBackground([BACKGROUND] * 3)
        self.renderer.AddActor(self.actor)
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(0.5, -0.6, 1)
        self.renderer.ResetCamera(self.mesh.GetBounds())
        self.renderer.CreateLight()  # the headlight, which the truth needs before anything is drawn

    def make_data(self, case):
        spread = SPREADS.get(case.scene, Spread(case.scene))
        self.mesh = make_mesh(spread.scene)
        self.cloud = make_points(self.mesh, case.points, spread)
        if case.scene in SPREADS:  # is for the rules of what is picked; peers' colours would need normals
            self.renderers = [name for name in OUR_WAYS if not name.endswith(TWICE) and not name.startswith(ALGEBRAIC)]

    def truth(self):
        return render_truth(self.mesh, self.renderer, vtkProperty(), self.size)

    @cached_property
    def automatic_backend(self):
        window = window_without_screen(vtkRenderer(), (1, 1))
        window.Render()
        return "CPU" if vtkPointSurfaceMapper.IsSoftwareRasterizer() else "OpenGL"

    def picked(self):
        """The method that is picked by itself, by back end."""
        result = {}
        for backend in BACKENDS:
            mapper = vtkPointSurfaceMapperFactory.NewMapper(self.cloud, getattr(vtkPointSurfaceMapper, backend))
            result[backend] = next(name for name, kind in METHODS.items() if isinstance(mapper, kind))
        return result

    def make_mapper(self, name):
        """The mapper of a renderer's name, and whether it draws colours as they are."""
        if name == MESH:
            mapper = vtkPolyDataMapper()
            mapper.SetInputData(self.mesh)
            return mapper, False
        if name == GAUSSIAN:
            return gaussian_discs(self._lit_cloud(), 0.7), True
        if name in PEERS:
            return gl_points(self._lit_cloud()), True
        method, supersampling, backend = OUR_WAYS[name]
        mapper = METHODS[method]()
        if needs_splats(method, self.cloud):
            splats = splat_filter(self.cloud)
            mapper.SetInputConnection(splats.GetOutputPort())  # fitted when the first frame is drawn
        else:
            mapper.SetInputData(self.cloud)
        mapper.SetSupersampling(supersampling)
        getattr(mapper, f"SetBackendTo{backend}")()
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

    def is_measured(self, name):
        """Not what would be twice the same, or is too slow."""
        count = self.cloud.GetNumberOfPoints()
        if name == EWA:
            return count <= MOST_SPLATS and self.size[0] <= MOST_SPLAT_PIXELS
        if name == ALGEBRAIC:
            return count <= MOST_FITTED
        method, _, backend = OUR_WAYS.get(name, (name, 1, ""))
        if method == "direct" and backend in BACKENDS and self.cloud.GetPointData().GetNormals():
            return False  # seconds a frame by OpenGL, and picked for points without normals alone
        return backend != self.automatic_backend

    def measure(self, name, truth):
        """Milliseconds of a frame, of the clock and of all threads, and the measures of its picture; None: left out."""
        if not self.is_measured(name):
            return None
        if name == EWA:
            return self._measure_ewa_splats(truth)
        if name == OPEN3D:
            return self._measure_open3d(truth)
        window = window_without_screen(self.renderer, self.size)
        self.actor.VisibilityOff()
        window.Render()  # what a window's first frame takes is nobody's
        self.actor.VisibilityOn()
        mapper, unlit = self.make_mapper(name)
        self.actor.SetMapper(mapper)
        self.actor.SetProperty(vtkProperty())
        self.actor.GetProperty().SetLighting(not unlit)
        self.actor.GetProperty().SetPointSize(POINTS.get(name, 1))
        self.renderer.SetPass(fill_points() if name == FILL else None)
        first, _ = _time_frame(window)
        image = SurfaceImage(read_color(window), self._normals(mapper), self.depth(window))
        without = () if hasattr(mapper, "ReadSurfaceBuffer") else NORMALS
        result = self._compare(image, truth, without + (DEPTHS if name == FILL else ()))
        result |= dict(zip(TIMES, [*self._time_frames(window), first]))
        self.opengl = renderer_string(window)
        if name == FILL:
            self.renderer.GetPass().ReleaseGraphicsResources(window)
            self.renderer.SetPass(None)
        window.RemoveRenderer(self.renderer)
        return result

    def _compare(self, image, truth, without=()):
        return {**compare(image, truth, self.mesh.GetLength()), **dict.fromkeys(without)}

    def _measure_ewa_splats(self, truth):
        """The errors of the yardstick, whose time says nothing."""
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
        return {**self._compare(image, truth), **dict.fromkeys(TIMES)}

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
                most_seconds=MOST_SECONDS,
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
        return {**self._compare(image, truth, NORMALS), **{name: float(result[name]) for name in TIMES}}

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
        """Medians after warm-up, and of how many frames; of fewer where they take long, of one at least."""
        times, start = [], time.perf_counter()
        while len(times) <= WARM_UP or (len(times) < WARM_UP + FRAMES and time.perf_counter() < start + MOST_SECONDS):
            self.move(len(times) + 1)
            times.append(_time_frame(window))
        self.move(0)
        return [*(median(column) for column in zip(*times[WARM_UP:])), len(times) - WARM_UP]

    def move(self, frame):
        """To what a frame shows; 0: the first one, which is compared with the truth."""
        self.renderer.GetActiveCamera().Azimuth(frame - self.azimuth)
        self.renderer.ResetCameraClippingRange(self.mesh.GetBounds())
        self.azimuth = frame


class IsosurfaceStage(Stage):
    """An isosurface whose value changes before every frame: points are taken anew, or the mesh is made anew."""

    renderers = [*OURS, FLYING_EDGES]

    def make_data(self, case):
        isosurface = ISOSURFACES[case.scene]
        self.volume, self.value = isosurface.make(), isosurface.value
        self.mesh = contour(self.volume, self.value)
        self.extract = vtkIsosurfacePoints()
        self.extract.SetInputData(self.volume)
        self.move(0)
        self.extract.Update()
        self.cloud = self.extract.GetOutput()

    def make_mapper(self, name):
        if name == FLYING_EDGES:
            self.extract = vtkFlyingEdges3D()
            self.extract.ComputeScalarsOff()
            mapper = vtkPolyDataMapper()
        else:
            self.extract = vtkIsosurfacePoints()
            mapper = METHODS[name]()
            mapper.SetRadiusScale(ISOSURFACE_RADIUS_SCALE)
        self.extract.SetInputData(self.volume)
        self.move(0)
        mapper.SetInputConnection(self.extract.GetOutputPort())
        return mapper, False

    def move(self, frame):
        low, high = self.volume.GetScalarRange()
        self.extract.SetValue(0, self.value + frame * 1e-4 * (high - low))


def _time_frame(window):
    window.WaitForCompletion()
    start, processor = time.perf_counter(), time.process_time()
    window.Render()
    window.WaitForCompletion()
    return 1e3 * (time.perf_counter() - start), 1e3 * (time.process_time() - processor)


def measure_case(case):
    """A dict that JSON can hold: "rows", the figures of all renderers by name; "picked", the method by back end;
    "automatic", the back end that is used where none is asked for; "renderer", of OpenGL; "seconds" that it took."""
    start = time.perf_counter()
    stage = IsosurfaceStage(case) if case.scene in ISOSURFACES else Stage(case)
    truth = stage.truth()
    rows = {name: stage.measure(name, truth) for name in stage.renderers}
    rows = {name: row for name, row in rows.items() if row}
    return {
        "rows": rows,
        "picked": stage.picked(),
        "automatic": stage.automatic_backend,
        "renderer": stage.opengl,
        "seconds": time.perf_counter() - start,
    }
