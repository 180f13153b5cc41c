# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of clouds that are spread over the ranks of an MPI run, each of which has a region of space; those of several
ranks are compared with those of one, which has to run first. Symmetric: every rank runs this."""

import os

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkParallelCore import vtkMultiProcessController

import scene

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()


def cloud(points, chosen=None, **arrays):
    """Of points and point arrays, those that this rank has: a slab in x of its own."""
    own = np.minimum((np.argsort(np.argsort(points[:, 0])) * ranks) // len(points), ranks - 1) == rank
    if chosen is not None:
        own &= chosen
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points[own], np.float32), deep=True))
    for name, values in arrays.items():
        array = numpy_to_vtk(np.ascontiguousarray(values[own], np.float32), deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    if "Normals" in arrays:
        data.GetPointData().SetActiveNormals("Normals")
    return data


def source_of(data):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def sphere(count=20000):
    """As scene.sphere_points, with radii that vary."""
    i = np.arange(count) + 0.5
    z = 1 - 2 * i / count
    angle = np.pi * (1 + 5**0.5) * i
    r = np.sqrt(1 - z * z)
    points = np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=-1)
    radius = np.sqrt(4 * np.pi / count) * (1.5 + 0.5 * (np.arange(count) % 3 == 0))
    return points, {"Normals": points, "height": z, "radius": radius}


def dragon():
    source = scene.load("clouds/dragon.vtp")
    data = source.GetClientSideObject().GetOutputDataObject(0)
    arrays = {
        name: vtk_to_numpy(data.GetPointData().GetArray(name))
        for name in ("Normals", "radius")
        if data.GetPointData().HasArray(name)
    }
    return vtk_to_numpy(data.GetPoints().GetData()), arrays


def tree(points, arrays):
    upper = points[:, 2] > 0
    blocks = vtkMultiBlockDataSet()
    for i, chosen in enumerate((upper, ~upper)):
        blocks.SetBlock(i, cloud(points, chosen, **arrays))
    return blocks


def draw(view, name, source, system, limit=0.01, allowed=0):
    """Draws a picture, compares it with that of one rank, and prints a row of the table in Parallel.md: by the mean
    difference in grey levels, of which a seam with no exchange makes 0.01 to 0.03 on the sphere; and by the share of pixels
    that are left out, all of them at outlines."""
    scene.show(source, view, system)
    levels = scene.picture(view, f"parallel-{ranks}-{name}")
    if ranks > 1 and not view.GetClientSideObject().GetUseDistributedRenderingForRender():
        print("ERROR: one rank draws all")
    simple.Hide(source, view)
    if rank > 0 or ranks == 1:
        return
    serial = scene.read(os.path.join(scene.OUTPUT, f"parallel-1-{name}.png"))
    ours, theirs = scene.covered(levels), scene.covered(serial)
    difference = np.abs(levels - serial)[ours | theirs].mean()
    unfilled, more = (theirs & ~ours).sum(), (ours & ~theirs).sum()
    holes = scene.compare(levels, serial, name)[2]
    print(f"| {name} | {ranks} | {difference:.3f} | {unfilled} | {more} | {theirs.sum()} |", flush=True)
    if difference >= limit or holes or unfilled > allowed * theirs.sum():
        print(f"ERROR: {name} differs from the serial picture", flush=True)  # an exit would leave the others waiting


if rank == 0 and ranks > 1:
    print("| picture | ranks | grey levels | unfilled | more | pixels |")
view = scene.view()
points, arrays = sphere()
whole = source_of(cloud(points, **arrays))
for system in ("Pull-Push", "Image-Space", "Surface Splats"):
    draw(view, system, whole, system)
draw(view, "Direct", whole, "Direct", limit=1, allowed=0.01)  # as fine as the whole cloud is, of which a rank sees a part
del arrays["radius"]
draw(view, "estimated-radii", source_of(cloud(points, **arrays)), "Pull-Push")
draw(view, "blocks", source_of(tree(points, arrays)), "Pull-Push", limit=0.015)

points, arrays = dragon()
view = scene.view(700, 500)
view.CameraParallelProjection = 0
view.CameraFocalPoint = [0, 0, 0]
view.CameraPosition = [0.3, 0.35, 1]
view.CameraViewUp = [0, 1, 0]
model = source_of(cloud(points, **arrays))
scene.show(model, view, "Pull-Push")
simple.ResetCamera(view)
simple.Hide(model, view)
for system in ("Pull-Push", "Image-Space"):
    draw(view, f"dragon-{system}", model, system, limit=0.3)
