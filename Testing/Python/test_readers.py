# SPDX-License-Identifier: BSD-3-Clause
"""Files of each format, written by VTK's writers or by hand, and files that are no such thing."""

import base64
import contextlib
import gzip
import json
import os
import struct
import sys
import types

import numpy as np
import pytest
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPolyData,
    vtkRectilinearGrid,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkNIFTIImageWriter, vtkTIFFWriter
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter, vtkStructuredPointsWriter, vtkTableWriter, vtkUnstructuredGridWriter
from vtkmodules.vtkIOParallelXML import vtkXMLPImageDataWriter, vtkXMLPPolyDataWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataWriter,
    vtkXMLMultiBlockDataWriter,
    vtkXMLPolyDataWriter,
    vtkXMLRectilinearGridWriter,
    vtkXMLUnstructuredGridWriter,
)

from pointsurface import scans
from pointsurface.readers import UnreadableFile, read

VOLUMES = ("vti", "pvti", "vtr", "vtk", "mhd", "mha", "nhdr", "nrrd", "nii", "nii.gz", "mrc")
MESHES = ("vtp", "pvtp", "vtk", "ply", "obj", "stl")


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


def write_mrc(path, volume):
    """VTK writes no MRC: a header of 1024 bytes, in which lengths are told for the whole, and the values."""
    header = bytearray(1024)
    struct.pack_into("<4i", header, 0, 12, 3, 2, 1)  # samples along each axis; 1: values of 16 bits
    struct.pack_into("<3i3f3f3i", header, 28, 12, 3, 2, 12, 6, 6, 90, 90, 90, 1, 2, 3)
    header[208:214] = b"MAP DD"
    with open(path, "wb") as file:
        file.write(bytes(header) + vtk_to_numpy(volume.GetPointData().GetScalars()).tobytes())


def rectilinear(volume, *coordinates):
    grid = vtkRectilinearGrid()
    grid.SetDimensions(volume.GetDimensions())
    for axis, values in zip("XYZ", coordinates):
        getattr(grid, f"Set{axis}Coordinates")(numpy_to_vtk(np.array(values, float), deep=True))
    grid.GetPointData().ShallowCopy(volume.GetPointData())
    return grid


def write(path, data):
    extension = path.rsplit(".", 1)[1]
    by_hand = {"nrrd": write_nrrd, "nhdr": write_nrrd, "mrc": write_mrc}
    if extension in by_hand:
        by_hand[extension](path, data)
        return
    if extension == "vtr":
        data = rectilinear(data, range(12), (0, 2, 4), (0, 3))
    is_volume = data.IsA("vtkImageData")
    writers = {
        "vti": vtkXMLImageDataWriter,
        "pvti": vtkXMLPImageDataWriter,
        "vtr": vtkXMLRectilinearGridWriter,
        "vtk": vtkStructuredPointsWriter if is_volume else vtkPolyDataWriter,
        "mhd": vtkMetaImageWriter,
        "mha": vtkMetaImageWriter,
        "nii": vtkNIFTIImageWriter,
        "gz": vtkNIFTIImageWriter,
        "tif": vtkTIFFWriter,
        "vtp": vtkXMLPolyDataWriter,
        "pvtp": vtkXMLPPolyDataWriter,
        "ply": vtkPLYWriter,
        "obj": vtkOBJWriter,
        "stl": vtkSTLWriter,
        "vtu": vtkXMLUnstructuredGridWriter,
        "vtm": vtkXMLMultiBlockDataWriter,
    }
    writer = writers[extension]()
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
    if extension in ("vtp", "pvtp", "vtk", "obj"):  # what VTK's writers keep
        normals = vtk_to_numpy(mesh.GetPointData().GetNormals())
        assert np.allclose(normals, points / 2, atol=1e-5)


