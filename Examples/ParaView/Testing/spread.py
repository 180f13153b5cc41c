# SPDX-License-Identifier: BSD-3-Clause
"""Clouds that are spread over the ranks of a run, for what runs on every rank: nothing of ParaView's client."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkParallelCore import vtkMultiProcessController

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()


def polydata(points, arrays):
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points, np.float32), deep=True))
    for name, values in arrays.items():
        kind = np.float32 if values.dtype.kind == "f" else values.dtype
        array = numpy_to_vtk(np.ascontiguousarray(values, kind), deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    if "Normals" in arrays:
        data.GetPointData().SetActiveNormals("Normals")
    return data


def cloud(points, chosen=None, **arrays):
    """Of points and point arrays, those that this rank has: a slab in x of its own."""
    own = np.minimum((np.argsort(np.argsort(points[:, 0])) * ranks) // len(points), ranks - 1) == rank
    if chosen is not None:
        own &= chosen
    return polydata(points[own], {name: values[own] for name, values in arrays.items()})


def sphere(count=20000):
    """Points and arrays of scene.sphere_points, with radii that vary."""
    i = np.arange(count) + 0.5
    z = 1 - 2 * i / count
    angle = np.pi * (1 + 5**0.5) * i
    r = np.sqrt(1 - z * z)
    points = np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=-1)
    radius = np.sqrt(4 * np.pi / count) * (1.5 + 0.5 * (np.arange(count) % 3 == 0))
    return points, {"Normals": points, "height": z, "radius": radius}
