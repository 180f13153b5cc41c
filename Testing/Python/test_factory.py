# SPDX-License-Identifier: BSD-3-Clause
"""The mapper that is picked for a cloud: each rule of vtkPointSurfaceMapperFactory, and what the commands make of it."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from pointsurface import (
    vtkAlgebraicSplats,
    vtkIsosurfacePoints,
    vtkPointSurfaceMapper,
    vtkPointSurfaceMapperFactory,
)
from pointsurface.methods import AUTO, METHODS, chosen
from pointsurface.readers import read
from pointsurface.volumes import gyroid_ball

CPU, OPENGL = vtkPointSurfaceMapper.CPU, vtkPointSurfaceMapper.OpenGL


def sphere(normals=True, radii=None, noise=0, share=1, count=5000, scale=1):
    """Even points of a sphere. radii: the smallest and the largest. noise: of a share of the points, all those in a cap; its
    standard deviation in mean spacings."""
    i = np.arange(count) + 0.5
    z, angle = 1 - 2 * i / count, np.pi * (1 + 5**0.5) * i
    ring = np.sqrt(1 - z * z)
    points = np.stack([ring * np.cos(angle), ring * np.sin(angle), z], axis=1)
    off = noise * np.sqrt(4 * np.pi / count) * np.random.default_rng(1).standard_normal(count) * (i < share * count)
    cloud = points_alone(scale * (1 + off[:, None]) * points)
    if normals:
        cloud.GetPointData().SetNormals(numpy_to_vtk(points.astype(np.float32), deep=True))
    if radii:
        array = numpy_to_vtk(np.linspace(*radii, len(points)), deep=True)
        array.SetName("radius")
        cloud.GetPointData().AddArray(array)
    return cloud


def points_alone(points):
    cloud = vtkPolyData()
    cloud.SetPoints(vtkPoints())
    cloud.GetPoints().SetData(numpy_to_vtk(np.asarray(points, np.float32), deep=True))
    return cloud


def bare(**arguments):
    return sphere(normals=False, **arguments)


def twice_and_not_finite():
    points = vtk_to_numpy(bare().GetPoints().GetData())
    return points_alone(np.vstack([points, points, np.full((10, 3), np.nan)]))


def lines():
    """As scanned with far fewer lines than points on a line: no plane passes through a point's neighbours."""
    x, y = np.meshgrid(np.arange(500), np.arange(10))
    return points_alone(np.stack([0.001 * x, y, 0 * x], axis=-1).reshape(-1, 3))


def with_tiny_radii():
    """Three of 5000, as isosurfaces have some."""
    cloud = sphere(radii=(0.02, 0.03))
    for i in (0, 1000, 4999):
        cloud.GetPointData().GetArray("radius").SetValue(i, 1e-6)
    return cloud


def isosurface():
    extract = vtkIsosurfacePoints()
    extract.SetInputData(gyroid_ball(128))
    extract.SetValue(0, 0)
    extract.Update()
    radii = vtk_to_numpy(extract.GetOutput().GetPointData().GetArray("radius"))
    assert radii.max() > 50 * radii.min()
    return extract.GetOutput()


def splats():
    fit = vtkAlgebraicSplats()
    fit.SetInputData(sphere())
    fit.Update()
    return fit.GetOutput()


def tree(*blocks):
    result = vtkMultiBlockDataSet()
    for i, block in enumerate(blocks):
        result.SetBlock(i, block)
    return result


