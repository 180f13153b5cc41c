# SPDX-License-Identifier: BSD-3-Clause
"""Files of each format, written by VTK's writers or by hand, and files that are no such thing."""

import gzip
import os

import numpy as np
import pytest
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkNIFTIImageWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLPolyDataWriter

from pointsurface.readers import UnreadableFile, read

VOLUMES = ("vti", "mhd", "mha", "nhdr", "nrrd", "nii", "nii.gz")
MESHES = ("vtp", "ply", "obj", "stl")


def ramp():
    """12 x 3 x 2 samples, spaced by 1, 2 and 3, with the values 0 to 71."""
    volume = vtkImageData()
    volume.SetDimensions(12, 3, 2)
    volume.SetSpacing(1, 2, 3)
    scalars = numpy_to_vtk(np.arange(72, dtype=np.int16), deep=True)
    scalars.SetName("values")
    volume.GetPointData().SetScalars(scalars)
    return volume


def sphere():
    source = vtkSphereSource()
    source.SetRadius(2)
    source.Update()
    return source.GetOutput()


def write_nrrd(path, volume):
    """VTK writes no NRRD: a header, and the values behind it (nrrd) or in a file beside it (nhdr)."""
    header = "NRRD0004\ntype: short\ndimension: 3\nsizes: 12 3 2\nspacings: 1 2 3\nendian: little\nencoding: raw\n"
    values = vtk_to_numpy(volume.GetPointData().GetScalars()).tobytes()
    if path.endswith(".nhdr"):
        with open(path[:-5] + ".raw", "wb") as file:
            file.write(values)
        header += f"data file: {os.path.basename(path)[:-5]}.raw\n"
        values = b""
    with open(path, "wb") as file:
        file.write(header.encode() + b"\n" + values)


def write(path, data):
    if path.endswith(("nrrd", "nhdr")):
        write_nrrd(path, data)
        return
    writers = {
        "vti": vtkXMLImageDataWriter,
        "mhd": vtkMetaImageWriter,
        "mha": vtkMetaImageWriter,
        "nii": vtkNIFTIImageWriter,
        "gz": vtkNIFTIImageWriter,
        "vtp": vtkXMLPolyDataWriter,
        "ply": vtkPLYWriter,
        "obj": vtkOBJWriter,
        "stl": vtkSTLWriter,
    }
    writer = writers[path.rsplit(".", 1)[1]]()
    writer.SetInputData(data)
    writer.SetFileName(path)
    writer.Write()


@pytest.mark.parametrize("extension", VOLUMES)
def test_volumes(tmp_path, extension):
    path = str(tmp_path / f"ramp.{extension}")
    write(path, ramp())
    volume = read(path)
    assert volume.IsA("vtkImageData")
    assert volume.GetDimensions() == (12, 3, 2)
    assert volume.GetSpacing() == pytest.approx((1, 2, 3))
    assert vtk_to_numpy(volume.GetPointData().GetScalars()).tolist() == list(range(72))


@pytest.mark.parametrize("extension", MESHES)
def test_meshes(tmp_path, extension):
    path = str(tmp_path / f"Sphere.{extension.upper()}")
    lower = str(tmp_path / f"sphere.{extension}")
    write(lower, sphere())
    os.rename(lower, path)
    mesh = read(path)
    assert mesh.IsA("vtkPolyData")
    assert mesh.GetNumberOfPoints() == 50  # one a vertex, in STL as well, where each triangle has its own
    assert mesh.GetNumberOfPolys() == 96
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    assert np.linalg.norm(points, axis=1) == pytest.approx(np.full(50, 2.0), rel=1e-5)
    if extension in ("vtp", "obj"):  # what VTK's writers keep
        normals = vtk_to_numpy(mesh.GetPointData().GetNormals())
        assert np.allclose(normals, points / 2, atol=1e-5)


def test_ply_with_normals_and_colors(tmp_path):
    path = tmp_path / "points.ply"
    names = ("float x", "float y", "float z", "float nx", "float ny", "float nz", "uchar red", "uchar green", "uchar blue")
    properties = "".join(f"property {name}\n" for name in names)
    path.write_text(
        f"ply\nformat ascii 1.0\nelement vertex 2\n{properties}end_header\n1 2 3 0 0 1 9 8 7\n4 5 6 0 1 0 6 5 4\n"
    )
    cloud = read(str(path))
    assert vtk_to_numpy(cloud.GetPoints().GetData()).tolist() == [[1, 2, 3], [4, 5, 6]]
    assert vtk_to_numpy(cloud.GetPointData().GetNormals()).tolist() == [[0, 0, 1], [0, 1, 0]]
    assert vtk_to_numpy(cloud.GetPointData().GetScalars()).tolist() == [[9, 8, 7], [6, 5, 4]]


@pytest.mark.parametrize("header", [b"element vertex x\n", b"element vertex 2\nproperty\n", b"element\n"])
def test_ply_headers_that_make_no_sense(tmp_path, header):
    path = tmp_path / "points.ply"
    path.write_bytes(b"ply\nformat binary_little_endian 1.0\n" + header + b"end_header\n")
    check_fault(path, "header")


