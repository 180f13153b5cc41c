#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""vtkIsosurfacePoints against vtkFlyingEdges3D with normals: the same volume, isovalue and threads.

Prints a Markdown table. Medians of runs that take turns, so that a busy machine slows both alike;
the ratio of a row is what counts. ../shared/data/volumes is used where it lies beside the project.
"""
import argparse
import statistics
import time
from pathlib import Path

from pointsurface import vtkIsosurfacePoints
from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
from vtkmodules.vtkImagingCore import vtkImageCast, vtkRTAnalyticSource
from vtkmodules.vtkImagingHybrid import vtkSampleFunction
from vtkmodules.vtkCommonDataModel import vtkSphere
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

VOLUMES = Path(__file__).resolve().parents[3] / "shared" / "data" / "volumes"


def sphere(size, scalar_type):
    ball = vtkSphere()
    ball.SetRadius(80)
    source = vtkSampleFunction()
    source.SetImplicitFunction(ball)
    source.SetModelBounds(-100, 100, -100, 100, -100, 100)
    source.SetSampleDimensions(size, size, size)
    source.SetOutputScalarType(scalar_type)
    source.ComputeNormalsOff()
    source.Update()
    return source.GetOutput()


def wavelet(half, scalar_type):
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-half, half, -half, half, -half, half)
    source.SetXFreq(60)
    source.SetYFreq(30)
    source.SetZFreq(40)
    cast = vtkImageCast()
    cast.SetInputConnection(source.GetOutputPort())
    cast.SetOutputScalarType(scalar_type)
    cast.Update()
    return cast.GetOutput()


def cases():
    """Name, image and isovalue."""
    float32, float64, int16 = 10, 11, 4
    yield "sphere 256^3 float", sphere(256, float32), 0.5
    yield "sphere 256^3 double", sphere(256, float64), 0.5
    yield "wavelet 257^3 float", wavelet(128, float32), 157.5
    yield "wavelet 257^3 int16", wavelet(128, int16), 157.5
    for name, isovalue in (
        ("mr-head-colin27-t1", 50),
        ("mr-head-colin27-t1", 50.5),
        ("ct-head-promed0051", 300),
        ("frog-tissue-labels", 0.5),
    ):
        path = VOLUMES / f"{name}.vti"
        if path.exists():
            reader = vtkXMLImageDataReader()
            reader.SetFileName(str(path))
            reader.Update()
            yield f"{name} at {isovalue}", reader.GetOutput(), isovalue


def milliseconds(algorithm):
    algorithm.Modified()
    begin = time.perf_counter()
    algorithm.Update()
    return 1e3 * (time.perf_counter() - begin)


def compare(image, isovalue, runs):
    edges = vtkFlyingEdges3D()
    edges.ComputeNormalsOn()
    edges.ComputeGradientsOff()
    edges.ComputeScalarsOff()
    points = vtkIsosurfacePoints()
    times = {edges: [], points: []}
    for algorithm in times:
        algorithm.SetInputData(image)
        algorithm.SetValue(0, isovalue)
        algorithm.Update()
    for _ in range(runs):
        for algorithm, taken in times.items():
            taken.append(milliseconds(algorithm))
    return edges, points, statistics.median(times[edges]), statistics.median(times[points])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=11, help="runs of each filter (default: 11)")
    parser.add_argument("--threads", type=int, default=0, help="0, the default: as many as there are")
    arguments = parser.parse_args()
    vtkSMPTools.Initialize(arguments.threads)
    print("| volume | threads | backend | vertices | points | flying edges, ms | points, ms | ratio |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for name, image, isovalue in cases():
        edges, points, edges_time, points_time = compare(image, isovalue, arguments.runs)
        print(
            f"| {name} | {vtkSMPTools.GetEstimatedNumberOfThreads()} | {vtkSMPTools.GetBackend()}"
            f" | {edges.GetOutput().GetNumberOfPoints()} | {points.GetOutput().GetNumberOfPoints()}"
            f" | {edges_time:.1f} | {points_time:.1f} | {edges_time / points_time:.2f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
