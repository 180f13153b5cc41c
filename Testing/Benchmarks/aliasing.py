#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How much pictures of dense clouds flicker while the camera goes round them, beside those of the true surface.

    python3 Testing/Benchmarks/aliasing.py [--output [FILE]]

A picture aliases where it shows one of the many points of a pixel: as the camera moves on, it shows another one; and at
edges, where a pixel shows the one side or the other. Each scene and density is measured in a process of its own.
PYTHONPATH must lead to the package pointsurface; the dragon lies in ../shared/data beside the project, or in the folder
POINTSURFACE_SHARED_DATA, and is left out where it does not. Some five minutes.
"""

import os
import time
from statistics import median

import numpy as np

from apart import main, measure_apart
from errors import DATA
from pointsurface.bench_scenes import Case
from pointsurface.bench_stage import GAUSSIAN, MESH, OURS, Stage
from pointsurface.metrics import psnr
from pointsurface.rendering import box_average, grab_color, renderer_string
from pointsurface.scene import window_without_screen

PIXELS = 256
DENSITIES = (16, 64)  # points a pixel of the viewport
FRAMES = 16
STEP = 0.3  # degrees: half a pixel or so on the surface
TRUTH_SUPERSAMPLING = 4  # along each side of a pixel
FXAA, SAMPLES = "FXAA", "4 samples"
# Supersampling, FXAA, samples of the window (VTK's default, 8, is 4 here).
REMEDIES = {
    "": (1, False, 0),
    SAMPLES: (1, False, 4),
    FXAA: (1, True, 0),
    "2x": (2, False, 0),
    f"2x, {FXAA}": (2, True, 0),
    "3x": (3, False, 0),
}
SAMPLED = ("pull-push", "surface-splats")  # methods that are also drawn with samples of the window
EDGE = 0.02  # diagonals that depths differ by across an edge
MOST_VARIANCE = 1.2  # times the truth's
LUMINANCE = (0.299, 0.587, 0.114)
DRAGON = os.path.join(DATA, "meshes", "dragon.vtp")
SCENES = {"gyroid": "gyroid", "dragon": DRAGON}


def follow_orbit(stage, mapper, see, scale=1, samples=0):
    """What see(window) gives of each frame, the median milliseconds to draw one, and the renderer string.

    scale, samples: of the window."""
    stage.actor.SetMapper(mapper)
    window = window_without_screen(stage.renderer, tuple(scale * n for n in stage.size))
    window.SetMultiSamples(samples)
    camera = stage.renderer.GetActiveCamera()
    frames, times = [], []
    for _ in range(FRAMES):
        camera.Azimuth(STEP)
        start = time.perf_counter()
        window.Render()
        window.WaitForCompletion()
        times.append(1e3 * (time.perf_counter() - start))
        frames.append(see(window))
    camera.Azimuth(-FRAMES * STEP)
    renderer = renderer_string(window)
    window.RemoveRenderer(stage.renderer)
    return np.array(frames), median(times), renderer


def draw_orbit(stage, name, remedy="", scale=1):
    """Luminance of all frames (frames, height, width), the median milliseconds of one, and the renderer string.

    remedy: a key of REMEDIES. scale: of the picture, whose blocks of pixels are averaged."""
    supersampling, fxaa, samples = REMEDIES[remedy]
    mapper, unlit = stage.make_mapper(name)
    if supersampling > 1:
        mapper.SetSupersampling(supersampling)
    stage.actor.GetProperty().SetLighting(not unlit)
    stage.renderer.SetUseFXAA(fxaa)
    return follow_orbit(stage, mapper, lambda window: box_average(grab_color(window), scale) @ LUMINANCE, scale, samples)


def find_edges(stage):
    """The pixels that are beside an edge of the true surface in some frame: where depths jump, or the surface ends."""
    depths, _, _ = follow_orbit(stage, stage.make_mapper(MESH)[0], stage.depth)
    windows = np.lib.stride_tricks.sliding_window_view(np.pad(depths, ((0, 0), (1, 1), (1, 1)), "edge"), (3, 3), (1, 2))
    return np.any(np.ptp(windows, axis=(-2, -1)) > EDGE * stage.mesh.GetLength(), axis=0)


def flicker(frames):
    """The variance over time of each pixel between one frame and the next: half the mean squared step.

    Slow changes, which the surface's own motion brings, hardly enter it."""
    return np.mean(np.diff(frames, axis=0) ** 2, axis=0) / 2


