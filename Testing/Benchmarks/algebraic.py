#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Table 2 of the algebraic splats' paper (Bolla, Narayanan), of this machine, with peers beside it.

    python3 Testing/Benchmarks/algebraic.py [--output [FILE]] [--keep DIR] [--tests PROGRAM [--polynomials N]] [MODEL ...]

A process of its own for each model, half a minute to five minutes each; with --keep a run that was stopped goes on where
it was. PYTHONPATH must lead to the package pointsurface. The models lie in ../shared/data
beside the project, or in the folder POINTSURFACE_SHARED_DATA; those that are not there are left out, the sphere is
generated. PROGRAM is the C++ tests' (build/bin/vtkPointSurfaceCxxTests); with it the table of root finders is made too,
of N random polynomials of each degree: a quarter of an hour.
"""

import argparse
import json
import os
import subprocess
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkPointGaussianMapper, vtkPolyDataMapper, vtkRenderer

from pointsurface import vtkAlgebraicSplatMapper, vtkAlgebraicSplats, vtkPullPushMapper
from pointsurface.rendering import offscreen_window, read_color, renderer_string, write_png, write_whole
from pointsurface.sampling import sample_by_area
from pointsurface.timing import time_frames

HERE = os.path.dirname(os.path.abspath(__file__))
DATA = os.environ.get("POINTSURFACE_SHARED_DATA", os.path.join(HERE, "..", "..", "..", "shared", "data"))
MODELS = ("armadillo", "dragon", "buddha", "lucy", "bunny", "horse", "igea", "fandisk", "sphere")
SIZE = (512, 512)
FRAMES = 5
POINTS = 100_000  # sampled of each mesh
FRAME_FLOATS = 10  # centre, normal, u, radius
PLANE_FLOATS = 7  # a plane splat: centre, normal, radius
LARGEST_ERROR = 1e-3  # for which splats are compared, of the bounding box's diagonal
SAMPLES = 4000  # of the distance to the mesh
GROUPS = {  # heading: properties of vtkAlgebraicSplats, orders
    "hole-free, s = 1": ({"Quality": 1.0}, (1, 2, 3, 4)),
    "LOP, 10%": ({"Selection": 2, "share": 0.10}, (2, 3)),
    "LOP, 5%": ({"Selection": 2, "share": 0.05}, (2, 3)),
    "planes, s = 0.25": ({"Quality": 0.25}, (1,)),
}
DISC = """//VTK::Color::Impl
if (dot(offsetVCVSOutput, offsetVCVSOutput) > 1.0) discard;
"""


def read_mesh(name):
    if name == "sphere":
        source = vtkSphereSource()
        source.SetThetaResolution(400)
        source.SetPhiResolution(200)
    else:
        path = os.path.join(DATA, "meshes", f"{name}.vtp")
        if not os.path.exists(path):
            return None
        source = vtkXMLPolyDataReader()
        source.SetFileName(path)
    source.Update()
    return source.GetOutput()


def patch_points(splats, quality, random):
    """Points of the patches, within what each stands for, in the measure of their discs."""
    get = lambda name: vtk_to_numpy(splats.GetPointData().GetArray(name)).astype(float)
    i = random.integers(splats.GetNumberOfPoints(), size=SAMPLES)
    n, axis, radius, c = get("Normals")[i], get("SplatAxes")[i], get("radius")[i], get("SplatCoefficients")[i]
    angle, r = random.uniform(0, 2 * np.pi, SAMPLES), np.sqrt(random.uniform(0, 1, SAMPLES))
    r *= quality * get("FeatureSize")[i] / radius
    u, v = r * np.cos(angle), r * np.sin(angle)
    terms = [u ** (d - b) * v ** b for d in range(5) for b in range(d + 1)]
    height = sum(c[:, k] * terms[k] for k in range(c.shape[1]))
    centers = vtk_to_numpy(splats.GetPoints().GetData())[i].astype(float)
    return centers + radius[:, None] * (
        u[:, None] * axis + v[:, None] * np.cross(n, axis) + height[:, None] * n)


def inner(mask):
    """The pixels of a silhouette that are not at its rim, where a mesh and points differ by half a pixel."""
    result = mask.copy()
    for axis in (0, 1):
        for step in (-1, 1):
            result &= np.roll(mask, step, axis)
    return result


def measure(name):
    """All figures of a model as JSON."""
    mesh = read_mesh(name)
    diagonal = mesh.GetLength()
    cloud = sample_by_area(mesh, POINTS)
    distance = vtkImplicitPolyDataDistance()
    distance.SetInput(mesh)
    random = np.random.default_rng(1)
    actor, renderer = vtkActor(), vtkRenderer()
    renderer.AddActor(actor)
    renderer.SetBackground(0, 0, 1)
    actor.GetProperty().LightingOff()
    window = offscreen_window(renderer, SIZE)
    renderer.ResetCamera(mesh.GetBounds())
    renderer.GetActiveCamera().Zoom(1.4)

    def draw(mapper):
        mapper.ScalarVisibilityOff()
        actor.SetMapper(mapper)
        mask = read_color(window)[..., 0] > 0.5
        frame = time_frames(window, renderer, frames=FRAMES, warm_up=1)["frame"]
        renderer.GetActiveCamera().Azimuth(-FRAMES - 1)
        return mask, frame

    meshes = vtkPolyDataMapper()
    meshes.SetInputData(mesh)
    mask, frame = draw(meshes)
    inside = inner(mask)
    rows = [{"what": "mesh", "order": "", "count": mesh.GetNumberOfPolys(), "frame": frame}]
    pull_push = vtkPullPushMapper()
    gaussian = vtkPointGaussianMapper()
    gaussian.SetScaleArray("radius")
    gaussian.SetScaleFactor(1)
    gaussian.EmissiveOff()
    gaussian.SetSplatShaderCode(DISC)
    gaussian.SetTriangleScale(1)
    for what, mapper in (("vtkPullPushMapper", pull_push), ("vtkPointGaussianMapper", gaussian)):
        mapper.SetInputData(cloud)
        drawn, frame = draw(mapper)
        rows.append({"what": what, "order": "", "count": POINTS, "bytes": 4 * PLANE_FLOATS * POINTS, "frame": frame,
                     "unfilled": float((inside & ~drawn).sum() / inside.sum())})
    for what, (properties, orders) in GROUPS.items():
        for order in orders:
            splats = vtkAlgebraicSplats()
            splats.SetInputData(cloud)
            splats.SetOrder(order)
            for key, value in properties.items():
                if key == "share":
                    splats.SetNumberOfSplats(round(value * POINTS))
                else:
                    getattr(splats, "Set" + key)(value)
            start = time.perf_counter()
            splats.Update()
            seconds = time.perf_counter() - start
            output = splats.GetOutput()
            points = patch_points(output, splats.GetQuality(), random)
            off = np.abs([distance.EvaluateFunction(*p) for p in points])
            mapper = vtkAlgebraicSplatMapper()
            mapper.SetInputData(output)
            drawn, frame = draw(mapper)
            orders_drawn = vtk_to_numpy(output.GetPointData().GetArray("SplatOrder")).astype(int)
            floats = PLANE_FLOATS * len(orders_drawn) if order == 1 else int(
                (FRAME_FLOATS + (orders_drawn + 1) * (orders_drawn + 2) // 2).sum())
            rows.append({"what": what, "order": order, "count": output.GetNumberOfPoints(), "bytes": 4 * floats,
                         "fit": seconds, "frame": frame, "error": float(off.mean() / diagonal),
                         "worst": float(np.percentile(off, 99) / diagonal),
                         "unfilled": float((inside & ~drawn).sum() / inside.sum())})
    print(json.dumps({"rows": rows, "renderer": renderer_string(window)}))


def sphere_at_zoom():
    """Fig. 1: spheres of linear and of quadratic splats, the mean angle between their normals and the sphere's at growing
    zoom, as Markdown rows."""
    source = vtkSphereSource()
    source.SetRadius(1)
    source.SetThetaResolution(400)
    source.SetPhiResolution(200)
    source.Update()
    cloud = sample_by_area(source.GetOutput(), 20_000)
    lines = []
    for count in (3200, 52):
        for order in (1, 2):
            splats = vtkAlgebraicSplats()
            splats.SetInputData(cloud)
            splats.SetSelectionToFixedCount()
            splats.SetNumberOfSplats(count)
            splats.SetOrder(order)
            mapper, actor, renderer = vtkAlgebraicSplatMapper(), vtkActor(), vtkRenderer()
            mapper.SetInputConnection(splats.GetOutputPort())
            actor.SetMapper(mapper)
            renderer.AddActor(actor)
            window = offscreen_window(renderer, (256, 256))
            camera = renderer.GetActiveCamera()
            camera.SetPosition(0, 0, 4)
            angles = []
            for zoom in (1, 4, 16):
                camera.SetViewAngle(32 / zoom)
                renderer.ResetCameraClippingRange()
                window.Render()
                buffer = vtkImageData()
                mapper.ReadSurfaceBuffer(buffer)
                normals = vtk_to_numpy(buffer.GetPointData().GetArray("Normals")).reshape(256, 256, 3)
                depth = vtk_to_numpy(buffer.GetPointData().GetArray("Depth")).reshape(256, 256)
                y, x = (np.mgrid[0:256, 0:256] + 0.5) / 128 - 1
                scale = np.tan(np.radians(camera.GetViewAngle() / 2))
                ray = np.stack([x * scale, y * scale, -np.ones_like(x)], axis=-1)
                a, b = (ray ** 2).sum(axis=-1), -4.0
                square = b * b - a * 15
                t = (-b - np.sqrt(np.maximum(square, 0))) / a
                truth = ray * t[..., None] + [0, 0, 4]
                both = (square > 0.5) & (depth > 0)
                cosine = (truth * normals).sum(axis=-1)[both]
                angles.append(np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean())
            lines.append(f"| {count} | {order} | " + " | ".join(f"{angle:.2f}" for angle in angles) + " |")
    return "\n".join(lines)


def million_points():
    """Prints what the fit and hole-free selection of a million points takes, order 3, as JSON."""
    source = vtkSphereSource()
    source.SetThetaResolution(400)
    source.SetPhiResolution(200)
    source.Update()
    cloud = sample_by_area(source.GetOutput(), 1_000_000)
    splats = vtkAlgebraicSplats()
    splats.SetInputData(cloud)
    with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
        file.write("5")  # the peak starts anew
    before = memory("VmRSS")
    start, cpu = time.perf_counter(), time.process_time()
    splats.Update()
    seconds, cpu = time.perf_counter() - start, time.process_time() - cpu
    print(json.dumps({"clock": seconds, "processors": cpu, "splats": splats.GetOutput().GetNumberOfPoints(),
                      "memory": memory("VmHWM") - before}))


def memory(key):
    """Bytes of this process's memory a point of a million."""
    with open("/proc/self/status", encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file if line.startswith(key + ":")) * 1024 / 1_000_000