def tetrahedron():
    grid = vtkUnstructuredGrid()
    grid.SetPoints(vtkPoints())
    for point in np.eye(4)[:, :3]:
        grid.GetPoints().InsertNextPoint(point)
    heights = numpy_to_vtk(np.arange(4.0), deep=True)
    heights.SetName("height")
    grid.GetPointData().AddArray(heights)
    return grid


@pytest.mark.parametrize("name", ["grid.vtu", "grid.vtk"])
def test_points_of_grids(tmp_path, name):
    path = str(tmp_path / name)
    if name.endswith("vtk"):
        writer = vtkUnstructuredGridWriter()
        writer.SetInputData(tetrahedron())
        writer.SetFileName(path)
        writer.Write()
    else:
        write(path, tetrahedron())
    cloud = read(path)
    assert cloud.IsA("vtkPolyData")
    assert np.array_equal(vtk_to_numpy(cloud.GetPoints().GetData()), np.eye(4)[:, :3])
    assert vtk_to_numpy(cloud.GetPointData().GetArray("height")).tolist() == [0, 1, 2, 3]


def test_blocks_are_one_cloud(tmp_path):
    tree, branch = vtkMultiBlockDataSet(), vtkMultiBlockDataSet()
    tree.SetBlock(0, tetrahedron())
    branch.SetBlock(1, sphere())
    branch.SetBlock(2, vtkPolyData())
    tree.SetBlock(3, branch)
    path = str(tmp_path / "tree.vtm")
    write(path, tree)
    cloud = read(path)
    assert cloud.GetNumberOfPoints() == 4 + 50 and cloud.GetNumberOfPolys() == 96
    bare = vtkMultiBlockDataSet()
    bare.SetBlock(0, ramp())
    write(path, bare)
    check_fault(path, "no points")


def test_slices_of_tiff(tmp_path):
    volume = vtkImageData()
    volume.SetDimensions(12, 3, 2)
    volume.GetPointData().SetScalars(numpy_to_vtk(np.arange(72, dtype=np.uint8), deep=True))
    path = str(tmp_path / "slices.tif")
    write(path, volume)
    found = read(path)
    assert found.GetDimensions() == (12, 3, 2)
    assert vtk_to_numpy(found.GetPointData().GetScalars()).tolist() == list(range(72))


def test_gltf(tmp_path):
    content = base64.b64encode(np.eye(3, dtype=np.float32).tobytes()).decode()
    scene = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": [5, 0, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0] * 3, "max": [1] * 3}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": f"data:application/octet-stream;base64,{content}"}],
    }
    path = tmp_path / "points.gltf"
    path.write_text(json.dumps(scene))
    points = vtk_to_numpy(read(str(path)).GetPoints().GetData())
    assert np.array_equal(points, np.eye(3) + (5, 0, 0))


def test_pts(tmp_path):
    path = tmp_path / "points.pts"
    path.write_text("2\n1 2 3 -9.5 255 128 0\n4 5 6 7 0 0 1\n")
    cloud = read(str(path))
    assert vtk_to_numpy(cloud.GetPoints().GetData()).tolist() == [[1, 2, 3], [4, 5, 6]]
    assert vtk_to_numpy(cloud.GetPointData().GetScalars()).tolist() == [[255, 128, 0], [0, 0, 1]]
    assert vtk_to_numpy(cloud.GetPointData().GetArray("intensity")).tolist() == [-9.5, 7]
    path.write_text("1\n1 2 3\n")
    assert read(str(path)).GetPointData().GetNumberOfArrays() == 0
    path.write_text("3\n1 2 3\n4 5 6\n")
    check_fault(path, "cut short", "'3'")


UTM = np.array([[500000.125, 5400000.5, 100], [500001.25, 5400002.75, 101], [500003, 5400004, 102]])