@pytest.mark.parametrize("separator", [" ", "\t", ",", ", "])
def test_xyz(tmp_path, separator):
    path = tmp_path / "points.xyz"
    rows = ["# a comment", "1 2 3", "", "-4.5 5e1 6 // the last one"]
    path.write_text("\n".join(row if "#" in row else row.replace(" ", separator, 2) for row in rows))
    cloud = read(str(path))
    assert vtk_to_numpy(cloud.GetPoints().GetData()).tolist() == [[1, 2, 3], [-4.5, 50, 6]]
    assert cloud.GetPointData().GetNormals() is None and cloud.GetPointData().GetScalars() is None


def test_xyz_with_normals_or_colors(tmp_path):
    path = tmp_path / "points.xyz"
    path.write_text("0 0 0 0 0 -1\n1 1 1 0.6 0 0.8\n")
    cloud = read(str(path))
    assert np.allclose(vtk_to_numpy(cloud.GetPointData().GetNormals()), [[0, 0, -1], [0.6, 0, 0.8]])
    path.write_text("0 0 0 0 0 1\n1 1 1 255 128 0\n")
    cloud = read(str(path))
    assert vtk_to_numpy(cloud.GetPointData().GetScalars()).tolist() == [[0, 0, 1], [255, 128, 0]]
    assert cloud.GetPointData().GetNormals() is None


def check_fault(path, *words):
    with pytest.raises(UnreadableFile) as fault:
        read(str(path))
    text = str(fault.value)
    assert "\n" not in text and str(path) in text
    for word in words:
        assert word in text


def test_wrong_paths(tmp_path):
    check_fault(tmp_path / "absent.vti", "does not exist")
    check_fault(tmp_path, "is a folder")
    (tmp_path / "model.fbx").write_text("x")
    check_fault(tmp_path / "model.fbx", "unknown extension", "vti", "nii.gz", "xyz")


@pytest.mark.parametrize("content", [b"", b"\x00\xff\x13 no such thing \n" * 50], ids=["empty", "garbage"])
@pytest.mark.parametrize("extension", (*VOLUMES, *MESHES, "xyz"))
def test_broken_files(tmp_path, extension, content, capfd):
    path = tmp_path / f"broken.{extension}"
    path.write_bytes(gzip.compress(content) if extension == "nii.gz" else content)
    check_fault(path)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("extension", ["vti", "nii", "nrrd", "mha", "vtp", "ply", "stl"])
def test_files_cut_short(tmp_path, extension):
    path = tmp_path / f"short.{extension}"
    write(str(path), ramp() if extension in VOLUMES else sphere())
    content = path.read_bytes()
    path.write_bytes(content[: int(len(content) * 0.9)])
    check_fault(path)


def test_volumes_that_are_none(tmp_path):
    flat = vtkImageData()
    flat.SetDimensions(4, 3, 1)
    flat.AllocateScalars(10, 1)
    write(str(tmp_path / "flat.vti"), flat)
    check_fault(tmp_path / "flat.vti", "4 x 3 x 1", "at least 2")

    colored = vtkImageData()
    colored.SetDimensions(4, 3, 2)
    colored.AllocateScalars(3, 3)
    write(str(tmp_path / "colored.vti"), colored)
    check_fault(tmp_path / "colored.vti", "3 components")

    bare = vtkImageData()
    bare.SetDimensions(4, 3, 2)
    write(str(tmp_path / "bare.vti"), bare)
    check_fault(tmp_path / "bare.vti", "no volume with values")


def test_points_that_are_none(tmp_path):
    write(str(tmp_path / "empty.vtp"), vtkPolyData())
    check_fault(tmp_path / "empty.vtp", "oints")
    (tmp_path / "empty.obj").write_text("# nothing\n")
    check_fault(tmp_path / "empty.obj")


def test_xyz_faults(tmp_path):
    path = tmp_path / "points.xyz"
    path.write_text("1 2 3\n4 five 6\n")
    check_fault(path, "five")
    path.write_text("1 2 3\n4 5 6 7\n")
    check_fault(path, "columns")
    path.write_text("1 2 3 4\n")
    check_fault(path, "4 columns")
    path.write_text("# nothing\n")
    check_fault(path, "no points")
    path.write_text("nan 0 0\n0 inf 0\n")
    check_fault(path, "no points with finite coordinates")
    path.write_text("nan 0 0\n0 1 0\n")
    assert read(str(path)).GetNumberOfPoints() == 2


def test_radius_is_no_color(tmp_path):
    cloud = sphere()
    radii = numpy_to_vtk(np.full(cloud.GetNumberOfPoints(), 0.1, dtype=np.float32), deep=True)
    radii.SetName("radius")
    cloud.GetPointData().SetScalars(radii)
    path = str(tmp_path / "cloud.vtp")
    write(path, cloud)
    data = read(path).GetPointData()
    assert data.GetScalars() is None
    assert data.GetArray("radius").GetRange() == pytest.approx((0.1, 0.1))
