# SPDX-License-Identifier: BSD-3-Clause
"""Measures speed against error: every mapper, beside VTK's own ways to draw points and the mesh itself.

A measurement is of one scene, number of points and viewport: each renderer draws the same points before the same camera
and light, and its picture, depths and (ours) normals are compared with the mesh of the scene, 16 samples a pixel. What is
measured is kept in results.json, so that a run that was stopped goes on where it was. In a checkout of the project
Testing/Benchmarks/bench.py does the same with the project's EWA splats as a yardstick, which the package does not hold.
"""

import json
import os
import subprocess
import sys

from .bench_report import write_report
from .bench_scenes import DATA_VARIABLE, ISOSURFACES, SCENES, SPREADS, Case, make_mesh, shared_meshes
from .bench_stage import measure_case
from .errors import WrongUse
from .progress import announce
from .writers import write_whole

PROGRAM = "python3 -m pointsurface bench"  # as the report names it
CASE_SECONDS = 900  # at most, for all renderers of a case


def quick_cases():
    return [Case("torus", 100_000, 512), Case("torus", 1_000_000, 512), Case("gyroid", 100_000, 512)]


def full_cases(files):
    """All scenes, models and files, then one scene at more viewports and points, from 1/64 point a pixel to 64; points that
    lie unevenly or have no normals; isosurfaces."""
    cases = [Case(scene, 100_000, 512) for scene in (*SCENES, *shared_meshes(), *files)]
    cases += [Case("gyroid", count, pixels) for count in (100_000, 1_000_000) for pixels in (512, 1024, 2048)]
    cases += [Case("torus", int(512 * 512 * density), 512) for density in (1 / 64, 1 / 16, 1 / 4, 1, 4, 16, 64)]
    cases += [Case("gyroid", 20_000_000, 1024)]
    cases += [Case(scene, 100_000, 512) for scene in SPREADS]
    cases += [Case("sphere, no normals", 1_000_000, 512)]  # that normals are worth waiting for, or not
    cases += [Case(name, 0, 512) for name, isosurface in ISOSURFACES.items() if isosurface.is_there()]
    return list(dict.fromkeys(cases))


# ----------------------------------------------------------------------------------------------------------------------
def add_arguments(parser):
    """The benchmark's part of the command line."""
    parser.add_argument("files", nargs="*", help="meshes to measure with beside the generated scenes (with --full)")
    parser.add_argument(
        "--full", action="store_true",
        help="all scenes, viewports and densities: some 30 minutes on two cores; without it three of them, some 2 minutes",
    )  # fmt: skip
    parser.add_argument(
        "--data", metavar="DIR", default=os.environ.get(DATA_VARIABLE),
        help="folder of the project's models, which --full measures with too (meshes/*.vtp and two of volumes/); "
        f"default: ${DATA_VARIABLE}",
    )  # fmt: skip
    parser.add_argument(
        "--output", default="pointsurface-bench", metavar="DIR", help="folder of the results; default: %(default)s"
    )
    parser.add_argument(
        "--measure", nargs=3, metavar=("SCENE", "POINTS", "PIXELS"), help="print one measurement as JSON, and write nothing"
    )


def run(arguments):
    """Measures what has not been measured yet, and writes the report. Raises WrongUse."""
    if arguments.data:
        os.environ[DATA_VARIABLE] = os.path.abspath(arguments.data)
    if arguments.measure:
        scene, points, pixels = arguments.measure
        if not (points.isdigit() and pixels.isdigit() and int(pixels) > 10 and (int(points) > 0 or scene in ISOSURFACES)):
            raise WrongUse(f"--measure {scene} {points} {pixels}: points and pixels are numbers, of pixels 11 or more")
        print(json.dumps(measure_case(Case(scene, int(points), int(pixels)))))
        return
    if arguments.files and not arguments.full:
        raise WrongUse("files are measured with --full alone")
    for file in arguments.files:
        make_mesh(file)
    cases = full_cases(arguments.files) if arguments.full else quick_cases()
    command = PROGRAM + " --full" * arguments.full + "".join(f" {os.path.basename(file)}" for file in arguments.files)
    os.makedirs(arguments.output, exist_ok=True)
    path = os.path.join(arguments.output, "results.json")
    results = _read_results(path)
    failed = []
    try:
        for i, case in enumerate(cases):
            if str(case) not in results:
                announce(f"{i + 1} of {len(cases)}: {case}")
                result = _measure_apart(case)
                if result is None:
                    failed.append(str(case))
                    continue
                results[str(case)] = result
                write_whole(path, json.dumps(results, indent=1).encode())
    finally:  # also of a run that is stopped
        measured = [(case, results[str(case)]) for case in cases if str(case) in results]
        if measured:
            write_report(arguments.output, measured, len(cases), command)
    if failed:  # the others are worth having
        raise WrongUse(f"not measured, see above: {'; '.join(failed)}")
    minutes = sum(result["seconds"] for _, result in measured) / 60
    print(f"Measured in {minutes:.1f} minutes. Results in {arguments.output}: results.json, results.csv, RESULTS.md and plots")


def _read_results(path):
    try:
        with open(path) as file:
            results = json.load(file)
        if not all("rows" in result for result in results.values()):
            raise ValueError("it is of another version")
        return results
    except FileNotFoundError:
        return {}
    except ValueError as error:
        raise WrongUse(f"{path} is no results file: {error}; remove it to measure anew") from error


def _measure_apart(case):
    """In a process of its own, so that no measurement finds the memory as another left it; None where it fails."""
    command = [sys.executable, "-m", "pointsurface", "bench", "--measure", case.scene, str(case.points), str(case.pixels)]
    try:
        result = subprocess.run(command, stdout=subprocess.PIPE, text=True, timeout=CASE_SECONDS)
    except subprocess.TimeoutExpired:
        announce(f"{case} is left out, it took over {CASE_SECONDS} seconds")
        return None
    if result.returncode:
        announce(f"{case} is left out, its process ended with {result.returncode}")
        return None
    return json.loads(result.stdout.splitlines()[-1])
