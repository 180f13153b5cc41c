#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Direct rendering of noisy, bare positions beside estimated normals and pull-push; and what its passes cost.

    python3 Testing/Benchmarks/direct.py [--output [FILE]] [--quick]

Takes some ten minutes on two cores, most of them for normals of a million points by PCA.

Views, light and truth are those of errors.py. Of the points nothing but the positions is given; the peers get their
radius for nothing besides. The time to the first frame is from the points in memory until OpenGL has finished the
frame, in a window in which a small cloud has been drawn before, so that windows are open and shaders compiled. PYTHONPATH
must lead to the package pointsurface. The models lie in ../shared/data beside the project, or in the folder
POINTSURFACE_SHARED_DATA.
"""

import argparse
import os
import sys
import time

from dataclasses import dataclass
from statistics import median

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersPoints import vtkPCANormalEstimation
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

import errors
from pointsurface import vtkDirectPointMapper, vtkPullPushMapper
from pointsurface.metrics import SurfaceImage, compare
from pointsurface.peers import gaussian_discs
from pointsurface.rendering import offscreen_window, read_color, renderer_string, write_whole
from pointsurface.sampling import sample_by_area
from pointsurface.timing import time_frames
from pointsurface.truth import render_truth

HERE = os.path.dirname(os.path.abspath(__file__))
MODELS = ("bunny", "igea", "armadillo")
COUNT = 100_000
NOISE = (0, 0.25, 0.5, 1)  # times the spacing, along the normal
NEIGHBORS = (10, 20, 40)
LARGE = 1_000_000
NOISY = 0.5  # from this noise on, no peer is to have better normals in as little time
TIMES_FASTER = 5  # that direct is to be at least, to the first frame of LARGE points
RUNS = 3  # to the first frame, of which the median counts; rows whose runs are long have one
STAGES = (("bunny", 556_051, 0.5), ("dragon", 3_609_600, 0))  # as many points as the paper's, noise
SIZES = (512, 1024)
FRAMES = 7
DIRECT, NEAREST, EARLY = "direct", "direct, without pass 2", "direct, shaded before splatting"


def pca(neighbors):
    return f"PCA of {neighbors}, pull-push"


def make_model(name, mesh, count, noise):
    """Positions alone, moved along the normals of the mesh, and the radius that pull-push would like."""
    cloud = sample_by_area(mesh, count)
    spacing = vtk_to_numpy(cloud.GetPointData().GetArray("radius"))[0] / 2
    normals = vtk_to_numpy(cloud.GetPointData().GetNormals()).astype(float)
    moved = vtk_to_numpy(cloud.GetPoints().GetData()) + normals * np.random.default_rng(1).normal(
        scale=noise * spacing, size=(count, 1)
    )
    bare = vtkPolyData()
    bare.SetPoints(vtkPoints())
    bare.GetPoints().SetData(numpy_to_vtk(moved.astype(np.float32), deep=True))
    return errors.Model(name, bare, mesh), errors.RADIUS * spacing


def first_points(cloud, count=1000):
    few = vtkPolyData()
    few.SetPoints(vtkPoints())
    few.GetPoints().SetData(numpy_to_vtk(vtk_to_numpy(cloud.GetPoints().GetData())[:count].copy(), deep=True))
    return few


def prepare(row, cloud, radius, eye):
    """The mapper of a row, with all that has to be computed before its first frame."""
    if row.startswith("direct"):
        mapper = vtkDirectPointMapper()
        mapper.SetFarthestPoints(row != NEAREST)
        mapper.SetShadeBeforeSplatting(row == EARLY)
        mapper.SetInputData(cloud)
        return mapper
    estimate = vtkPCANormalEstimation()
    estimate.SetInputData(cloud)
    estimate.SetSampleSize(int(row.split()[2].rstrip(",")))
    estimate.SetNormalOrientationToPoint()
    estimate.SetOrientationPoint(*eye)
    estimate.Update()
    mapper = vtkPullPushMapper()
    mapper.SetRadius(radius)
    mapper.SetInputData(estimate.GetOutput())
    return mapper


def draw_first_frame(row, model, radius):
    """A SurfaceImage by the mapper of a row, its scene, and the seconds to the first frame."""
    scene = errors.Scene(model, "whole")
    eye = scene.camera.GetPosition()
    scene.draw(prepare(row, first_points(model.cloud), radius, eye), scene.lit)
    scene.window.WaitForCompletion()
    start = time.perf_counter()
    mapper = prepare(row, model.cloud, radius, eye)
    scene.actor.SetMapper(mapper)
    scene.window.Render()
    scene.window.WaitForCompletion()
    seconds = time.perf_counter() - start
    color = read_color(scene.window)
    buffer = vtkImageData()
    mapper.ReadSurfaceBuffer(buffer)
    data = buffer.GetPointData()
    width, height = errors.SIZE
    normals = vtk_to_numpy(data.GetArray("Normals")).reshape(height, width, 3).astype(float)
    depth = vtk_to_numpy(data.GetArray("Depth")).reshape(height, width).astype(float)
    return SurfaceImage(color, normals, depth), scene, seconds


@dataclass
class Result:
    """One row for one cloud."""

    model: str
    count: int
    noise: float
    row: str
    seconds: float  # to the first frame
    normals: float  # mean, degrees
    psnr: float  # dB

    def __str__(self):
        return f"{self.normals:.2f}; {self.psnr:.1f}; {self.seconds:.2f}"


def measure(row, model, radius, noise, truth):
    """The Result of a row, and the truth, which is made where there is none yet."""
    runs = [draw_first_frame(row, model, radius) for _ in range(RUNS if row in (DIRECT, NEAREST) else 1)]
    image, scene, _ = runs[0]
    if truth is None:
        truth = render_truth(model.mesh, scene.renderer, scene.lit, errors.SIZE, errors.TRUTH_SUPERSAMPLING)
    diagonal = np.linalg.norm(np.ptp(np.array(model.mesh.GetBounds()).reshape(3, 2), axis=1))
    found = compare(image, truth, diagonal)
    seconds = median(run[2] for run in runs)
    count = model.cloud.GetNumberOfPoints()
    return Result(model.name, count, noise, row, seconds, found["normal_mean"], found["psnr"]), truth


def noise_results(name, count, noises, rows, progress):
    """The Results of all rows for a model with each noise."""
    mesh = errors.read_mesh(name)
    results = []
    truth = None
    for noise in noises:
        model, radius = make_model(name, mesh, count, noise)
        for row in rows:
            result, truth = measure(row, model, radius, noise, truth)
            results.append(result)
            progress(f"{name}, {count:,} points, noise {noise}, {row}: {result}")
    return results


def noise_table(results):
    """A line for each row, a column for each noise."""
    noises = dict.fromkeys(result.noise for result in results)
    heading = ("normals, mean, degrees; PSNR, dB; seconds", *(f"noise {noise}" for noise in noises))
    lines = ["| " + " | ".join(heading) + " |", "| --- " * (len(noises) + 1) + "|"]
    for row in dict.fromkeys(result.row for result in results):
        cells = [str(result) for result in results if result.row == row]
        lines.append("| " + " | ".join((row, *cells)) + " |")
    return lines


def describe(results):
    """What the tables show of what direct rendering is for, as a list of Markdown."""
    direct = {(r.model, r.count, r.noise): r for r in results if r.row == DIRECT}
    peers = [r for r in results if not r.row.startswith("direct")]

    def against(peer):
        return direct[peer.model, peer.count, peer.noise]

    def name(peer):
        return f"{peer.model}, {peer.count:,} points, noise {peer.noise}, {peer.row}"

    largest = max(r.count for r in results)
    lines = []
    for peer in (r for r in peers if r.count == largest):
        times = peer.seconds / against(peer).seconds
        word = "more" if times >= TIMES_FASTER else "less"
        lines.append(f"- {name(peer)}: direct is {times:.1f} times faster to the first frame, {word} than {TIMES_FASTER}.")
    base = {(r.model, r.count, r.noise): r.seconds for r in peers if r.row == pca(NEIGHBORS[0])}
    for neighbors in NEIGHBORS[1:]:
        times = [r.seconds / base[r.model, r.count, r.noise] for r in peers if r.row == pca(neighbors)]
        lines.append(f"- {pca(neighbors)}: {min(times):.1f} to {max(times):.1f} times the seconds of {pca(NEIGHBORS[0])}.")
    noisy = [r for r in peers if r.noise >= NOISY]
    faster = [name(r) for r in noisy if r.seconds <= against(r).seconds and r.normals < against(r).normals]
    better = [name(r) for r in noisy if r.normals < against(r).normals]
    pictures = [name(r) for r in noisy if r.psnr > against(r).psnr]
    lines.append(
        f"- Noise of {NOISY} and more, {len(noisy)} cases: better normals in equal or less time: "
        f"{'; '.join(faster) or 'none'}. Better normals at all: {'; '.join(better) or 'none'}. "
        f"Better PSNR: {'; '.join(pictures) or 'none'}."
    )
    early = {(r.model, r.count, r.noise): r.psnr for r in results if r.row == EARLY}
    gains = [value - direct[key].psnr for key, value in early.items()]
    lines.append(f"- Shading before splatting changes the PSNR by {min(gains):+.2f} to {max(gains):+.2f} dB.")
    return lines


def peers(model, radius, normals):
    pull_push = vtkPullPushMapper()
    pull_push.SetInputData(normals)
    pull_push.SetRadius(radius)
    yield "pull-push, normals given", pull_push
    discs = vtkPolyData()
    discs.SetPoints(model.cloud.GetPoints())
    radii = numpy_to_vtk(np.full(model.cloud.GetNumberOfPoints(), radius, np.float32), deep=True)
    radii.SetName("radius")
    discs.GetPointData().AddArray(radii)
    yield "vtkPointGaussianMapper, unlit", gaussian_discs(discs)
    vertices = vtkVertexGlyphFilter()
    vertices.SetInputData(model.cloud)
    vertices.Update()
    points = vtkPolyDataMapper()
    points.SetInputData(vertices.GetOutput())
    yield "points of OpenGL, unlit", points


def time_direct(scene, window, mapper, frames):
    """Medians of the passes of the paper and of the frame, in milliseconds."""
    time_frames(window, scene.renderer, 1, 2)
    samples = []
    for _ in range(frames):
        frame = time_frames(window, scene.renderer, 1, 0, mapper)
        normals = mapper.GetLastFrameNormalsMilliseconds()
        samples.append((frame["project"], normals, frame["reconstruct"] - normals, frame["shade"], frame["frame"]))
    return np.median(samples, axis=0)


def stage_table(stages, sizes, progress):
    lines = [
        "| | passes 1 and 2 | 3 and 4 | 5 | shading | frame |",
        "| --- " * 6 + "|",
    ]
    for name, count, noise in stages:
        mesh = errors.read_mesh(name)
        model, radius = make_model(name, mesh, count, noise)
        with_normals = vtkPolyData()
        with_normals.SetPoints(model.cloud.GetPoints())
        with_normals.GetPointData().SetNormals(sample_by_area(mesh, count).GetPointData().GetNormals())
        for size in sizes:
            scene = errors.Scene(model, "whole")
            scene.actor.SetProperty(scene.lit)
            window = offscreen_window(scene.renderer, (size, size))
            label = f"{name}, {count:,} points, {size}x{size}"
            for row in (DIRECT, NEAREST, EARLY) if size == sizes[0] else (DIRECT, NEAREST):
                direct = prepare(row, model.cloud, radius, None)
                scene.actor.SetMapper(direct)
                times = time_direct(scene, window, direct, 1 if row == EARLY else FRAMES)
                lines.append(f"| {label}: {row} | " + " | ".join(f"{t:.1f}" for t in times) + " |")
                progress(lines[-1])
            for peer, mapper in peers(model, radius, with_normals):
                scene.actor.SetMapper(mapper)
                frame = time_frames(window, scene.renderer, FRAMES, 2)["frame"]
                lines.append(f"| {label}: {peer} | | | | | {frame:.1f} |")
                progress(lines[-1])
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", nargs="?", const=os.path.join(HERE, "direct.md"), help="write a Markdown file")
    parser.add_argument("--quick", action="store_true", help="one model, few points: whether this program works")
    arguments = parser.parse_args()
    models = [name for name in MODELS if errors.read_mesh(name) is not None]
    if not models:
        sys.exit("The models are not there: set POINTSURFACE_SHARED_DATA.")

    def progress(text):
        print(text, file=sys.stderr, flush=True)

    quick = arguments.quick
    scene = errors.Scene(errors.Model(models[0], None, errors.read_mesh(models[0])), "whole")
    lines = [
        "# Direct rendering of bare positions",
        "",
        f"By `Testing/Benchmarks/direct.py`, on {renderer_string(scene.window)}. Noise is Gaussian, along the normal,",
        "in units of the mean spacing. PCA is `vtkPCANormalEstimation`, its normals turned to the eye; the radius of",
        "`vtkPullPushMapper` is given. Normals and PSNR are those of the picture beside the mesh's, as in `errors.md`.",
    ]

    def add(section):
        lines.extend(["", *section])
        if arguments.output:
            write_whole(arguments.output, ("\n".join(lines).rstrip() + "\n").encode())

    many, few = (20_000, 10_000) if quick else (LARGE, COUNT)
    results = noise_results("bunny", many, NOISE[2:], (DIRECT, NEAREST, pca(NEIGHBORS[0])), progress)
    add(
        [
            f"## To the first frame: bunny, {many:,} points",
            "",
            "With more neighbours the peer takes longer still.",
            "",
            *noise_table(results),
        ]
    )
    add([f"## By noise, {few:,} points", "", "Seconds are those to the first frame."])
    for name in models[: 1 if quick else None]:
        rows = (DIRECT, NEAREST, EARLY, *map(pca, NEIGHBORS))
        found = noise_results(name, few, NOISE[2:3] if quick else NOISE, rows, progress)
        add([f"### {name}", "", *noise_table(found)])
        results += found
    add(["## What these show", "", *describe(results)])
    stages = [(n, 20_000 if quick else c, s) for n, c, s in STAGES[: 1 if quick else None]]
    stages = [stage for stage in stages if errors.read_mesh(stage[0]) is not None]
    table = stage_table(stages, SIZES[: 1 if quick else None], progress)
    add(["## Milliseconds a frame, and of the paper's passes", "", *table])
    if not arguments.output:
        print("\n".join(lines))


if __name__ == "__main__":
    main()