def measure(scene, density):
    """By name of what draws: variances as multiples of the truth's, PSNR and milliseconds."""
    stage = Stage(Case(SCENES[scene], density * PIXELS**2, PIXELS))
    truth, _, renderer = draw_orbit(stage, MESH, scale=TRUTH_SUPERSAMPLING)
    surface = np.all(np.abs(truth - truth[0, 0, 0]) > 0.5 / 255, axis=0)  # no background
    edges = find_edges(stage)
    whole = np.ones_like(surface)
    rows = {}
    ours = [(method, remedy) for method in OURS for remedy in REMEDIES if remedy != SAMPLES or method in SAMPLED]
    for name, remedy in [*ours, (GAUSSIAN, ""), (MESH, ""), (MESH, FXAA)]:
        frames, milliseconds, _ = draw_orbit(stage, name, remedy)

        def ratio(variance, pixels):
            return variance(frames)[pixels].mean() / variance(truth)[pixels].mean()

        rows[f"{name} {remedy}".rstrip()] = {
            "orbit": ratio(over_orbit, surface),
            "inside": ratio(over_orbit, surface & ~edges),
            "edges": ratio(over_orbit, surface & edges),
            "flicker": ratio(flicker, surface),
            "whole": ratio(flicker, whole),
            "psnr": psnr(frames, truth),
            "milliseconds": milliseconds,
        }
    return {"rows": rows, "renderer": renderer}


def over_orbit(frames):
    return frames.var(axis=0)


def make_table():
    """The table as Markdown; a row for each scene, density and renderer."""
    lines, over = [], {}
    for scene, source in SCENES.items():
        if os.sep in source and not os.path.exists(source):
            continue
        for density in DENSITIES:
            result = measure_apart(__file__, scene, density)
            for name, row in result["rows"].items():
                cells = [scene, density, name, *(f"{row[column]:.2f}" for column in COLUMNS)]
                lines.append("| " + " | ".join(map(str, cells)) + f" | {row['milliseconds']:.1f} |")
                over.setdefault(name, 0)
                over[name] = max(over[name], row["orbit"])
    kept = [name for name, most in over.items() if most <= MOST_VARIANCE]
    return HEAD.format(
        pixels=PIXELS, frames=FRAMES, step=STEP, samples=TRUTH_SUPERSAMPLING**2, most=MOST_VARIANCE,
        edge=100 * EDGE, kept=", ".join(kept) or "none", renderer=result["renderer"],
    ) + "\n".join(lines) + "\n"  # fmt: skip


COLUMNS = ("orbit", "inside", "edges", "flicker", "whole", "psnr")
HEAD = """# Aliasing of dense clouds

By `Testing/Benchmarks/aliasing.py`, {pixels} x {pixels} pixels, {frames} frames of an orbit, {step} degrees from one to the
next. Points a pixel are of the viewport; 2x and 3x is SetSupersampling, FXAA is vtkRenderer's UseFXAAOn, 4 samples are of
the window, which otherwise has one (VTK makes several where it is not told). Variance: of a
pixel's luminance over time, as a multiple of that of the mesh with {samples} samples a pixel; over the orbit, of the surface
(where the truth shows it in all frames), of that away from edges and beside them (where depths differ by {edge:.0f}% of the
diagonal); between one frame and the next, of the surface and of the whole picture. "mesh" is the mesh with one sample a
pixel. The dragon is of the Stanford University Computer Graphics Laboratory. OpenGL renderer: {renderer}.

At most {most} times the truth's over the orbit, in all rows: {kept}.

| scene | points a pixel | drawn by | over the orbit | away from edges | beside edges | between frames | whole picture | PSNR, dB | ms |
| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
"""


if __name__ == "__main__":
    main(__file__, __doc__, measure, make_table)
