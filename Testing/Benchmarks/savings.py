#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What is left out where a scene does not need it: frames with each saving and without, and what differs in the picture.

    python3 Testing/Benchmarks/savings.py [--output [FILE]]

Most savings have no switch, and none gets one here: the side without one draws the same picture from an input that
keeps the mapper from saving, as the column "without" says. Each side is processes of its own: the median of some frames
after warm-up, with the camera moving; see frames.py. PYTHONPATH must lead to the package pointsurface; the models are
those of table1.py. Some seven minutes.
"""

import os
import tempfile
from dataclasses import dataclass
from statistics import median
from typing import Callable

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from apart import main, measure_apart
from frames import MODEL, draw_next_frame
from pointsurface import (
    vtkAlgebraicSplatMapper,
    vtkAlgebraicSplats,
    vtkImageSpacePointMapper,
    vtkPullPushMapper,
    vtkSurfaceSplatMapper,
)
from pointsurface.metrics import psnr
from pointsurface.rendering import offscreen_window, read_color, renderer_string
from pointsurface.sampling import sample_by_area
from pointsurface.truth import render_truth
from table1 import read_model

BACKENDS = ("CPU", "OpenGL")
SIZE, WARM_UP, FRAMES = 512, 2, 21
PROCESSES = 3  # of each side: where its threads come to lie is chance, and lasts as long as the process
MOST_DIFFERENCE = 0.2  # grey levels of 255
MOST_LOSS = 0.5  # dB, of what approximates
LEAST_GAIN = 0.98  # of the time without: what is above saves nothing
CHUNK = 1024  # points that vtkPointSurfaceMapper leaves out together
COLOR = (0.8, 0.6, 0.4)


# ----------------------------------------------------------------------------------------------------------------------
# Clouds.
def with_points(cloud, points, normals):
    """Points with the radius of a cloud, which is the same for all."""
    result = vtkPolyData()
    result.SetPoints(vtkPoints())
    result.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points, np.float32), deep=True))
    result.GetPointData().SetNormals(numpy_to_vtk(np.ascontiguousarray(normals, np.float32), deep=True))
    radius = numpy_to_vtk(np.full(len(points), cloud.GetPointData().GetArray("radius").GetValue(0)), deep=True)
    radius.SetName("radius")
    result.GetPointData().AddArray(radius)
    return result


def arrays_of(cloud):
    return vtk_to_numpy(cloud.GetPoints().GetData()), vtk_to_numpy(cloud.GetPointData().GetNormals())


def taken(cloud, order):
    points, normals = arrays_of(cloud)
    return with_points(cloud, points[order], normals[order])


def morton_order(points):
    """The places of points along a Morton curve of 1024 cells a side."""
    low = points.min(axis=0)
    cells = (1023 * (points - low) / (points - low).max()).astype(np.int64)
    key = np.zeros(len(points), np.int64)
    for bit in range(10):
        for axis in range(3):
            key |= (cells[:, axis] >> bit & 1) << 3 * bit + axis
    return np.argsort(key, kind="stable")


def keep_order(scene, cloud):
    """Has the mapper draw a cloud in the order that it is given in.

    An order of space is kept while points move, as long as its chunks stay about as small: so points on a line come first,
    along which their order is the one that they have, as long as all the chunks of the cloud together.
    """
    count = cloud.GetNumberOfPoints()
    line = np.tile(cloud.GetCenter(), (count, 1))  # in view, or it would not be drawn
    line[:, 0] += cloud.GetLength() * (count / CHUNK + 1) * np.linspace(-0.5, 0.5, count)
    scene.mapper.SetInputData(with_points(cloud, line, arrays_of(cloud)[1]))
    scene.window.Render()
    scene.mapper.SetInputData(cloud)


# ----------------------------------------------------------------------------------------------------------------------
# Savings. A function makes a scene that uses its saving, or one that cannot.
def one_color(scene, used):
    scene.actor.GetProperty().SetColor(*COLOR)
    if not used:
        count = scene.cloud.GetNumberOfPoints()
        colors = numpy_to_vtk(np.tile(np.rint(255 * np.array(COLOR)).astype(np.uint8), (count, 1)), deep=True)
        colors.SetName("colors")
        scene.cloud.GetPointData().SetScalars(colors)


def no_ids(scene, used):
    scene.mapper.SetRecordPointIds(not used)


def one_radius(scene, used):
    if used:
        scene.mapper.SetRadius(scene.cloud.GetPointData().GetArray("radius").GetValue(0))
        scene.cloud.GetPointData().RemoveArray("radius")


def few_levels(scene, used):
    if not used:
        points, normals = arrays_of(scene.cloud)
        eye = np.array(scene.camera.GetPosition())
        behind = scene.nearest_point() + 0.1 * (scene.nearest_point() - eye)
        cloud = with_points(scene.cloud, np.vstack([points, behind]), np.vstack([normals, [0, 0, 1]]))
        vtk_to_numpy(cloud.GetPointData().GetArray("radius"))[-1] = 0.1 * scene.cloud.GetLength()
        scene.mapper.SetInputData(cloud)


def own_rectangle(scene, used):
    scene.camera.Zoom(0.3)
    if not used:
        camera = scene.camera
        across = np.cross(camera.GetDirectionOfProjection(), camera.GetViewUp())
        half = 0.99 * camera.GetDistance() * np.tan(np.radians(camera.GetViewAngle() / 2))
        corner = half * (across + np.array(camera.GetViewUp()))
        corners = np.array(camera.GetFocalPoint()) + [corner, -corner]
        points, normals = arrays_of(scene.cloud)
        edge_on = np.tile(across, (2, 1))  # so that they are black, as the background is
        scene.mapper.SetInputData(
            with_points(scene.cloud, np.vstack([points, corners]), np.vstack([normals, edge_on])))


def no_fills(scene, used):
    """A square across the picture with some points in every pixel, but for those of a small hole."""
    side = int(np.sqrt(scene.cloud.GetNumberOfPoints()))
    x, y = (np.stack(np.meshgrid(*[np.arange(side)] * 2), axis=-1).reshape(-1, 2).T + 0.5) / side - 0.5
    hole = np.hypot(x, y) < 1.5 / scene.size
    kept = ~hole | used
    points = np.column_stack([x, y, 0 * x])[kept]
    scene.mapper.SetRadius(1.5 / side)
    scene.mapper.SetInputData(with_points(scene.cloud, points, np.tile([0, 0, 1], (len(points), 1))))
    scene.camera.SetFocalPoint(0, 0, 0)
    scene.camera.SetPosition(0, 0, 1)
    scene.camera.SetParallelProjection(True)
    scene.camera.SetParallelScale(0.4)


def thinned(scene, used):
    scene.camera.Zoom(0.5)
    scene.mapper.SetThinPoints(used)


def within_frustum(scene, used):
    if not used:
        # in each chunk also the outermost points of the cloud, so that all chunks reach through the picture
        points, _ = arrays_of(scene.cloud)
        ends = np.concatenate([points.argmin(axis=0), points.argmax(axis=0)])
        order = morton_order(points)
        whole = len(points) // (CHUNK - len(ends)) * (CHUNK - len(ends))
        chunks = order[:whole].reshape(-1, CHUNK - len(ends))
        chunks = np.hstack([chunks, np.tile(ends, (len(chunks), 1))])
        keep_order(scene, taken(scene.cloud, np.concatenate([chunks.ravel(), order[whole:]])))
    scene.camera.SetFocalPoint(*scene.nearest_point())
    scene.camera.Zoom(8)


def spatial_order(scene, used):
    if not used:
        order = np.random.default_rng(1).permutation(scene.cloud.GetNumberOfPoints())
        keep_order(scene, taken(scene.cloud, order))


def lowest_polynomials(scene, used):
    splats = vtkAlgebraicSplats()
    splats.SetInputData(scene.cloud)
    splats.SetOrder(4)
    splats.SetTolerance(5e-5 * scene.cloud.GetLength() if used else 0)
    splats.Update()
    scene.mapper.SetInputData(splats.GetOutput())


def rectangle(mapper):
    x, y, width, height = mapper.GetLastFrameRectangle()
    return width * height


def mean_coefficients(mapper):
    order = vtk_to_numpy(mapper.GetInput().GetPointData().GetArray("SplatOrder")).astype(int)
    return round(float(((order + 1) * (order + 2) / 2).mean()), 1)


@dataclass(frozen=True)
class Saving:
    """Where it is used and where not, of which mapper, with how many points, and what tells that it was used."""

    what: str
    without: str
    make: Callable
    mapper: type = vtkPullPushMapper
    count: int = 200_000
    told: str = ""
    tell: Callable = lambda mapper: ""
    approximates: bool = False  # another picture, which is to be as near to the true one
    kept: str = ""  # why, where it saves no time
    model: str = MODEL


# A tolerance that changes the picture by less than can be seen: the normals of the lower orders are other ones before the
# depth is. A bound on the normals instead leaves as many coefficients where the pictures differ by as much.
LOWEST_POLYNOMIALS = {"what": "the lowest orders within 0.005% of the diagonal", "without": "all of order 4",
                      "make": lowest_polynomials, "mapper": vtkAlgebraicSplatMapper, "count": 100_000,
                      "told": "coefficients a splat", "tell": mean_coefficients}
POINTS_DRAWN = {"told": "points drawn", "tell": lambda mapper: mapper.GetLastFramePointsDrawn()}
SAVINGS = {
    "colour": Saving("no colours are carried where all points have one", "an array of one colour", one_color),
    "ids": Saving("no ids are carried outside of selection", "`RecordPointIds`", no_ids),
    "radii": Saving("no radius of each point where all have one", "an array of one radius", one_radius,
                    told="bytes sent to OpenGL", tell=lambda mapper: mapper.GetLastFrameBytesUploaded(),
                    kept="4 bytes of each point are saved, and no array is made for a constant radius"),
    "levels": Saving("no more levels of the pyramid than the largest disc needs", "a large hidden point", few_levels,
                     told="levels", tell=lambda mapper: mapper.GetLastFrameLevels()),
    "rectangle": Saving("only the rectangle that the cloud covers is worked on", "two points in corners of the picture",
                        own_rectangle, told="pixels", tell=rectangle),
    "fills": Saving("no fill where no hole is left", "a hole of 3 pixels", no_fills, vtkImageSpacePointMapper, 500_000,
                    "fills", lambda mapper: mapper.GetLastFrameBackgroundFills() + mapper.GetLastFrameOccludedFills(),
                    kept="filling ends where no hole is left, whenever that is"),
    "thinning": Saving("no more points than pixels can tell apart", "`ThinPoints` off", thinned, vtkSurfaceSplatMapper,
                       500_000, **POINTS_DRAWN, approximates=True),
    "frustum": Saving("points outside of the picture are left out by chunks, zoomed in 8 times",
                      "chunks that all reach through the picture", within_frustum, count=1_000_000, **POINTS_DRAWN),
    "order": Saving("points in the order of space", "points in any order", spatial_order, count=1_000_000),
    "polynomials": Saving(**LOWEST_POLYNOMIALS, kept="surfaces without details, as the torus, need no high orders"),
    "polynomials, torus": Saving(**LOWEST_POLYNOMIALS, model="torus"),
}


# ----------------------------------------------------------------------------------------------------------------------
class Scene:
    """A cloud before a camera, with a mapper of a saving."""

    def __init__(self, saving, backend, count, size):
        self.mesh, self.model = read_model(saving.model)
        self.size = size
        self.cloud = sample_by_area(self.mesh, count)
        self.mapper, self.actor, self.renderer = saving.mapper(), vtkActor(), vtkRenderer()
        self.mapper.SetInputData(self.cloud)
        getattr(self.mapper, f"SetBackendTo{backend}")()
        if hasattr(self.mapper, "SetThinPoints"):
            self.mapper.ThinPointsOff()  # that is a saving of its own
        self.actor.SetMapper(self.mapper)
        self.renderer.AddActor(self.actor)
        self.window = offscreen_window(self.renderer, (size, size))
        self.camera = self.renderer.GetActiveCamera()
        self.renderer.ResetCamera(self.mesh.GetBounds())
        self.camera.Zoom(1.4)

    def nearest_point(self):
        """Of the cloud to the camera, as a stretch of surface that is surely seen."""
        points, _ = arrays_of(self.cloud)
        return points[np.argmax(points @ self.camera.GetViewPlaneNormal())].astype(float)


def measure(name, used, backend, count, size, path):
    """Milliseconds of a frame, of the wall and of the process, and what is told of it; the picture goes to a file."""
    saving = SAVINGS[name]
    scene = Scene(saving, backend, count, size)
    saving.make(scene, used)
    scene.renderer.ResetCameraClippingRange()
    picture = read_color(scene.window)
    np.save(path, picture)
    result = {"told": saving.tell(scene.mapper), "model": scene.model, "renderer": renderer_string(scene.window)}
    if saving.approximates:
        truth = render_truth(scene.mesh, scene.renderer, scene.actor.GetProperty(), (size, size))
        result["psnr"] = psnr(picture, truth.color)
    times = [draw_next_frame(scene.window, scene.renderer) for _ in range(WARM_UP + FRAMES)][WARM_UP:]
    result["wall"], result["process"] = (median(column) for column in zip(*times))
    return result


def difference(first, second):
    """The mean difference of two pictures, in grey levels, over the pixels that either of them draws."""
    drawn = (first > 0).any(axis=-1) | (second > 0).any(axis=-1)
    return float(255 * np.abs(first - second)[drawn].mean()) if drawn.any() else float("nan")


def compare(name, backend, count, size):
    """What was measured with and without a saving, by processes that take turns, and the difference of the pictures."""
    with tempfile.TemporaryDirectory() as folder:
        paths = {used: os.path.join(folder, f"{used}.npy") for used in (True, False)}
        turns = [
            [measure_apart(__file__, name, used, backend, count, size, path) for used, path in paths.items()]
            for _ in range(PROCESSES)
        ]
        sides = [
            {**side[0], **{clock: median(turn[clock] for turn in side) for clock in ("wall", "process")}}
            for side in zip(*turns)
        ]
        return (*sides, difference(*map(np.load, paths.values())))


def make_table(names=tuple(SAVINGS), backends=BACKENDS, size=SIZE, count=None):
    """The table as Markdown; a row for each saving and back end."""
    lines, useless, visible = [], [], []
    for name in names:
        saving = SAVINGS[name]
        for backend in backends:
            used, unused, gap = compare(name, backend, count or saving.count, size)
            ratios = [used[clock] / unused[clock] for clock in ("process", "wall")]
            told = f"{used['told']}, {unused['told']} {saving.told}" if saving.told else ""
            errors = f"{used['psnr']:.2f}, {unused['psnr']:.2f}" if saving.approximates else ""
            cells = [saving.what, saving.without, saving.mapper.__name__, used["model"], count or saving.count, backend, told]
            cells += [f"{used['process']:.1f}", f"{unused['process']:.1f}", f"{ratios[0]:.2f}"]
            cells += [f"{used['wall']:.1f}", f"{unused['wall']:.1f}", f"{ratios[1]:.2f}", f"{gap:.2f}", errors]
            lines.append("| " + " | ".join(map(str, cells)) + " |")
            if min(ratios) > LEAST_GAIN:
                useless.append(f"{name}, {backend}" + (f" (kept: {saving.kept})" if saving.kept else ""))
            if not (gap <= MOST_DIFFERENCE or saving.approximates and used["psnr"] >= unused["psnr"] - MOST_LOSS):
                visible.append(f"{name}, {backend}")
    return HEAD.format(size=size, frames=FRAMES, processes=PROCESSES, loss=MOST_LOSS, **used) + "\n".join(lines) + TAIL.format(
        least=100 * (1 - LEAST_GAIN), useless="; ".join(useless) or "none", most=MOST_DIFFERENCE, loss=MOST_LOSS,
        visible="; ".join(visible) or "none")


HEAD = """# What is saved

By `Testing/Benchmarks/savings.py`. Milliseconds a frame with a saving and without it, the median of {frames} by a
process, and of these the median of {processes}, which took turns with those of the other side; camera moving,
{size} x {size} pixels: of the process over all its threads, and of the wall. The sides differ in what they are given, as
the second column says. Grey levels: the mean difference of the two
pictures over the pixels drawn, of 255; where a saving is an approximation also the PSNR of each, the mesh with 16 samples
a pixel being the truth, and it is this which may not fall by more than {loss} dB then. Points sampled uniformly by area
on a model (the bunny is of the Stanford University Computer Graphics Laboratory). OpenGL renderer: {renderer}.

| saved | without | mapper | model | points | back end | counted, with, without | process, with | without | ratio | wall, with | without | ratio | grey levels | PSNR, dB, with, without |
| --- | --- | --- | --- | ---: | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |
"""
TAIL = """

Savings of under {least:.0f}% of the time, by either clock: {useless}.
Pictures that differ by more than {most} grey levels, or of approximations by {loss} dB: {visible}.
"""


if __name__ == "__main__":
    main(__file__, __doc__, measure, make_table)
