# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

from pointsurface.volumes import gyroid_ball, otsu_threshold


def volume_of(values):
    volume = vtkImageData()
    volume.SetDimensions(len(values), 1, 1)
    volume.GetPointData().SetScalars(numpy_to_vtk(np.asarray(values, float), deep=True))
    return volume


def test_otsu_parts_two_classes_in_the_middle():
    values = [0.0] * 700 + [1.0] * 100 + [9.0] * 50 + [10.0] * 150
    assert otsu_threshold(volume_of(values)) == pytest.approx(5.0, abs=0.05)


def test_otsu_by_its_definition():
    values = np.random.default_rng(3).gamma(2.0, 30.0, 4000)
    threshold = otsu_threshold(volume_of(values))

    def within(t):
        low, high = values[values < t], values[values >= t]
        return len(low) * low.var() + len(high) * high.var()

    best = min(within(t) for t in np.linspace(values.min(), values.max(), 400)[1:-1])
    assert within(threshold) <= 1.001 * best


def test_otsu_leaves_out_what_is_not_finite():
    assert otsu_threshold(volume_of([0.0, np.nan, 0.0, 4.0, np.inf, 4.0])) == pytest.approx(2.0, abs=0.02)
    for values in ([3.0] * 5, [np.nan] * 5):
        with pytest.raises(ValueError, match="no two of its values differ"):
            otsu_threshold(volume_of(values))


def test_gyroid_lies_in_the_ball_and_on_the_gyroid():
    contour = vtkFlyingEdges3D()
    contour.SetInputData(gyroid_ball(96))
    contour.SetValue(0, 0)
    contour.Update()
    points = vtk_to_numpy(contour.GetOutput().GetPoints().GetData()).astype(float)
    distance = np.linalg.norm(points, axis=1)
    assert len(points) > 20000 and distance.max() < 0.905
    a, b, c = (2.5 * np.pi * points[:, i] for i in range(3))
    gyroid = np.sin(a) * np.cos(b) + np.sin(b) * np.cos(c) + np.sin(c) * np.cos(a)
    inside = distance < 0.87
    assert np.count_nonzero(inside) > 10000
    assert np.abs(gyroid[inside]).max() < 0.03
