# SPDX-License-Identifier: BSD-3-Clause
"""Files of the Point Cloud Library, written by hand: opened where PCL is built in, else the option is named."""

import importlib.util
import subprocess
import sys

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy

from pointsurface.readers import UnreadableFile, read

HAS_PCL = importlib.util.find_spec("pointsurface.vtkPointSurfacePCL") is not None
needs_pcl = pytest.mark.skipif(not HAS_PCL, reason="this build has no PCL (POINTSURFACE_PCL)")

HEADER = """VERSION 0.7
FIELDS x y z intensity rgb
SIZE 4 4 4 2 4
TYPE F F F U U
COUNT 1 1 1 1 1
WIDTH {count}
HEIGHT 1
VIEWPOINT 1 2 3 1 0 0 0
POINTS {count}
DATA {encoding}
"""
ROW = np.dtype([("xyz", "<f4", 3), ("intensity", "<u2"), ("rgb", "<u4")])


def rows(count):
    """A sphere with intensities 0, 1, 2... and colours 0x010203, 0x010204..."""
    z = 1 - (2 * np.arange(count) + 1) / count
    angle = np.arange(count) * np.pi * (3 - 5**0.5)
    r = np.sqrt(1 - z**2)
    result = np.zeros(count, ROW)
    result["xyz"] = np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=1)
    result["intensity"] = np.arange(count)
    result["rgb"] = 0x010203 + np.arange(count)
    return result


def write(path, points, encoding="binary"):
    data = points.tobytes()
    if encoding == "ascii":
        lines = (" ".join(map(str, (*p["xyz"], p["intensity"], p["rgb"]))) for p in points)
        data = "\n".join(lines).encode() + b"\n"
    path.write_bytes(HEADER.format(count=len(points), encoding=encoding).encode() + data)


def command(*arguments, without_pcl=False):
    """The command line in a process of its own; without_pcl: as in a build that has none."""
    code = "import sys\n"
    if without_pcl:
        code += "sys.modules['pointsurface.vtkPointSurfacePCL'] = None\n"
    code += "from pointsurface.__main__ import main\nsys.exit(main())\n"
    return subprocess.run([sys.executable, "-c", code, *map(str, arguments)], capture_output=True, text=True)


@needs_pcl
@pytest.mark.parametrize("encoding", ["ascii", "binary"])
def test_content(tmp_path, encoding):
    path = tmp_path / "cloud.PCD"
    points = rows(500)
    write(path, points, encoding)
    cloud = read(str(path))
    data = cloud.GetPointData()
    assert np.array_equal(vtk_to_numpy(cloud.GetPoints().GetData()), points["xyz"])
    assert np.array_equal(vtk_to_numpy(data.GetArray("intensity")), points["intensity"])
    colors = vtk_to_numpy(data.GetScalars())
    assert np.array_equal(colors @ [1 << 16, 1 << 8, 1], points["rgb"])
    assert vtk_to_numpy(cloud.GetFieldData().GetArray("viewpoint")).tolist() == [1, 2, 3, 1, 0, 0, 0]
    assert vtk_to_numpy(cloud.GetFieldData().GetArray("organised_dims")).tolist() == [500, 1]


@needs_pcl
def test_faults(tmp_path, capfd):
    path = tmp_path / "cloud.pcd"
    write(path, rows(10))
    for content, word in (
        (path.read_bytes()[:-1], "cut short"),
        (path.read_bytes().replace(b"POINTS 10", b"POINTS 11"), "POINTS"),
        (b"\x00\xff\x13 no such thing \n" * 50, "header"),
    ):
        path.write_bytes(content)
        with pytest.raises(UnreadableFile, match=word) as fault:
            read(str(path))
        assert str(path) in str(fault.value) and "\n" not in str(fault.value)
    assert capfd.readouterr() == ("", "")  # nothing of PCL's


@needs_pcl
def test_command_line(tmp_path):
    path = tmp_path / "cloud.pcd"
    write(path, rows(2000))
    info = command("info", path)
    assert info.returncode == 0 and "2000" in info.stdout and "intensity" in info.stdout
    demo = command("demo", path, "--size", "120x120", "--output", tmp_path / "pictures")
    assert demo.returncode == 0 and "2000" in demo.stdout
    assert (tmp_path / "pictures" / "points.png").exists()


@pytest.mark.parametrize("name", ["info", "demo"])
def test_builds_without_pcl_name_the_option(tmp_path, name):
    path = tmp_path / "cloud.pcd"
    write(path, rows(10))
    fault = command(name, path, without_pcl=True)
    assert fault.returncode == 2
    assert fault.stderr.count("\n") == 1 and "POINTSURFACE_PCL" in fault.stderr and str(path) in fault.stderr