def draw_weak_spots(path, points=30_000, size=300):
    """Fandisk's mesh, hole-free splats and those by LOP, whole and a sharp edge of it, as a picture."""
    mesh = read_mesh("fandisk")
    cloud = sample_by_area(mesh, points)
    drawn = [(vtkPolyDataMapper, mesh)]
    for selection in (1, 2):
        splats = vtkAlgebraicSplats()
        splats.SetInputData(cloud)
        splats.SetSelection(selection)
        splats.SetNumberOfSplats(points // 20)
        splats.Update()
        drawn.append((vtkAlgebraicSplatMapper, splats.GetOutput()))
    bounds = np.array(mesh.GetBounds()).reshape(3, 2)
    rows = []
    for zoom, place in ((5, (0.9, 0.75, 0.9)), (1.4, (0.5, 0.5, 0.5))):  # the last is on top
        panels = []
        for make_mapper, data in drawn:
            mapper, actor, renderer = make_mapper(), vtkActor(), vtkRenderer()
            mapper.SetInputData(data)
            mapper.ScalarVisibilityOff()
            actor.SetMapper(mapper)
            renderer.AddActor(actor)
            renderer.SetBackground(0.2, 0.25, 0.4)
            window = offscreen_window(renderer, (size, size))
            camera = renderer.GetActiveCamera()
            camera.SetPosition(1, 0.6, 0.8)
            renderer.ResetCamera(mesh.GetBounds())
            target = bounds[:, 0] + np.array(place) * (bounds[:, 1] - bounds[:, 0])
            camera.SetPosition(*(np.array(camera.GetPosition()) + target - camera.GetFocalPoint()))
            camera.SetFocalPoint(*target)
            camera.Zoom(zoom)
            renderer.ResetCameraClippingRange()
            panels.append(read_color(window))
        rows.append(np.hstack(panels))
    write_png(path, np.vstack(rows))


def run_alone(*command):
    """What a command prints, in a process of its own."""
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout


def run_self(*arguments):
    return run_alone(sys.executable, os.path.abspath(__file__), *arguments)


def recall(folder, name, measure):
    """The text that measure() returns, or what it returned before; it is kept as a file of the folder, if there is one."""
    path = os.path.join(folder, name) if folder else ""
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            return file.read()
    print(name, file=sys.stderr, flush=True)
    text = measure()
    if folder:
        write_whole(path, text.encode())
    return text


def judge(value, limit, form, within=lambda value, limit: value < limit):
    """A cell of the table of claims."""
    return f"{form.format(value)}, {'met' if within(value, limit) else 'not met'}"


def judge_model(name, rows):
    """A row of the table of claims: of quadrics and cubics of s = 1, what needs the fewest bytes within LARGEST_ERROR."""
    closed = {row["order"]: row for row in rows if row["what"] == "hole-free, s = 1"}
    unfilled = judge(100 * max(row["unfilled"] for row in closed.values()), 0.1, "{:.3f}", lambda a, b: a <= b)
    within = [row for row in (closed[2], closed[3]) if row["error"] <= LARGEST_ERROR]
    if not within:
        return f"| {name} | {unfilled} | none, not met | | |"
    few = min(within, key=lambda row: row["bytes"])
    cells = [unfilled, judge(100 * few["count"] / POINTS, 10, f"{few['order']}: {{:.1f}}")]
    for planes in (next(row for row in rows if row["what"] == "planes, s = 0.25"), closed[1]):
        times = planes["error"] / few["error"]
        cells.append(judge(100 * few["bytes"] / planes["bytes"], 50, "{:.0f}") + f", {times:.1f}")
    return f"| {name} | " + " | ".join(cells) + " |"


def judge_roots(table):
    """Of the bracketed solvers in a table of root finders, rows of the table of claims."""
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in table]
    lines = []
    for solver, where in (("bracketed, double", "CPU"), ("shader", "OpenGL")):
        for kind, column, what in (("random", 4, "missed, of a million random ones"),
                                   ("hard", 5, "missed, of the hard ones, separated by more than 1e-4")):
            found = [row for row in cells if row[1:3] == [kind, solver]]
            if found:
                most = max(1e6 * int(row[column]) / int(row[3]) if kind == "random" else int(row[column]) for row in found)
                limit = 1 if kind == "random" else 0
                lines.append(f"| first roots {what}, {where} | {judge(most, limit, '{:.0f}', lambda a, b: a <= b)} "
                             f"| at most {limit} |")
    return lines


