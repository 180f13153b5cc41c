# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource

from pointsurface.sampling import sample_by_area


def triangles_of(source):
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(source.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def fine_sphere():
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(200)
    sphere.SetPhiResolution(100)
    return triangles_of(sphere)


def test_sphere():
    count = 40_000
    cloud = sample_by_area(fine_sphere(), count)
    points = vtk_to_numpy(cloud.GetPoints().GetData())
    normals = vtk_to_numpy(cloud.GetPointData().GetNormals())
    assert points.shape == (count, 3) and cloud.GetNumberOfCells() == 0
    assert np.abs(np.linalg.norm(points, axis=1) - 0.5).max() < 5e-4
    assert np.abs(normals - 2 * points).max() < 2e-3
    # By Archimedes each coordinate of an even spread over a sphere is evenly spread, although the mesh is denser at
    # its poles: a tenth of the points in each tenth, within four standard deviations.
    for axis in range(3):
        shares, _ = np.histogram(points[:, axis], bins=10, range=(-0.5, 0.5))
        assert np.abs(shares - count / 10).max() < 4 * np.sqrt(count * 0.09)
    assert np.allclose(vtk_to_numpy(cloud.GetPointData().GetArray("radius")), 2 * np.sqrt(np.pi / count), rtol=1e-3)


def test_even_within_a_triangle():
    points = vtk_to_numpy(sample_by_area(triangles_of(vtkPlaneSource()), 40_000).GetPoints().GetData())
    counts, _, _ = np.histogram2d(points[:, 0], points[:, 1], bins=10, range=[(-0.5, 0.5)] * 2)
    assert np.abs(counts - 400).max() < 4.5 * np.sqrt(400)


def test_seed():
    first, same, other = (
        vtk_to_numpy(sample_by_area(fine_sphere(), 100, seed).GetPoints().GetData()) for seed in (1, 1, 2)
    )
    assert np.array_equal(first, same) and not np.allclose(first, other)


def test_faults():
    bare = vtkPolyData()
    bare.CopyStructure(fine_sphere())
    with pytest.raises(ValueError, match="no point normals"):
        sample_by_area(bare, 10)
