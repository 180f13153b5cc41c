#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""From import to the first picture of a million points, beside PyVista's own way of drawing points.

    python3 Testing/Benchmarks/first_picture.py [--points N] [--runs N] [--output [FILE]]

Each figure comes from a process of its own, in which the clock starts before the first import and ends with the picture
as an array; the median of some runs, of the wall's time and of the process' over all its threads. The points, of a sphere
with bumps, are in the memory before, as an array of numpy. It needs PyVista, and so VTK's wheel; PYTHONPATH, if needed,
must lead to the package pointsurface.
"""

import argparse
import json
import os
import subprocess
import sys
import time
from importlib.metadata import version
from statistics import median

HERE = os.path.dirname(os.path.abspath(__file__))
ONCE = "pull-push, normals estimated"  # takes far longer than the others: one run says enough
SIZE = (800, 600)


def points_and_normals(count):
    import numpy as np

    i = np.arange(count) + 0.5
    z, angle = 1 - 2 * i / count, np.pi * (1 + 5**0.5) * i
    ring = np.sqrt(1 - z * z)
    normals = np.stack([ring * np.cos(angle), ring * np.sin(angle), z], axis=1).astype(np.float32)
    bumps = 1 + 0.05 * np.sin(8 * normals).prod(axis=1, keepdims=True)
    return normals * bumps, normals


def plotter():
    import pyvista as pv

    return pv.Plotter(off_screen=True, window_size=SIZE)


def gaussian(points, _normals):
    """PyVista's add_points(style="points_gaussian"), opaque spheres in place of light."""
    scene = plotter()
    scene.add_points(points, style="points_gaussian", color="tan", render_points_as_spheres=True, point_size=4)
    return scene


def squares(points, _normals):
    """PyVista's add_points: flat squares."""
    scene = plotter()
    scene.add_points(points, color="tan", point_size=4)
    return scene


def surface(method, with_normals):
    def add(points, normals):
        import pyvista as pv
        from pointsurface.pyvista import add_point_surface

        scene = plotter()
        cloud = pv.PolyData(points)
        if with_normals:
            cloud.point_data.active_normals = normals
        add_point_surface(scene, cloud, method=method, color="tan", radius=6 / len(points) ** 0.5)
        return scene

    return add


WAYS = {
    'PyVista, `add_points(style="points_gaussian")`': gaussian,
    "PyVista, `add_points()`, unlit squares": squares,
    "pull-push, normals given": surface("pull-push", True),
    "auto, normals given": surface("auto", True),
    ONCE: surface("pull-push", False),
    "direct, positions alone": surface("direct", False),
    "image-space, normals given": surface("image-space", True),
}


def measure(name, count):
    """One run in this process: milliseconds of the wall and of the process, as JSON."""
    points, normals = points_and_normals(count)  # numpy is loaded before the clock starts, as the data are
    start = time.perf_counter(), time.process_time()
    scene = WAYS[name](points, normals)
    picture = scene.screenshot(return_img=True)
    end = time.perf_counter(), time.process_time()
    assert (picture != picture[0, 0]).any(axis=2).mean() > 0.1, "nothing has been drawn"
    from pointsurface.rendering import renderer_string

    result = {"wall": end[0] - start[0], "process": end[1] - start[1], "renderer": renderer_string(scene.render_window)}
    print(json.dumps(result))


def measure_apart(name, count, runs):
    print(f"{name} ...", file=sys.stderr, flush=True)
    command = [sys.executable, os.path.abspath(__file__), "--measure", name, "--points", str(count)]
    runs = 1 if name == ONCE else runs
    results = [json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout) for _ in range(runs)]
    medians = {clock: median(result[clock] for result in results) for clock in ("wall", "process")}
    return {"renderer": results[0]["renderer"], **medians}


def table(count, runs):
    results = {name: measure_apart(name, count, runs) for name in WAYS}
    peer = results[next(iter(WAYS))]
    lines = [
        "# From import to the first picture",
        "",
        f"Of {count} points by `Testing/Benchmarks/first_picture.py`, with PyVista {version('pyvista')} and VTK {version('vtk')}.",
        f"Milliseconds from before the first import (numpy and the points being there) to a picture of {SIZE[0]} x {SIZE[1]} as",
        f"an array; the median of {runs} runs (with normals estimated: one), each a process of its own: by the wall, and of the",
        "process over all its threads.",
        f"Ratios are to the first row. OpenGL renderer: {peer['renderer']}.",
        "",
        "| way | wall | ratio | process | ratio |",
        "| --- | ---: | ---: | ---: | ---: |",
    ]
    for name, result in results.items():
        cells = [name]
        for clock in ("wall", "process"):
            cells += [f"{1000 * result[clock]:.0f}", f"{result[clock] / peer[clock]:.2f}"]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    default_output = os.path.join(HERE, "first_picture.md")
    parser.add_argument("--output", nargs="?", const=default_output, metavar="FILE", help="write the table to a file")
    parser.add_argument("--points", type=int, default=1_000_000, metavar="N", help="default: %(default)s")
    parser.add_argument("--runs", type=int, default=3, metavar="N", help="default: %(default)s")
    parser.add_argument("--measure", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.measure:
        measure(arguments.measure, arguments.points)
        return
    result = table(arguments.points, arguments.runs)
    print(result, end="")
    if arguments.output:
        from pointsurface.writers import write_whole

        write_whole(arguments.output, result.encode())


if __name__ == "__main__":
    main()
