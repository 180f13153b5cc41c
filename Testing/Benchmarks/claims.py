#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What is claimed of the mapper that is picked by itself, and of vtkPullPushMapper beside it: measured, and whether it is met.

    python3 Testing/Benchmarks/claims.py [--output [FILE]]

By the protocol of errors.py, of the bunny: its clouds, camera, light and truth. Milliseconds are of the wall: all that are
compared are drawn by turns, each time by a process of its own, whose figure is the median of some frames with the camera
moving; the table has the median of these. PYTHONPATH must lead to the package pointsurface; a torus takes the model's place
where it is not there. About four minutes.
"""

from statistics import median

import numpy as np
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

import errors
from apart import main, measure_apart
from frames import draw_next_frame
from pointsurface import vtkPointSurfaceMapperFactory, vtkPullPushMapper
from pointsurface.metrics import psnr
from pointsurface.peers import gaussian_discs
from pointsurface.rendering import renderer_string

MODEL = "bunny"
WARM_UP, FRAMES = 3, 21
PROCESSES = 5  # of each that is timed: where its threads come to lie is chance, and lasts as long as the process
GAUSSIAN_SCALE = 0.7  # of the radius: the best PSNR of errors.py
AUTO, PULL_PUSH, GAUSSIAN, MESH = "auto", "pull-push", "vtkPointGaussianMapper", "mesh"

# Points, by whom, and by whom they may be drawn in so much of its time, at most; the back end of mappers of ours.
TIMES = (
    (2_000_000, AUTO, GAUSSIAN, "CPU", 0.05),
    (100_000, AUTO, MESH, "CPU", 0.5),
    (100_000, PULL_PUSH, AUTO, "CPU", 1),
    (100_000, PULL_PUSH, AUTO, "OpenGL", 1),
)
# Points, view and supersampling: the dB of what is picked, at least.
ERRORS = {
    (100_000, "whole", 1): 37.5,
    (100_000, "whole", 2): 39,
    (1_000_000, "whole", 1): 41.5,
    (1_000_000, "whole", 2): 47,
    (100_000, "zoomed", 1): 35.5,
}
BEHIND = 1  # dB that pull-push may be behind what is picked
PUBLISHED = "pull-push as published"
OUTLINE_VIEWS = ("whole", "zoomed")  # of 100,000 points
OUTLINE_PIXELS = 2  # around it
OUTLINE_GAIN = 3  # dB there, over the pictures of the paper
# How pictures are drawn: samples of the window (VTK's default, 8, is 4 here), FXAA.
WAYS = {"as it is": (0, False), "4 samples": (4, False), "FXAA": (0, True)}
# And outlines, also by supersampling.
OUTLINES = {**{way: (*how, 1) for way, how in WAYS.items()}, "2x, FXAA": (0, True, 2)}


def make_scene(count, view):
    name = MODEL if errors.read_mesh(MODEL) is not None else "torus"
    return errors.Scene(errors.make_model(name, errors.read_mesh(name), errors.SEEDS[0], count), view)


def make_mapper(name, scene, backend):
    """A mapper by its name, and whether it lights what it draws."""
    if name == MESH:
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(scene.model.mesh)
        mapper.ScalarVisibilityOff()
        return mapper, True
    if name == GAUSSIAN:
        return gaussian_discs(scene.model.cloud, GAUSSIAN_SCALE), False
    if name == AUTO:  # what is picked where the processor draws
        mapper = vtkPointSurfaceMapperFactory.NewMapper(scene.model.cloud, vtkPullPushMapper.CPU)
    else:
        mapper = vtkPullPushMapper()
        if name == PUBLISHED:
            mapper.SetToPublished()
    getattr(mapper, f"SetBackendTo{backend}")()
    mapper.SetInputData(scene.model.cloud)
    return mapper, True


def measure_time(name, count, backend):
    scene = make_scene(count, "whole")
    mapper, lights = make_mapper(name, scene, backend)
    scene.draw(mapper, scene.lit if lights else scene.unlit)
    times = [draw_next_frame(scene.window, scene.renderer)[0] for _ in range(WARM_UP + FRAMES)]
    return {
        "milliseconds": median(times[WARM_UP:]),
        "mapper": mapper.GetClassName(),
        "model": scene.model.name,
        "triangles": scene.model.mesh.GetNumberOfPolys(),
        "renderer": renderer_string(scene.window),
    }


def measure_errors(count, view, supersampling):
    """PSNR by mapper and by the ways of WAYS."""
    scene = make_scene(count, view)
    truth = errors.draw_truth(scene)
    result = {}
    for name in (AUTO, PULL_PUSH):
        mapper, _ = make_mapper(name, scene, "CPU")
        mapper.SetSupersampling(supersampling)
        result[name] = []
        for samples, fxaa in WAYS.values():
            scene.window.SetMultiSamples(samples)
            scene.renderer.SetUseFXAA(fxaa)
            result[name].append(psnr(scene.draw(mapper, scene.lit), truth.color))
    return result


def measure_outlines(count, view):
    """PSNR beside the outline, by mapper and by the ways of OUTLINES; of the published algorithm the first way alone."""
    scene = make_scene(count, view)
    truth = errors.draw_truth(scene)
    outline = grow(truth.mask) & grow(~truth.mask)
    result = {}
    for name in (PUBLISHED, PULL_PUSH, AUTO):
        mapper, _ = make_mapper(name, scene, "CPU")
        scene.lit.SetBackfaceCulling(name == PUBLISHED)
        result[name] = []
        for samples, fxaa, supersampling in list(OUTLINES.values())[: 1 if name == PUBLISHED else None]:
            scene.window.SetMultiSamples(samples)
            scene.renderer.SetUseFXAA(fxaa)
            mapper.SetSupersampling(supersampling)
            result[name].append(psnr(scene.draw(mapper, scene.lit)[outline], truth.color[outline]))
    return result


def grow(mask):
    """The pixels within OUTLINE_PIXELS of a mask, along rows and columns by turns."""
    for _ in range(OUTLINE_PIXELS):
        around = np.pad(mask, 1)
        mask = mask | around[:-2, 1:-1] | around[2:, 1:-1] | around[1:-1, :-2] | around[1:-1, 2:]
    return mask


def measure(what, *case):
    return {"time": measure_time, "errors": measure_errors, "outlines": measure_outlines}[what](*case)


def judge(values, is_met):
    """Whether a claim is met, by the first of the ways of WAYS that has a value which meets it."""
    met = [way for way, value in zip(WAYS, values) if is_met(value)]
    if not met:
        return "no"
    return "yes" if met[0] == "as it is" else f"with {met[0]}"


def time_case(name, count, backend):
    return name, count, backend if name in (AUTO, PULL_PUSH) else "CPU"


def measure_times(times):
    """What measure_time returns, by its case, with the median of the milliseconds of processes that take turns."""
    cases = [time_case(drawn, count, backend) for count, *both, backend, _ in times for drawn in both]
    cases = list(dict.fromkeys(cases))
    turns = [{case: measure_apart(__file__, "time", *case) for case in cases} for _ in range(PROCESSES)]
    return {
        case: {**turns[0][case], "milliseconds": median(turn[case]["milliseconds"] for turn in turns)} for case in cases
    }


def make_table(times=TIMES, wanted=None, outline_views=OUTLINE_VIEWS, outline_count=100_000):
    """The tables as Markdown."""
    measured = measure_times(times)
    time_lines = []
    for count, name, other, backend, most in times:
        ours, theirs = (measured[time_case(drawn, count, backend)] for drawn in (name, other))
        ratio = ours["milliseconds"] / theirs["milliseconds"]
        cells = [f"{name}, {count} points, {backend}", other, f"{ours['milliseconds']:.1f}", f"{theirs['milliseconds']:.1f}"]
        cells += [f"{ratio:.3f}", f"at most {most:g}", judge([ratio], lambda value: value <= most)]
        time_lines.append("| " + " | ".join(cells) + " |")
    error_lines = []
    for (count, view, supersampling), least in (wanted or ERRORS).items():
        result = measure_apart(__file__, "errors", count, view, supersampling)
        scene = f"{count} points, {view}" + (f", {supersampling}x" if supersampling > 1 else "")
        auto, pull_push = result[AUTO], result[PULL_PUSH]
        behind = [a - b for a, b in zip(auto, pull_push)]
        for name, values, aim, met in (
            (AUTO, auto, f"{least:g}", judge(auto, lambda value: value >= least)),
            (PULL_PUSH, pull_push, f"{BEHIND} below auto", judge(behind, lambda value: value <= BEHIND)),
        ):
            cells = " | ".join(f"{value:.2f}" for value in values)
            error_lines.append(f"| {scene} | {name} | {cells} | {aim} | {met} |")
    outline_lines = []
    for view in outline_views:
        result = measure_apart(__file__, "outlines", outline_count, view)
        published = result[PUBLISHED][0]
        for name, values in result.items():
            cells = [f"{value:.2f}" for value in values] + [""] * (len(OUTLINES) - len(values))
            ways = [way for way, value in zip(OUTLINES, values) if value >= published + OUTLINE_GAIN]
            met = "" if name == PUBLISHED else ", ".join(ways) or "no"
            outline_lines.append(f"| {outline_count} points, {view} | {name} | " + " | ".join(cells) + f" | {met} |")
    one = next(iter(measured.values()))
    picked = next(result["mapper"] for (name, *_), result in measured.items() if name == AUTO)
    return HEAD.format(
        picked=picked, frames=FRAMES, processes=PROCESSES, size=errors.SIZE[0], times="\n".join(time_lines),
        errors="\n".join(error_lines), outlines="\n".join(outline_lines), around=OUTLINE_PIXELS, gain=OUTLINE_GAIN,
        ways=" | ".join(WAYS), columns=" ---: |" * len(WAYS),
        outline_ways=" | ".join(OUTLINES), outline_columns=" ---: |" * len(OUTLINES), **one,
    )  # fmt: skip


HEAD = """# What is claimed

