# SPDX-License-Identifier: BSD-3-Clause
"""Volumes for the demo: one that needs no file, and an isovalue for those that come without."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData


def gyroid_ball(samples=128):
    """The gyroid's labyrinth inside of a ball: the isosurface at 0 of a volume of samples^3."""
    axis = np.linspace(-1, 1, samples, dtype=np.float32)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    a, b, c = (2.5 * np.pi * coordinate for coordinate in (x, y, z))
    gyroid = np.sin(a) * np.cos(b) + np.sin(b) * np.cos(c) + np.sin(c) * np.cos(a)
    ball = 10 * (0.9 - np.sqrt(x**2 + y**2 + z**2))
    volume = vtkImageData()
    volume.SetDimensions(samples, samples, samples)
    volume.SetSpacing(*[2 / (samples - 1)] * 3)
    volume.SetOrigin(-1, -1, -1)
    scalars = numpy_to_vtk(np.minimum(gyroid, ball).ravel(), deep=True)
    scalars.SetName("gyroid in a ball")
    volume.GetPointData().SetScalars(scalars)
    return volume


def otsu_threshold(volume):
    """The isovalue that parts the values into the two classes of least variance (Otsu 1979).

    Raises ValueError if there are no two different finite values.
    """
    values = vtk_to_numpy(volume.GetPointData().GetScalars())
    values = values[np.isfinite(values)]
    if values.size == 0 or values.min() == values.max():
        raise ValueError("no two of its values differ, so that it has no isosurface")
    counts, edges = np.histogram(values, bins=256)
    centers = (edges[:-1] + edges[1:]) / 2
    below = np.cumsum(counts)[:-1].astype(float)
    above = counts.sum() - below
    sum_below = np.cumsum(counts * centers)[:-1]
    mean_below = sum_below / below
    mean_above = ((counts * centers).sum() - sum_below) / above
    between = below * above * (mean_below - mean_above) ** 2
    # Between two peaks all thresholds in the gap are equally good: the middle one is the safest.
    best = np.flatnonzero(between >= between.max() * (1 - 1e-12))
    return float(edges[1:-1][best].mean())