@pytest.mark.parametrize("extension", ["las", "laz"])
def test_las(tmp_path, extension):
    laspy = pytest.importorskip("laspy", reason="laspy is not installed")
    header = laspy.LasHeader(point_format=3, version="1.2")
    header.offsets, header.scales = UTM.min(axis=0), [0.001] * 3
    las = laspy.LasData(header)
    las.x, las.y, las.z = UTM.T
    las.red, las.green, las.blue = np.array([[65535, 0, 0], [0, 32768, 0], [0, 0, 256]]).T
    las.intensity, las.classification = np.array([7, 8, 9]), np.array([2, 5, 6])
    path = tmp_path / f"scan.{extension}"
    las.write(str(path))
    cloud = read(str(path))
    assert np.abs(vtk_to_numpy(cloud.GetPoints().GetData()) - UTM).max() < 1e-6
    data = cloud.GetPointData()
    assert vtk_to_numpy(data.GetScalars()).tolist() == [[255, 0, 0], [0, 128, 0], [0, 0, 1]]
    assert vtk_to_numpy(data.GetArray("intensity")).tolist() == [7, 8, 9]
    assert vtk_to_numpy(data.GetArray("classification")).tolist() == [2, 5, 6]
    for count in (path.stat().st_size - 20, 100, 5):
        path.write_bytes(path.read_bytes()[:count])
        check_fault(path, "cannot be read")


def test_e57(tmp_path):
    pye57 = pytest.importorskip("pye57", reason="pye57 is not installed")
    path = tmp_path / "scans.e57"
    file = pye57.E57(str(path), mode="w")
    near = UTM - UTM[0]  # pye57 writes single precision
    scan = dict(zip(("cartesianX", "cartesianY", "cartesianZ"), near.T.copy()))
    colors = dict(zip(("colorRed", "colorGreen", "colorBlue"), np.diag([255, 128, 1]).astype(np.uint8)))
    file.write_scan_raw({**scan, **colors})
    file.write_scan_raw({**scan, **colors}, rotation=np.array([1.0, 0, 0, 0]), translation=UTM[0])
    file.close()
    cloud = read(str(path))
    expected = np.concatenate([near, UTM])
    assert np.abs(vtk_to_numpy(cloud.GetPoints().GetData()) - expected).max() < 1e-6
    found = vtk_to_numpy(cloud.GetPointData().GetScalars())
    assert np.array_equal(found, np.tile(np.diag([255, 128, 1]), (2, 1)))
    path.write_bytes(path.read_bytes()[:3000])
    check_fault(path, "cannot be read")


@pytest.mark.parametrize("name, package", [("a.las", "laspy"), ("a.laz", "laspy"), ("a.e57", "pye57")])
def test_missing_package_is_named(tmp_path, monkeypatch, name, package):
    monkeypatch.setitem(sys.modules, package, None)
    (tmp_path / name).write_bytes(b"whatever")
    check_fault(tmp_path / name, f"needs the package {package}: pip install")


def stub_of_laspy(monkeypatch, told, decompresses=True, colors=None):
    """A package that tells of `told` points in a file, and reads three, in two steps; with colours, if they are given."""

    class Chunk(dict):
        def __len__(self):
            return len(self["x"])

    columns = {**dict(zip("xyz", UTM.T)), "intensity": np.array([7, 8, 9])}
    columns.update(zip(("red", "green", "blue"), [] if colors is None else np.transpose(colors)))
    chunks = [Chunk({name: values[part] for name, values in columns.items()}) for part in (slice(2), slice(2, 3))]
    point_format = types.SimpleNamespace(dimension_names=[name for name in columns if name not in "xyz"])
    header = types.SimpleNamespace(point_count=told, point_format=point_format)
    file = types.SimpleNamespace(header=header, chunk_iterator=lambda _: chunks)
    backend = types.SimpleNamespace(is_available=lambda: decompresses)
    laspy = types.SimpleNamespace(open=lambda _: contextlib.nullcontext(file), LazBackend=[backend])
    monkeypatch.setitem(sys.modules, "laspy", laspy)