def make_report(models, tests, polynomials, folder=None):
    lines, claims, renderer = [], [], ""
    for name in models:
        if read_mesh(name) is None:
            continue
        measured = json.loads(recall(folder, f"{name}.json", lambda: run_self("--measure", name)).splitlines()[-1])
        renderer = measured["renderer"]
        claims.append(judge_model(name, measured["rows"]))
        for row in measured["rows"]:
            show = lambda key, form: form.format(row[key]) if key in row else ""
            share = "" if row["what"] == "mesh" else f"{100 * row['count'] / POINTS:.1f}"
            kib = f"{row['bytes'] / 1024:.0f}" if "bytes" in row else ""
            lines.append(
                f"| {name} | {row['what']} | {row['order']} | {row['count']} | {share} | {kib} "
                f"| {show('fit', '{:.1f}')} | {row['frame']:.0f} "
                f"| {'%.4f' % (100 * row['error']) if 'error' in row else ''} "
                f"| {'%.3f' % (100 * row['worst']) if 'worst' in row else ''} "
                f"| {'%.3f' % (100 * row['unfilled']) if 'unfilled' in row else ''} |")
    million = json.loads(recall(folder, "million.json", lambda: run_self("--million")).splitlines()[-1])
    roots = []
    for program in ("TestPolynomialRoots", "TestFirstRootShader") if tests else ():
        printed = recall(folder, program + ".txt", lambda: run_alone(tests, program, str(polynomials)))
        table = [line for line in printed.splitlines() if line.startswith("|")]
        roots += [line for line in table if line not in roots[:2]]  # the head is there already
    claims_of_all = [
        f"| a million points, order 3, hole-free: seconds by the clock | {judge(million['clock'], 60, '{:.1f}')} | under 60 |",
        f"| the same: bytes of memory a point, the input apart | {judge(million['memory'], 1024, '{:.0f}')} | under 1024 |",
        *judge_roots(roots),
    ]
    text = f"""# Algebraic splats, measured

Table 2 of Bolla and Narayanan as ours, on {renderer}, {SIZE[0]} x {SIZE[1]} pixels. {POINTS} points are sampled
uniformly by area of each mesh. Splats are vtkAlgebraicSplats' with its defaults; bytes count 32-bit floats: {PLANE_FLOATS}
for a plane (and for a point with normal and radius), {FRAME_FLOATS} and the coefficients for a polynomial. Fit: seconds with
the selection. Frame: the median of {FRAMES} by the clock, camera moving. Error: mean distance of the patches, within what
each stands for, from the mesh, in percent of the bounding box's diagonal, and the distance that one in a hundred is
over: large where sharp edges are smoothed, as fandisk's are. Unfilled: of the pixels within the mesh's silhouette, those
at its rim apart; LOP leaves holes where it spreads splats too thinly. Armadillo, dragon, buddha, lucy and bunny are of
the Stanford University Computer Graphics Laboratory.

| model | what | order | splats, points or triangles | share, % | KiB | fit, s | frame, ms | error, % | 99th, % | unfilled, % |
| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
""" + "\n".join(lines) + f"""

A million points of a sphere, order 3, hole-free: {million["clock"]:.1f} s by the clock, {million["processors"]:.1f} s of
processors' time, {million["splats"]} splats, {million["memory"]:.0f} bytes of memory a point at the peak, the input apart.

## What is claimed

At s = 1 at most 0.1% of the pixels are unfilled, of any order. At equal error, which is at most {100 * LARGEST_ERROR:g}% on
average, quadrics or cubics (of s = 1; named is the order that needs fewer bytes) need under 10% of the input's points,
and under half the bytes of plane splats. Of these there are two kinds: those of s = 0.25, which by the paper (section 5)
look as good as higher orders of s = 1; and those of s = 1, which are as few as the quadrics, and a plane has fewer
bytes. Behind each share of bytes stands how many times the quadrics' or cubics' error the planes' is: over 1, even these
planes do not reach their error, though they may be within the limit.

| model | unfilled, %: at most 0.1 | order: points, %: under 10 | bytes, % of planes', s = 0.25: under 50, error | of planes', s = 1: under 50, error |
| --- | ---: | ---: | ---: | ---: |
""" + "\n".join(claims) + """

| claim | measured | limit |
| --- | ---: | ---: |
""" + "\n".join(claims_of_all) + f"""

## Weak spots

![Fandisk's mesh, hole-free splats, and splats by LOP; below, an edge of it](algebraic.png)

Fandisk of 30,000 points: its mesh, hole-free splats (7% of the points) and splats by LOP (5%), order 3. Sharp edges are
smoothed, and become wavy. LOP's splats, which are not made smaller at borders, reach over them as flaps, as do some of
the hole-free ones at thin rims. Holes by LOP in flat regions, which the paper shows, are in the column unfilled: its
splats are as large as their eight nearest neighbours are far. Fandisk is of Pratt & Whitney, by H. Hoppe.

## Fig. 1: a sphere at growing zoom

Mean angle between the normals drawn and the sphere's, in degrees, of splats by LOP.

| splats | order | zoom 1 | zoom 4 | zoom 16 |
| ---: | ---: | ---: | ---: | ---: |
{sphere_at_zoom()}
"""
    if tests:
        text += """
## Root finders

The first root in [0, 1], judged by Sturm's theorem in a hundred digits. Hard: double, triple and nearly multiple roots,
leading coefficients that vanish, coefficients from 1e-12 to 1e12, rays that graze, a last root at 1. Missed: another
root is nearer to the answer, or there is none, by more than half of 1e-4 (hard), 1e-6 (random, double) or 1e-3 (random,
float and shader). Bracketed is what vtkAlgebraicSplatMapper has: in double where a ray may have several roots. Shader
is what it has on OpenGL, run there: in double too, if the context has that. Nanoseconds are of the processor's time.

""" + "\n".join(roots) + "\n"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", nargs="?", const=os.path.join(HERE, "algebraic.md"), metavar="FILE",
                        help="write the report to a file")
    parser.add_argument("--keep", metavar="DIR", help="keep what is measured in a folder, and take from there what it has")
    parser.add_argument("--tests", metavar="PROGRAM", help="the C++ tests' program, for the table of root finders")
    parser.add_argument("--polynomials", type=int, default=1_000_000, metavar="N", help="how many (default: %(default)s)")
    parser.add_argument("--million", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--measure", metavar="MODEL", help=argparse.SUPPRESS)
    parser.add_argument("models", nargs="*", default=MODELS, metavar="MODEL")
    arguments = parser.parse_args()
    if arguments.measure:
        measure(arguments.measure)
        return
    if arguments.million:
        million_points()
        return
    if arguments.keep:
        os.makedirs(arguments.keep, exist_ok=True)
    report = make_report(arguments.models or MODELS, arguments.tests, arguments.polynomials, arguments.keep)
    print(report, end="")
    if arguments.output:
        write_whole(arguments.output, report.encode())
        if read_mesh("fandisk") is not None:
            draw_weak_spots(os.path.join(os.path.dirname(os.path.abspath(arguments.output)), "algebraic.png"))


if __name__ == "__main__":
    main()
