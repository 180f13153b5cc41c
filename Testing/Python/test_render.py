# SPDX-License-Identifier: BSD-3-Clause
"""The commands render and info as a user types them."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter


def pointsurface(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "pointsurface", *map(str, arguments)], capture_output=True, text=True
    )


def read_png(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1).astype(int)


@pytest.fixture(scope="module")
def half_sphere(tmp_path_factory):
    """The half x > 0 of a sphere around the origin, with an array "z"."""
    source = vtkSphereSource()
    source.SetThetaResolution(200)
    source.SetPhiResolution(100)
    source.SetStartTheta(270)
    source.SetEndTheta(89.9)
    source.Update()
    cloud = source.GetOutput()
    z = numpy_to_vtk(vtk_to_numpy(cloud.GetPoints().GetData())[:, 2].copy(), deep=True)
    z.SetName("z")
    cloud.GetPointData().AddArray(z)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(cloud)
    path = tmp_path_factory.mktemp("cloud") / "half.vtp"
    writer.SetFileName(str(path))
    writer.Write()
    return path


def test_render(half_sphere, tmp_path):
    picture = tmp_path / "half.png"
    result = pointsurface(
        "render", half_sphere, picture, "--size", "120x90", "--view", "front", "--color", "#00ff00", "--radius", "0.012",
        "--background", "white", "--json",
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    report = json.loads(result.stdout)
    assert report["points"] > 5000 and report["method"] == "pull-push" and report["renderer"]
    assert all(milliseconds >= 0 for milliseconds in report["milliseconds"].values())
    image = read_png(picture)
    assert image.shape == (90, 120, 3)
    covered = image[:, :, 0] < 200
    assert (image[0, 0] == 255).all()
    green = image[covered]
    assert (green[:, 1] > green[:, 0]).all()
    # seen from the front, half of a disc, as high as it is wide twice
    rows, columns = covered.any(axis=1).sum(), covered.any(axis=0).sum()
    assert rows == pytest.approx(2 * columns, abs=8)  # in perspective the open side is seen a little from within
    assert covered.sum() == pytest.approx(np.pi / 4 * rows * columns, rel=0.06)


def test_scalars_and_view(half_sphere, tmp_path):
    picture = tmp_path / "half.png"
    result = pointsurface("render", half_sphere, picture, "--size", "90x90", "--view", "right", "--scalars", "z")
    assert result.returncode == 0, result.stderr
    assert result.stdout == ""
    image = read_png(picture)
    bottom, top = image[20, 45], image[70, 45]  # row 0 is the lowest
    assert bottom[2] > bottom[0] + 30, "low is blue"
    assert top[0] > top[2] + 30, "high is red"


def test_info(half_sphere):
    result = pointsurface("info", half_sphere, "--json")
    assert result.returncode == 0, result.stderr
    content = json.loads(result.stdout)
    assert content["kind"] == "points"
    assert content["bounds"][:2] == pytest.approx([0, 0.5], abs=1e-3)
    arrays = {array["name"]: array for array in content["arrays"]}
    assert arrays["z"]["range"] == pytest.approx([-0.5, 0.5])
    assert arrays["z"]["components"] == 1
    text = pointsurface("info", half_sphere).stdout
    assert "radii        none: a mapper estimates them" in text
    assert "normals      of the file" in text


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["--scalars", "w"], 'no point array "w"; it has: Normals, z'),
        (["--color", "mud"], "mud is no colour"),
        (["--radius", "-1"], "-1 is no number over 0"),
        (["--method", "magic"], "magic"),
        (["--isovalue", "3"], "is no volume"),
        (["--supersampling", "9"], "9"),
    ],
)
def test_wrong_use(half_sphere, tmp_path, arguments, words):
    result = pointsurface("render", half_sphere, tmp_path / "p.png", *arguments)
    assert result.returncode == 2
    assert words in result.stderr
    assert result.stderr.count("\n") == 1
    assert not os.path.exists(tmp_path / "p.png")


def test_folder_that_is_not_there(half_sphere, tmp_path):
    result = pointsurface("render", half_sphere, tmp_path / "absent" / "p.png")
    assert result.returncode == 2 and "is no folder" in result.stderr and result.stderr.count("\n") == 1
