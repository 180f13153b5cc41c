# SPDX-License-Identifier: BSD-3-Clause
"""Clouds from arrays of numpy."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData


def make_cloud(coordinates, normals=None, colors=None, arrays=None):
    """A vtkPolyData of n x 3 coordinates, in their precision; None of the others: the cloud has none.

    normals: n x 3; colors: n x 3, 0 to 255, which are the active scalars "RGB"; arrays: a dict of more, by their names.
    """
    cloud = vtkPolyData()
    if len(coordinates) == 0:
        return cloud
    points = vtkPoints()
    points.SetData(_array("Points", coordinates))
    cloud.SetPoints(points)
    data = cloud.GetPointData()
    if normals is not None:
        data.SetNormals(_array("Normals", np.asarray(normals, np.float32)))
    if colors is not None:
        data.SetScalars(_array("RGB", np.clip(np.nan_to_num(colors), 0, 255).astype(np.uint8)))
    for name, values in (arrays or {}).items():
        data.AddArray(_array(name, values))
    return cloud


def _array(name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    return array