@pytest.mark.parametrize("backend", [CPU, OPENGL])
@pytest.mark.parametrize(
    "make, on_cpu, on_opengl",
    [
        (sphere, "surface-splats", "pull-push"),
        (lambda: sphere(radii=(0.01, 0.45)), "surface-splats", "pull-push"),
        (lambda: sphere(radii=(0.01, 0.55)), "pull-push", "pull-push"),
        (bare, "surface-splats", "pull-push"),
        (lambda: bare(noise=0.25), "surface-splats", "pull-push"),
        (lambda: bare(noise=0.45), "direct", "direct"),
        (lambda: bare(noise=1, share=0.05), "surface-splats", "pull-push"),
        (lambda: bare(noise=1, share=0.2), "direct", "direct"),
        (lambda: bare(count=200_000), "surface-splats", "pull-push"),
        (lambda: bare(count=200_001), "direct", "direct"),
        (lambda: sphere(count=200_001), "surface-splats", "pull-push"),
        (lambda: sphere(noise=1), "surface-splats", "pull-push"),
        (lambda: bare(scale=1e-9), "surface-splats", "pull-push"),
        (lambda: bare(noise=0.45, scale=1e9), "direct", "direct"),
        (twice_and_not_finite, "surface-splats", "pull-push"),
        (lines, "direct", "direct"),
        (lambda: points_alone([[1, 2, 3]]), "direct", "direct"),
        (lambda: points_alone(np.full((5, 3), np.nan)), "direct", "direct"),
        (lambda: bare(radii=(0.01, 0.45)), "surface-splats", "pull-push"),
        (lambda: bare(radii=(0.01, 0.55)), "pull-push", "pull-push"),
        (lambda: bare(noise=1, radii=(0.01, 0.09)), "direct", "direct"),
        (lambda: bare(noise=1, radii=(0.01, 0.11)), "pull-push", "pull-push"),
        (with_tiny_radii, "surface-splats", "pull-push"),
        (isosurface, "surface-splats", "pull-push"),
        (splats, "algebraic-splats", "algebraic-splats"),
        (lambda: tree(vtkPolyData(), sphere()), "surface-splats", "pull-push"),
        (lambda: tree(sphere(), tree(bare())), "surface-splats", "pull-push"),
        (lambda: tree(sphere(), tree(bare(noise=1))), "direct", "direct"),
        (lambda: tree(bare(count=100_001), tree(bare(count=100_000))), "direct", "direct"),
        (lambda: tree(sphere(radii=(0.01, 0.1)), sphere(radii=(0.1, 0.6))), "pull-push", "pull-push"),
        (lambda: None, "direct", "direct"),
    ],
)
def test_rules(make, on_cpu, on_opengl, backend, capfd):
    mapper = vtkPointSurfaceMapperFactory.NewMapper(make(), backend)
    assert mapper.IsA(METHODS[on_cpu if backend == CPU else on_opengl].__name__), mapper.GetClassName()
    assert mapper.GetBackend() == backend
    assert mapper.GetReferenceCount() == 1
    assert "ERR|" not in capfd.readouterr().err


def test_chosen():
    assert chosen("image-space", None) == "image-space"
    assert chosen(AUTO, bare(noise=1)) == "direct"


def pointsurface(*arguments, **environment):
    return subprocess.run(
        [sys.executable, "-m", "pointsurface", *map(str, arguments)],
        env={**os.environ, **environment}, capture_output=True, text=True,
    )  # fmt: skip


@pytest.mark.parametrize("noise", [0, 1])
def test_render(tmp_path, noise):
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(bare(noise=noise))
    writer.SetFileName(str(tmp_path / "cloud.vtp"))
    writer.Write()
    assert read(str(tmp_path / "cloud.vtp")).GetNumberOfPoints() == 5000
    arguments = ("render", tmp_path / "cloud.vtp", tmp_path / "p.png", "--size", "60x60", "--method", "auto", "--json")
    result = pointsurface(*arguments)
    assert result.returncode == 0, result.stderr
    report = json.loads(result.stdout)
    is_software = any(name in report["renderer"] for name in ("llvmpipe", "softpipe", "swrast"))
    assert report["method"] == ("direct" if noise else "surface-splats" if is_software else "pull-push")
    blind = pointsurface(*arguments, DISPLAY=":9731")
    assert blind.returncode == 1 and blind.stderr.count("\n") == 1 and "cannot be opened" in blind.stderr
