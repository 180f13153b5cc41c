#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Ten clouds as one by vtkPointSurfacePass, beside ten clouds apart and one cloud of as many points.

    python3 Testing/Benchmarks/joint.py [--output [FILE]]

The points of a model are dealt out in turn, so that each of the ten clouds goes all over it. Each figure comes from a
process of its own: the median of some frames after warm-up, with the camera moving; see frames.py. PYTHONPATH must lead
to the package pointsurface; the models are those of table1.py.
"""

from statistics import median

from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass

from apart import main, measure_apart
from frames import FRAMES, MODEL, WARM_UP, draw_next_frame
from pointsurface import vtkPointSurfacePass, vtkPullPushMapper
from pointsurface.rendering import offscreen_window, renderer_string
from pointsurface.sampling import sample_by_area
from table1 import read_model

CLOUDS = 10
CASES = ((100_000, 512), (1_000_000, 512))
BACKENDS = ("CPU", "OpenGL")
ROWS = ("joint", "apart", "merged")


def deal(cloud, first):
    """Every tenth point from the first given on."""
    part = vtkPolyData()
    part.SetPoints(vtkPoints())

    def take(array):
        taken = numpy_to_vtk(vtk_to_numpy(array)[first::CLOUDS].copy(), deep=True)
        taken.SetName(array.GetName())
        return taken

    part.GetPoints().SetData(take(cloud.GetPoints().GetData()))
    part.GetPointData().SetNormals(take(cloud.GetPointData().GetNormals()))
    part.GetPointData().AddArray(take(cloud.GetPointData().GetArray("radius")))
    return part


def measure(row, backend, count, size):
    """Milliseconds a frame, and how often one reconstructs, and the renderer string."""
    mesh, model = read_model(MODEL)
    cloud = sample_by_area(mesh, count)
    renderer = vtkRenderer()
    mappers = []
    for data in [cloud] if row == "merged" else [deal(cloud, first) for first in range(CLOUDS)]:
        mapper = vtkPullPushMapper()
        mapper.SetInputData(data)
        getattr(mapper, f"SetBackendTo{backend}")()
        actor = vtkActor()
        actor.SetMapper(mapper)
        renderer.AddActor(actor)
        mappers.append(mapper)
    if row == "joint":
        steps = vtkRenderStepsPass()
        steps.SetOpaquePass(vtkPointSurfacePass())
        renderer.SetPass(steps)
    window = offscreen_window(renderer, (size, size))
    renderer.ResetCamera(mesh.GetBounds())
    renderer.GetActiveCamera().Zoom(1.4)
    times = [draw_next_frame(window, renderer) for _ in range(WARM_UP + FRAMES)][WARM_UP:]
    wall, process = (median(column) for column in zip(*times))
    made = sum(mapper.GetLastFrameReconstructions() for mapper in mappers)
    return {"wall": wall, "process": process, "made": made, "model": model, "renderer": renderer_string(window)}


def make_table():
    """The table as Markdown; a row for each number of points, viewport and back end."""
    lines = []
    for count, size in CASES:
        for backend in BACKENDS:
            results = [measure_apart(__file__, row, backend, count, size) for row in ROWS]
            cells = [count, f"{size} x {size}", backend, *(result["made"] for result in results)]
            for clock in ("process", "wall"):
                joint, apart, merged = (result[clock] for result in results)
                cells += [f"{joint:.1f}", f"{apart:.1f}", f"{merged:.1f}", f"{joint / merged:.2f}"]
            lines.append("| " + " | ".join(map(str, cells)) + " |")
    return HEAD.format(clouds=CLOUDS, frames=FRAMES, **results[0]) + "\n".join(lines) + "\n"


HEAD = """# Ten clouds as one

By `Testing/Benchmarks/joint.py`. Milliseconds a frame, the median of {frames}, camera moving, each figure from a process
of its own: of the process over all its threads, and of the wall. The points of the model {model} (the bunny is of the
Stanford University Computer Graphics Laboratory) are dealt out to {clouds} clouds: joint, by `vtkPointSurfacePass`;
apart, without it, which shows holes; merged, the same points in one cloud. OpenGL renderer:
{renderer}. Reconstructions a frame are counted.

| points | viewport | back end | joint makes | apart | merged | process, joint | apart | merged | joint : merged | wall, joint | apart | merged | joint : merged |
| ---: | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
"""


if __name__ == "__main__":
    main(__file__, __doc__, measure, make_table)
