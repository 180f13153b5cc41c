#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Table 1 of the pull-push paper (Marroquim, Kraus, Cavalcanti 2007), of this machine, with peers beside it.

    python3 Testing/Benchmarks/table1.py [--output [FILE]]

Each figure comes from a process of its own: the median of 20 frames after warm-up, until OpenGL has finished them, with
the camera moving. PYTHONPATH must lead to the package pointsurface. The models lie in ../shared/data beside the project,
or in the folder POINTSURFACE_SHARED_DATA; without them a torus takes the place of all.
"""

import os

from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from apart import main, measure_apart
from pointsurface import vtkPullPushMapper
from pointsurface.peers import gaussian_discs
from pointsurface.rendering import offscreen_window, renderer_string
from pointsurface.sampling import sample_by_area
from pointsurface.timing import time_frames

PROJECT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
DATA = os.environ.get("POINTSURFACE_SHARED_DATA", os.path.join(PROJECT, "..", "shared", "data"))
# As many points as the paper's models have, on ours.
CASES = (("bunny", 25_000), ("armadillo", 173_000), ("buddha", 544_000), ("dragon", 3_610_000))
SIZES = (512, 1024)
RENDERERS = ("published", "default", "gaussian", "mesh")
OURS = RENDERERS[:2]


def read_model(name):
    """A mesh of triangles with normals, and what it is called."""
    path = os.path.join(DATA, "meshes", f"{name}.vtp")
    if os.path.exists(path):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(path)
        reader.Update()
        return reader.GetOutput(), name
    torus = vtkParametricFunctionSource()
    torus.SetParametricFunction(vtkParametricTorus())
    torus.SetUResolution(300)
    torus.SetVResolution(150)
    torus.Update()
    return torus.GetOutput(), "torus"


def make_mapper(renderer_name, mesh, count):
    if renderer_name == "mesh":
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(mesh)
        mapper.ScalarVisibilityOff()
        return mapper
    cloud = sample_by_area(mesh, count)
    if renderer_name not in OURS:
        return gaussian_discs(cloud)
    mapper = vtkPullPushMapper()
    if renderer_name == "published":
        mapper.SetToPublished()
    mapper.SetInputData(cloud)
    return mapper


def measure(renderer_name, model, count, size):
    """Milliseconds a frame; also the model's name and the renderer string."""
    mesh, model = read_model(model)
    mapper = make_mapper(renderer_name, mesh, count)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetBackfaceCulling(renderer_name == "published")  # section 3.1
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    window = offscreen_window(renderer, (size, size))
    renderer.ResetCamera(mesh.GetBounds())
    renderer.GetActiveCamera().Zoom(1.4)
    result = time_frames(window, renderer, mapper=mapper if renderer_name in OURS else None)
    result.update(model=model, triangles=mesh.GetNumberOfPolys(), renderer=renderer_string(window))
    return result


def make_table(cases=CASES, sizes=SIZES):
    """The table as Markdown; one row a model and size."""
    lines = []
    for model, count in cases:
        for size in sizes:
            results = {name: measure_apart(__file__, name, model, count, size) for name in RENDERERS}
            ours = [
                f"{result['frame']:.1f} ({result['project']:.1f}, {result['reconstruct']:.1f})"
                for result in (results[name] for name in OURS)
            ]
            mesh = results["mesh"]
            lines.append(
                f"| {mesh['model']} | {count} | {size} x {size} | {ours[0]} | {ours[1]} "
                f"| {results['gaussian']['frame']:.1f} | {mesh['frame']:.1f} ({mesh['triangles']}) |"
            )
    head = f"""# Table 1 of the pull-push paper, measured

Milliseconds a frame: the median of 20, camera moving, on {mesh['renderer']}. In brackets the projection of the points
and the pull-push interpolation, by OpenGL's timer or, on the CPU back end, the clock, and the number of triangles of the mesh. As published: backface
culling on, the departures from the paper off. The points are sampled uniformly by area. Bunny, armadillo, buddha and
dragon are of the Stanford University Computer Graphics Laboratory.

| model | points | viewport | pull-push as published | vtkPullPushMapper | vtkPointGaussianMapper, discs | mesh |
| --- | ---: | --- | ---: | ---: | ---: | ---: |
"""
    return head + "\n".join(lines) + "\n"


if __name__ == "__main__":
    main(__file__, __doc__, measure, make_table)