def test_las_by_a_stub(tmp_path, monkeypatch):
    path = tmp_path / "scan.laz"
    path.write_bytes(b"")
    stub_of_laspy(monkeypatch, 3)
    shares = []
    cloud = scans.read_las(str(path), shares.append)
    assert np.array_equal(vtk_to_numpy(cloud.GetPoints().GetData()), UTM)
    assert vtk_to_numpy(cloud.GetPointData().GetArray("intensity")).tolist() == [7, 8, 9]
    assert cloud.GetPointData().GetScalars() is None
    assert shares == [pytest.approx(2 / 3), 1]
    bright = np.array([[65535, 0, 0], [0, 32768, 0], [0, 0, 256]], np.uint16)
    for colors in (bright, bright >> 8):  # of 16 bits, or of 8 as some write them
        stub_of_laspy(monkeypatch, 3, colors=colors)
        found = vtk_to_numpy(read(str(path)).GetPointData().GetScalars())
        assert found.tolist() == [[255, 0, 0], [0, 128, 0], [0, 0, 1]]
    stub_of_laspy(monkeypatch, 4)
    check_fault(path, "tells of 4 points, and 3 are there")
    stub_of_laspy(monkeypatch, 3, decompresses=False)
    check_fault(path, "compressed", "laspy[lazrs]")


def test_e57_by_a_stub(tmp_path, monkeypatch):
    path = tmp_path / "scan.e57"
    path.write_bytes(b"")
    scan = dict(zip(("cartesianX", "cartesianY", "cartesianZ"), UTM.T))
    parts = [{**scan, "intensity": np.ones(3)}, scan]  # what not all of them have is left out
    file = types.SimpleNamespace(scan_count=2, read_scan=lambda i, **_: parts[i], close=lambda: None)
    monkeypatch.setitem(sys.modules, "pye57", types.SimpleNamespace(E57=lambda _: file))
    cloud = read(str(path))
    assert np.array_equal(vtk_to_numpy(cloud.GetPoints().GetData()), np.tile(UTM, (2, 1)))
    assert cloud.GetPointData().GetNumberOfArrays() == 0
    file.scan_count = 0
    check_fault(path, "no points")


def test_volume_of_uneven_spacing(tmp_path):
    path = str(tmp_path / "uneven.vtr")
    writer = vtkXMLRectilinearGridWriter()
    writer.SetInputData(rectilinear(ramp(), range(12), (0, 2, 5), (0, 3)))
    writer.SetFileName(path)
    writer.Write()
    check_fault(path, "unevenly spaced along y", "vtkResampleToImage")


def test_table_is_neither_points_nor_volume(tmp_path):
    from vtkmodules.vtkCommonDataModel import vtkTable

    path = str(tmp_path / "table.vtk")
    writer = vtkTableWriter()
    writer.SetInputData(vtkTable())
    writer.SetFileName(path)
    writer.Write()
    check_fault(path, "neither points nor a volume")


@pytest.mark.parametrize("header", [b"", b"\0" * 1024, struct.pack("<4i", 12, 3, 2, 4) + b"\0" * 1100])
def test_mrc_headers_that_make_no_sense(tmp_path, header):
    path = tmp_path / "volume.mrc"
    path.write_bytes(header)
    check_fault(path, "header makes no sense")


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
@pytest.mark.parametrize("extension", (*dict.fromkeys(VOLUMES + MESHES), "tif", "gltf", "glb", "vtu", "vtm", "xyz", "pts"))
def test_broken_files(tmp_path, extension, content, capfd):
    path = tmp_path / f"broken.{extension}"
    path.write_bytes(gzip.compress(content) if extension == "nii.gz" else content)
    check_fault(path)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("extension", ["vti", "vtr", "nii", "nrrd", "mha", "mrc", "tif", "vtp", "vtk", "ply", "stl"])
def test_files_cut_short(tmp_path, extension):
    path = tmp_path / f"short.{extension}"
    volume = ramp()
    if extension == "tif":  # takes no signed values
        volume.GetPointData().SetScalars(numpy_to_vtk(np.arange(72, dtype=np.uint8), deep=True))
    write(str(path), sphere() if extension in MESHES else volume)
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
