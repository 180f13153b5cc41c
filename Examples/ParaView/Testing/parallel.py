# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of clouds that are spread over the ranks of an MPI run, each of which has a region of space, what is selected in
them, and what ranks log of them; those of several ranks are compared with those of one, which has to run first. Symmetric:
every rank runs this."""

import os
import re
import sys
import traceback

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkLogger
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

import scene
from spread import cloud, controller, polydata, rank, ranks, sphere


def source_of(data):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def dragon():
    source = scene.load("clouds/dragon.vtp")
    data = source.GetClientSideObject().GetOutputDataObject(0)
    arrays = {
        name: vtk_to_numpy(data.GetPointData().GetArray(name))
        for name in ("Normals", "radius")
        if data.GetPointData().HasArray(name)
    }
    return vtk_to_numpy(data.GetPoints().GetData()), arrays


def splats(points, arrays):
    """Those fitted to the whole cloud, which every rank does alike, spread as points are."""
    fitted = simple.AlgebraicSplats(source_of(polydata(points, arrays)))
    fitted.UpdatePipeline()
    data = fitted.GetClientSideObject().GetOutputDataObject(0)
    fields = data.GetPointData()
    values = {fields.GetArrayName(i): vtk_to_numpy(fields.GetArray(i)) for i in range(fields.GetNumberOfArrays())}
    return cloud(vtk_to_numpy(data.GetPoints().GetData()), **values)


def tree(points, arrays):
    upper = points[:, 2] > 0
    blocks = vtkMultiBlockDataSet()
    for i, chosen in enumerate((upper, ~upper)):
        blocks.SetBlock(i, cloud(points, chosen, **arrays))
    return blocks


def check(holds, message):
    if not holds:
        print(f"ERROR: {message}", flush=True)


def stop(*exception):
    """Ends the other ranks too, which would wait for this one."""
    traceback.print_exception(*exception)
    sys.stderr.flush()
    os._exit(1)


sys.excepthook = stop


def compare(path, name, limit):
    """Compares a picture with that of one rank."""
    if rank > 0 or ranks == 1:
        return
    difference, unfilled = scene.compare_with_one_rank(scene.read(path), name, ranks, label=name)
    check(difference < limit and unfilled == 0, f"{name} differs from the serial picture")


def draw(view, name, source, system, limit=0.01, **properties):
    scene.show(source, view, system, **properties)
    path = scene.save(view, f"parallel-{ranks}-{name}")
    check(ranks == 1 or view.GetClientSideObject().GetUseDistributedRenderingForRender(), "one rank draws all")
    compare(path, name, limit)
    simple.Hide(source, view)


def order(name):
    """That where pictures of two ranks are blended the nearer one's is in front, though copies reach into the other's region:
    of two sheets, seen from either side, with a border below that is near to the other's."""
    y, z = (axis.ravel() for axis in np.meshgrid(np.linspace(-1, 1, 41), np.linspace(-1, 1, 41)))
    x = np.where(z < -0.9, 0.1, 0.5)
    points = np.concatenate([np.stack([side * x, y, z], axis=-1) for side in (-1, 1)])
    points *= 0.1  # ParaView 5.11 takes overlaps as whole numbers
    sheet = np.sign(points[:, 0])
    normals = np.tile([1.0, 0.0, 0.0], (len(points), 1))
    sheets = source_of(cloud(points, Normals=normals, radius=np.full(len(points), 0.006), sheet=sheet))
    view = scene.view(scale=0.125)
    for side in (-1, 1):
        view.CameraPosition = [6 * side, 0, 0]
        display = scene.show(sheets, view, "Pull-Push", Opacity=0.5, ColorArrayName=["POINTS", "sheet"])
        display.LookupTable = simple.GetColorTransferFunction("sheet")
        display.LookupTable.RescaleTransferFunction(-1, 1)  # blue to red
        path = scene.save(view, f"parallel-{ranks}-{name}{side:+}")
        if rank == 0:
            red, _, blue = scene.read(path)[100:200, 100:200].mean(axis=(0, 1))
            print(f"{name}: from x = {view.CameraPosition[0]}: red {red:.0f}, blue {blue:.0f}", flush=True)
            check(side * (red - blue) > 10, f"{name}: the farther rank is in front, seen from x = {view.CameraPosition[0]}")


def turn(view, name, source):
    """The picture while the camera moves, of one point in 16, the same ones by any number of ranks."""
    view.LODThreshold = 0
    view.LODResolution = 0.5
    view.ImageReductionFactor = 1
    scene.show(source, view, "Pull-Push")
    simple.Render(view)
    file = f"parallel-{ranks}-{name}" + (f"-rank{rank}" if rank > 0 else "")
    compare(scene.save_interactive(view, file), name, limit=1)
    simple.Hide(source, view)
    view.LODThreshold = 20


