#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whole frames of vtkPullPushMapper, by both back ends, and of vtkSurfaceSplatMapper, beside vtkPointGaussianMapper's.

    python3 Testing/Benchmarks/frames.py [--output [FILE]]

Each figure comes from a process of its own: the median of some frames after warm-up, until OpenGL has finished them,
with the camera moving before every frame; the time of the wall and that of the process over all its threads.
vtkPointGaussianMapper is at its fastest: opaque discs, SetTriangleScale(1). PYTHONPATH must lead to the package
pointsurface; the models are those of table1.py.
"""

import time
from statistics import median

from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from apart import main, measure_apart
from pointsurface import vtkSurfaceSplatMapper
from pointsurface.rendering import offscreen_window, renderer_string
from pointsurface.sampling import sample_by_area
from table1 import make_mapper, read_model

MODEL = "bunny"
CASES = ((100_000, 512), (100_000, 1024), (2_000_000, 512), (2_000_000, 1024))
RENDERERS = ("CPU", "OpenGL", "surface splats, CPU", "gaussian")
# Shares of the time of vtkPointGaussianMapper that are aimed at, by back end, viewport and number of points.
WANTED = {
    ("CPU", 512, 100_000): 0.2,
    ("CPU", 1024, 100_000): 0.35,
    ("CPU", 512, 2_000_000): 0.1,
    ("CPU", 1024, 2_000_000): 0.1,
    ("OpenGL", 512, 100_000): 0.6,
    ("OpenGL", 1024, 100_000): 0.9,
}
CLOCKS = ("process", "wall")
WARM_UP, FRAMES = 3, 21


def measure(name, count, size):
    """Milliseconds a frame, of the wall and of the process, and the renderer string."""
    mesh, model = read_model(MODEL)
    if name.startswith("surface splats"):
        mapper = vtkSurfaceSplatMapper()
        mapper.SetInputData(sample_by_area(mesh, count))
    else:
        mapper = make_mapper("gaussian" if name == "gaussian" else "default", mesh, count)
    if name != "gaussian":
        getattr(mapper, f"SetBackendTo{name.split()[-1]}")()
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    window = offscreen_window(renderer, (size, size))
    renderer.ResetCamera(mesh.GetBounds())
    renderer.GetActiveCamera().Zoom(1.4)
    times = [draw_next_frame(window, renderer) for _ in range(WARM_UP + FRAMES)][WARM_UP:]
    wall, process = (median(column) for column in zip(*times))
    return {"wall": wall, "process": process, "model": model, "renderer": renderer_string(window)}


def draw_next_frame(window, renderer):
    """Milliseconds of the wall and of the process."""
    renderer.GetActiveCamera().Azimuth(1)
    renderer.ResetCameraClippingRange()
    window.WaitForCompletion()
    start = time.perf_counter(), time.process_time()
    window.Render()
    window.WaitForCompletion()
    return 1e3 * (time.perf_counter() - start[0]), 1e3 * (time.process_time() - start[1])


def make_table(cases=CASES):
    """The table as Markdown; a row for each number of points, viewport and back end."""
    lines, missed = [], []
    for count, size in cases:
        results = {name: measure_apart(__file__, name, count, size) for name in RENDERERS}
        gaussian = results["gaussian"]
        for name in RENDERERS[:-1]:
            ours = results[name]
            wanted = WANTED.get((name, size, count))
            cells = [count, f"{size} x {size}", name]
            ratios = {clock: ours[clock] / gaussian[clock] for clock in CLOCKS}
            for clock in CLOCKS:
                cells += [f"{ours[clock]:.1f}", f"{gaussian[clock]:.1f}", f"{ratios[clock]:.2f}"]
            if wanted is None:
                cells += ["", "", ""]
            else:
                cells += [wanted, *("yes" if ratios[clock] <= wanted else "no" for clock in CLOCKS)]
                case = f"{name}, {count} points, {size} x {size}"
                missed += [f"{case}: {ratios[c]:.2f} by {c}, not {wanted}" for c in CLOCKS if ratios[c] > wanted]
            lines.append("| " + " | ".join(map(str, cells)) + " |")
    said = f"\nNot met: {'; '.join(missed) or 'none'}.\n"
    return HEAD.format(frames=FRAMES, **gaussian) + "\n".join(lines) + "\n" + said


HEAD = """# Whole frames of vtkPullPushMapper, vtkSurfaceSplatMapper and vtkPointGaussianMapper

Milliseconds a frame, the median of {frames}, camera moving, each renderer in a process of its own: of the process over
all its threads, and of the wall. vtkPointGaussianMapper draws opaque discs, triangle scale 1. Points sampled uniformly
by area on the model {model} (the bunny is of the Stanford University Computer Graphics Laboratory). OpenGL renderer:
{renderer}.
Back ends alone are those of vtkPullPushMapper.

| points | viewport | back end | process | Gaussian | ratio | wall | Gaussian | ratio | aimed at | met, process | met, wall |
| ---: | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- | --- |
"""


if __name__ == "__main__":
    main(__file__, __doc__, measure, make_table)