By `Testing/Benchmarks/claims.py`, on {renderer}, {size} x {size} pixels, points sampled on the model {model} (the bunny is
of the Stanford University Computer Graphics Laboratory; its mesh has {triangles} triangles), by the protocol of
`Testing/Benchmarks/errors.py`. auto is what vtkPointSurfaceMapperFactory picks where the processor draws, {picked}.

Milliseconds of the wall a frame, camera moving: the median of {frames} frames by a process, and of these the median of
{processes} processes each, all of which took turns. vtkPointGaussianMapper draws opaque discs of 0.7 of the radius, triangle
scale 1.

| drawn by | beside | ms | ms | ratio | aimed at | met |
| --- | --- | ---: | ---: | ---: | --- | --- |
{times}

PSNR in dB, as the mapper draws, in a window of 4 samples, which VTK makes where it is not told otherwise, and with VTK's FXAA
(`renderer.UseFXAAOn()`); met by the first of these, or by which of the others:

| scene | drawn by | {ways} | at least | met |
| --- | --- |{columns} --- | --- |
{errors}

PSNR in dB within {around} pixels of the outline, by the same ways and at 2x with FXAA; met by what is
{gain} dB better than the algorithm as published, backface culling on:

| scene | drawn by | {outline_ways} | met by |
| --- | --- |{outline_columns} --- |
{outlines}
"""


if __name__ == "__main__":
    main(__file__, __doc__, measure, make_table)