def gather(array):
    """Of all ranks, one after the other, on the first one."""
    if ranks == 1:
        return vtk_to_numpy(array)
    every = vtkFloatArray()
    controller.GatherV(array, every, 0)
    return vtk_to_numpy(every) if rank == 0 else None


def select(view, name, source):
    """That the points selected in the view are those that one rank selects: by the first rank, whose selection a client gets
    and sends to all. ParaView's composited picture is there alone; the others pick from what they draw themselves."""
    scene.show(source, view, "Pull-Push")
    simple.Render(view)
    simple.SetActiveSource(source)
    simple.SelectSurfacePoints(Rectangle=[20, 100, 279, 199], View=view)
    ids = source.SMProxy.GetSelectionInput(0).GetProperty("Input").GetProxy(0).GetProperty("IDs")
    picked = np.reshape([ids.GetElement(i) for i in range(ids.GetNumberOfElements())], (-1, 2)).astype(int)
    own = source.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("number")
    count = numpy_to_vtk(np.array([own.GetNumberOfTuples()], np.float32), deep=True)
    every, counts = gather(own), gather(count)
    simple.ClearSelection(source)
    simple.Hide(source, view)
    if rank > 0:
        return
    first = np.concatenate([[0], np.cumsum(counts)]).astype(int)  # of each rank's points
    numbers = every[first[picked[:, 0]] + picked[:, 1]].astype(int)
    path = os.path.join(scene.OUTPUT, f"parallel-{name}.npy")
    if ranks == 1:
        check(len(numbers) > 1000, f"{name} has {len(numbers)} points")
        np.save(path, numbers)
        return
    expected = np.load(path)
    missing, added = np.setdiff1d(expected, numbers), np.setdiff1d(numbers, expected)
    print(f"{name}: {len(expected)} points by one rank; {len(missing)} of them missing, {len(added)} added", flush=True)
    check(len(numbers) == len(set(numbers)), f"{name} tells points twice")
    check((np.bincount(picked[:, 0], minlength=ranks) > 100).all(), f"{name} has no points of some rank")
    check(max(len(missing), len(added)) < 0.01 * len(expected), f"{name} differs")


def check_log(path, count):
    """That each rank logs how many points it draws: its own, and the copies that it was sent."""
    vtkLogger.EndLogToFile(path)
    with open(path) as file:
        found = re.findall(r"(\d+) points, (\d+) of them copies", file.read())
    own = {int(points) - int(copies) for points, copies in found}
    copies = {int(copies) for _, copies in found}
    print(f"rank {rank} logs {own} own points, {copies} copies", flush=True)
    check(own == {count} and min(copies) > 0, f"rank {rank} does not log its {count} points")


if rank == 0 and ranks > 1:
    print("| picture | ranks | grey levels | unfilled | more | pixels |")
log = os.path.join(scene.OUTPUT, f"parallel-{ranks}-rank{rank}.log")
vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_WARNING)
vtkLogger.LogToFile(log, vtkLogger.TRUNCATE, vtkLogger.VERBOSITY_INFO)
view = scene.view()
points, arrays = sphere()
arrays["number"] = np.arange(len(points), dtype=float)
whole = source_of(cloud(points, **arrays))
for system in ("Pull-Push", "Image-Space", "Surface Splats"):
    draw(view, system, whole, system)
draw(view, "Direct", whole, "Direct")
if ranks > 1:
    check_log(log, whole.GetClientSideObject().GetOutputDataObject(0).GetNumberOfPoints())
draw(view, "Algebraic Splats", source_of(splats(points, arrays)), "Algebraic Splats")
draw(view, "of-one-rank", source_of(cloud(points, points[:, 0] < -0.4, **arrays)), "Pull-Push")  # others have no point
draw(view, "translucent", whole, "Pull-Push", Opacity=0.5, BackfaceRepresentation="Cull Backface")
scene.show(whole, view, "Pull-Push", Opacity=1, BackfaceRepresentation="Follow Frontface")
if ranks == 2:
    order("order")
select(view, "selection", whole)
turn(view, "turning", whole)
del arrays["radius"]
plain = source_of(cloud(points, **arrays))
draw(view, "estimated-radii", plain, "Pull-Push")
turn(view, "turning-estimated-radii", plain)
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
draw(view, "dragon-Direct", model, "Direct")
