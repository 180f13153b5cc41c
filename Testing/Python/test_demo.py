# SPDX-License-Identifier: BSD-3-Clause
"""The command line as a user types it: each case is a process of its own."""

import os
import re
import subprocess
import sys

import numpy as np
import pytest
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkNIFTIImageWriter, vtkPNGReader
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLPolyDataWriter

PICTURES = ("points", "mesh", "difference", "montage")


def demo(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "pointsurface", "demo", *map(str, arguments)], capture_output=True, text=True
    )


def ball():
    """A volume whose isosurface at 0 is a sphere of radius 10."""
    axis = np.arange(-14.0, 15.0)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    volume = vtkImageData()
    volume.SetDimensions(29, 29, 29)
    volume.GetPointData().SetScalars(
        numpy_to_vtk((10 - np.sqrt(x**2 + y**2 + z**2)).ravel().astype(np.float32), deep=True)
    )
    return volume


def sphere():
    source = vtkSphereSource()
    source.SetThetaResolution(100)
    source.SetPhiResolution(60)
    source.Update()
    return source.GetOutput()


def write(writer, data, path):
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    writer.Write()
    return path


def read_png(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1)


def figure(report, name):
    """The first number of a row of the table."""
    return float(re.search(rf"^  {name} +([-+.\d]+)", report, re.M).group(1))


def check_measures(report):
    # A sphere of a few thousand points in a small picture; the mapper's own tests ask for more.
    assert figure(report, "PSNR") > 20
    assert figure(report, "SSIM") > 0.8
    assert figure(report, "normal error") < 6
    assert figure(report, "depth error") < 2
    assert figure(report, "silhouettes") > 0.93
    assert figure(report, "unfilled") < 3


def test_volume(tmp_path):
    path = write(vtkXMLImageDataWriter(), ball(), tmp_path / "ball.vti")
    result = demo(path, "--isovalue", 0, "--size", "160x120", "--output", tmp_path / "out")
    assert result.returncode == 0, result.stderr
    assert "Isosurface of ball.vti at 0, 160 x 120 pixels" in result.stdout
    assert 1000 < figure(result.stdout, "points") < 4000
    for stage in ("extract points", "project", "reconstruct", "shade", "whole frame"):
        assert figure(result.stdout, stage) >= 0
    assert figure(result.stdout, "whole frame") > 0
    assert re.search(r"^  OpenGL renderer +\w+", result.stdout, re.M)
    check_measures(result.stdout)
    assert sorted(os.listdir(tmp_path / "out")) == sorted(f"{name}.png" for name in PICTURES)
    for name in ("points", "mesh", "difference"):
        picture = read_png(tmp_path / "out" / f"{name}.png")
        assert picture.shape == (120, 160, 3)
        assert picture.std() > 5, f"{name}.png shows something"
    assert read_png(tmp_path / "out" / "montage.png").shape == (120, 480, 3)


@pytest.mark.parametrize("extension, writer", [("mhd", vtkMetaImageWriter), ("nii.gz", vtkNIFTIImageWriter)])
def test_volume_without_isovalue(tmp_path, extension, writer):
    path = write(writer(), ball(), tmp_path / f"ball.{extension}")
    result = demo(path, "--size", "96x64", "--output", tmp_path / "out")
    assert result.returncode == 0, result.stderr
    assert re.search(r"Isovalue by Otsu's threshold: -?[.\d]+ ", result.stdout)


@pytest.mark.parametrize(
    "extension, writer",
    [("vtp", vtkXMLPolyDataWriter), ("ply", vtkPLYWriter), ("obj", vtkOBJWriter), ("stl", vtkSTLWriter)],
)
def test_mesh(tmp_path, extension, writer):
    path = write(writer(), sphere(), tmp_path / f"sphere.{extension}")
    result = demo(path, "--size", "160x120", "--output", tmp_path / "out")
    assert result.returncode == 0, result.stderr
    assert figure(result.stdout, "points") == sphere().GetNumberOfPoints()
    if extension in ("vtp", "obj"):  # the files with normals; for others they are estimated
        check_measures(result.stdout)


def test_points_without_a_mesh(tmp_path):
    points = vtk_to_numpy(sphere().GetPoints().GetData())
    path = tmp_path / "sphere.xyz"
    np.savetxt(path, np.hstack([points, 2 * points]))
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "mesh.png").write_text("of an earlier run")
    (tmp_path / "out" / "notes.txt").write_text("the user's own")
    result = demo(path, "--size", "96x64", "--output", tmp_path / "out")
    assert result.returncode == 0, result.stderr
    assert "no polygons, so there is no true surface" in result.stdout
    assert "PSNR" not in result.stdout
    assert sorted(os.listdir(tmp_path / "out")) == ["notes.txt", "points.png"]
    assert read_png(tmp_path / "out" / "points.png").std() > 5


def check_fault(result, *words):
    assert result.returncode == 2, result.stderr
    assert result.stdout == ""
    assert result.stderr.count("\n") == 1, result.stderr
    for word in words:
        assert word in result.stderr


def test_wrong_use(tmp_path):
    check_fault(demo(tmp_path / "absent.vti"), "absent.vti does not exist")
    check_fault(demo(tmp_path), "is a folder")
    check_fault(demo("--size", "big"), "big is not WIDTHxHEIGHT")
    check_fault(demo("--size", "0x100"), "0x100")
    for value in ("skin", "nan", "inf"):
        check_fault(demo("--isovalue", value), "--isovalue", value)
    check_fault(demo("--colour", "red"), "--colour")
    (tmp_path / "broken.vtp").write_text("<VTKFile>")
    check_fault(demo(tmp_path / "broken.vtp"), "broken.vtp cannot be read")


def test_values_without_a_surface(tmp_path):
    path = write(vtkXMLImageDataWriter(), ball(), tmp_path / "ball.vti")
    check_fault(demo(path, "--isovalue", 1000, "--output", tmp_path / "out"), "no surface at isovalue 1000", "10")
    cloud = write(vtkXMLPolyDataWriter(), sphere(), tmp_path / "sphere.vtp")
    check_fault(demo(cloud, "--isovalue", 1), "is no volume")
    assert not os.path.exists(tmp_path / "out")


def test_output_that_is_a_file(tmp_path):
    path = write(vtkXMLImageDataWriter(), ball(), tmp_path / "ball.vti")
    (tmp_path / "out").write_text("")
    check_fault(demo(path, "--isovalue", 0, "--output", tmp_path / "out"), "out: File exists")
