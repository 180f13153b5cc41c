#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How much pictures of dense clouds flicker while the camera goes round them, beside those of the true surface.

    python3 Testing/Benchmarks/aliasing.py [--output [FILE]]

A picture aliases where it shows one of the many points of a pixel: as the camera moves on, it shows another one. Each
scene and density is measured in a process of its own. PYTHONPATH must lead to the package pointsurface; the dragon lies
in ../shared/data beside the project, or in the folder POINTSURFACE_SHARED_DATA, and is left out where it does not.
"""

import os
import time
from statistics import median

import numpy as np

from apart import main, measure_apart
from errors import DATA
from pointsurface.bench import GAUSSIAN, MESH, OURS, Case, Stage
from pointsurface.metrics import psnr
from pointsurface.rendering import box_average, read_color, renderer_string
from pointsurface.scene import window_without_screen

PIXELS = 256
DENSITIES = (16, 64)  # points a pixel of the viewport
FRAMES = 16
STEP = 0.3  # degrees: half a pixel or so on the surface
TRUTH_SUPERSAMPLING = 4  # along each side of a pixel
SUPERSAMPLINGS = (1, 2, 4)
LUMINANCE = (0.299, 0.587, 0.114)
DRAGON = os.path.join(DATA, "meshes", "dragon.vtp")
SCENES = {"gyroid": "gyroid", "dragon": DRAGON}


def draw_orbit(stage, name, supersampling=1, scale=1):
    """Luminance of all frames (frames, height, width), the median milliseconds of one, and the renderer string.

    supersampling: of a mapper of ours. scale: of the picture, whose blocks of pixels are averaged."""
    mapper, unlit = stage.make_mapper(name)
    if supersampling > 1:
        mapper.SetSupersampling(supersampling)
    stage.actor.SetMapper(mapper)
    stage.actor.GetProperty().SetLighting(not unlit)
    window = window_without_screen(stage.renderer, stage.size)
    camera = stage.renderer.GetActiveCamera()
    frames, times = [], []
    for _ in range(FRAMES):
        camera.Azimuth(STEP)
        start = time.perf_counter()
        window.Render()
        window.WaitForCompletion()
        times.append(1e3 * (time.perf_counter() - start))
        frames.append(box_average(read_color(window, scale), scale) @ LUMINANCE)
    camera.Azimuth(-FRAMES * STEP)
    renderer = renderer_string(window)
    window.RemoveRenderer(stage.renderer)
    return np.array(frames), median(times), renderer


def flicker(frames):
    """The variance over time of each pixel between one frame and the next: half the mean squared step.

    Slow changes, which the surface's own motion brings, hardly enter it."""
    return np.mean(np.diff(frames, axis=0) ** 2, axis=0) / 2


def measure(scene, density):
    """By name of what draws: variance as a multiple of the truth's, on the surface and whole, PSNR and milliseconds."""
    stage = Stage(Case(SCENES[scene], density * PIXELS**2, PIXELS))
    truth, _, renderer = draw_orbit(stage, MESH, scale=TRUTH_SUPERSAMPLING)
    background = truth[0, 0, 0]
    inside = np.all(np.abs(truth - background) > 0.5 / 255, axis=0)
    rows = {}
    ours = [(method, supersampling) for method in OURS for supersampling in SUPERSAMPLINGS]
    for name, supersampling in [*ours, (GAUSSIAN, 1), (MESH, 1)]:
        frames, milliseconds, _ = draw_orbit(stage, name, supersampling)
        rows[name if supersampling == 1 else f"{name} {supersampling}x"] = {
            "inside": flicker(frames)[inside].mean() / flicker(truth)[inside].mean(),
            "whole": flicker(frames).mean() / flicker(truth).mean(),
            "orbit": frames.var(axis=0)[inside].mean() / truth.var(axis=0)[inside].mean(),
            "psnr": psnr(frames, truth),
            "milliseconds": milliseconds,
        }
    return {"rows": rows, "renderer": renderer}


def make_table():
    """The table as Markdown; a row for each scene, density and renderer."""
    lines = []
    for scene, source in SCENES.items():
        if os.sep in source and not os.path.exists(source):
            continue
        for density in DENSITIES:
            result = measure_apart(__file__, scene, density)
            for name, row in result["rows"].items():
                cells = [scene, density, name, *(f"{row[key]:.2f}" for key in ("inside", "whole", "orbit", "psnr"))]
                lines.append("| " + " | ".join(map(str, cells)) + f" | {row['milliseconds']:.1f} |")
    return HEAD.format(
        pixels=PIXELS, frames=FRAMES, step=STEP, samples=TRUTH_SUPERSAMPLING**2, renderer=result["renderer"]
    ) + "\n".join(lines) + "\n"


HEAD = """# Aliasing of dense clouds

By `Testing/Benchmarks/aliasing.py`, {pixels} x {pixels} pixels, {frames} frames of an orbit, {step} degrees from one to the
next. Points a pixel are of the viewport; 2x and 4x is SetSupersampling. Variance: of a pixel's luminance over time, as a multiple of that of the mesh
with {samples} samples a pixel; between one frame and the next, on the surface (where the truth shows it in all frames)
and of the whole picture, outlines included, and over the orbit, on the surface. "mesh" is the mesh with one sample a
pixel. The dragon is of the Stanford University Computer Graphics Laboratory. OpenGL renderer: {renderer}.

| scene | points a pixel | drawn by | between frames, surface | whole | over the orbit | PSNR, dB | ms |
| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: |
"""


if __name__ == "__main__":
    main(__file__, __doc__, measure, make_table)
