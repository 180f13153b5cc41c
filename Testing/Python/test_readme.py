# SPDX-License-Identifier: BSD-3-Clause
"""The README's code does what it says: its Python runs as it stands, its C++ is that of the consumer project."""

import os
import re
import subprocess
import sys

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOPLY import vtkPLYWriter

PROJECT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")


def code_of_readme(language, index=0):
    with open(os.path.join(PROJECT, "README.md"), encoding="utf-8") as file:
        return re.findall(rf"```{language}\n(.*?)```", file.read(), re.DOTALL)[index]


def write_cloud(tmp_path):
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(100)
    sphere.SetPhiResolution(100)
    writer = vtkPLYWriter()
    writer.SetInputConnection(sphere.GetOutputPort())
    writer.SetFileName(str(tmp_path / "cloud.ply"))
    writer.Write()


def read_brightness(path):
    """The largest component of each pixel."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).max(axis=1).reshape(height, width).astype(int)


def test_python_draws_a_surface(tmp_path):
    write_cloud(tmp_path)
    code = code_of_readme("python")
    assert len(code.splitlines()) == 8
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=True)

    lit = read_brightness(tmp_path / "cloud.png") > 0
    assert lit.shape == (600, 800)
    # the sphere's disc, as the camera's reset leaves it: half of the window's height across
    assert np.pi * 150**2 * 0.9 < lit.sum() < np.pi * 150**2 * 1.3
    y, x = np.indices(lit.shape)
    assert lit[(y - 299.5) ** 2 + (x - 399.5) ** 2 < 140**2].all(), "holes in the surface"


def test_five_lines_of_pyvista(tmp_path):
    pytest.importorskip("pyvista", reason="PyVista is not installed; the wheel's tests have it")
    write_cloud(tmp_path)
    code = code_of_readme("python", 1)
    assert "add_point_surface" in code and len(code.splitlines()) == 5
    code = code.replace("plotter.show()", 'plotter.background_color = "black"; plotter.show(screenshot="cloud.png")')
    environment = {**os.environ, "PYVISTA_OFF_SCREEN": "true"}
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=environment, check=True)
    lit = read_brightness(tmp_path / "cloud.png") > 20
    rows, columns = lit.any(axis=1).sum(), lit.any(axis=0).sum()
    assert rows > 200 and rows == pytest.approx(columns, abs=3)
    assert lit.sum() == pytest.approx(np.pi / 4 * rows * columns, rel=0.02), "a whole disc"


def test_cpp_is_what_the_consumer_project_builds():
    with open(os.path.join(PROJECT, "Testing", "Consumer", "main.cxx"), encoding="utf-8") as file:
        consumer = {line.strip() for line in file}
    lines = code_of_readme("cpp").splitlines()
    assert len(lines) == 12
    assert [line for line in lines if line not in consumer] == []
