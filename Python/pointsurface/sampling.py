# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of any size from a mesh."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData


def sample_by_area(mesh, count, seed=0):
    """Points spread at random over a mesh, each stretch of surface getting its share by area.

    mesh: vtkPolyData of triangles with point normals.
    count: number of points, 1 or more. The same seed gives the same points.
    Returns vtkPolyData without cells, with the point arrays "Normals" (interpolated, unit length) and "radius": twice
    the spacing of an even grid of as many points, the same for all. A disc of that radius holds 12 points on average,
    and 1 in 300000 holds none, so that the surface is closed.
    Raises ValueError for a mesh without triangles of any area or without normals.
    """
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    if mesh.GetPointData().GetNormals() is None:
        raise ValueError("the mesh has no point normals to sample")
    normals = vtk_to_numpy(mesh.GetPointData().GetNormals()).astype(float)
    a, b, c = (points[triangles[:, i]] for i in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    total = areas.sum()
    if not total > 0:
        raise ValueError("the mesh has no area to sample")

    random = np.random.default_rng(seed)
    chosen = triangles[random.choice(len(triangles), count, p=areas / total)]
    # The square root makes the density even over the triangle.
    root, along = np.sqrt(random.random(count)), random.random(count)
    weights = np.stack([1 - root, root * (1 - along), root * along], axis=1)
    sampled_normals = np.einsum("nk,nkc->nc", weights, normals[chosen])
    sampled_normals /= np.maximum(np.linalg.norm(sampled_normals, axis=1, keepdims=True), 1e-30)

    cloud = vtkPolyData()
    sampled_points = vtkPoints()
    sampled_points.SetData(_float_array(np.einsum("nk,nkc->nc", weights, points[chosen])))
    cloud.SetPoints(sampled_points)
    cloud.GetPointData().SetNormals(_float_array(sampled_normals, "Normals"))
    cloud.GetPointData().AddArray(_float_array(np.full(count, 2 * np.sqrt(total / count)), "radius"))
    return cloud


def _float_array(values, name=None):
    array = numpy_to_vtk(values.astype(np.float32), deep=True)
    if name is not None:
        array.SetName(name)
    return array
