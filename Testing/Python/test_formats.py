# SPDX-License-Identifier: BSD-3-Clause
"""A small file of each format that VTK alone reads, made by VTK's writers or by hand: four points, or a volume.

The formats that most people use are in test_readers.py, with more cases.
"""

import base64
import json
import mmap
import struct
import subprocess
import sys
import zlib

import numpy as np
import pytest
import small_files
from small_files import BOX, CORNERS, FACES, VALUES, rows, unpack
from test_readers import check_fault, ramp, tetrahedron
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import (
    VTK_TETRA,
    vtkAMRBox,
    vtkCellArray,
    vtkHyperTreeGrid,
    vtkHyperTreeGridNonOrientedCursor,
    vtkOverlappingAMR,
    vtkPartitionedDataSet,
    vtkPartitionedDataSetCollection,
    vtkPolyData,
    vtkUniformGrid,
)
from vtkmodules.vtkIOExodus import vtkExodusIIWriter
from vtkmodules.vtkIOGeometry import vtkBYUWriter
from vtkmodules.vtkIOMINC import vtkMINCImageWriter, vtkMNIObjectWriter, vtkMNITagPointWriter
from vtkmodules.vtkIOParallel import vtkPDataSetWriter
from vtkmodules.vtkIOParallelXML import vtkXMLPartitionedDataSetCollectionWriter, vtkXMLPartitionedDataSetWriter
from vtkmodules.vtkIOXML import vtkXMLHyperTreeGridWriter, vtkXMLUniformGridAMRWriter

from pointsurface import formats, readers, subjects
from pointsurface.errors import UnreadableFile
from pointsurface.formats import BY_CONTENT, FORMATS, NOT_READ
from pointsurface.readers import read


def cell():
    grid = tetrahedron()
    grid.InsertNextCell(VTK_TETRA, 4, (0, 1, 2, 3))
    return grid


def triangles():
    mesh, polygons = vtkPolyData(), vtkCellArray()
    mesh.SetPoints(cell().GetPoints())
    for face in FACES:
        polygons.InsertNextCell(3, face)
    mesh.SetPolys(polygons)
    return mesh


def write(path, writer, data):
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    writer.Write()


# Volumes.


def write_dicom(path):
    """Two slices, the upper one first, in a folder of their own."""

    def element(group, number, kind, value):
        value = value.encode() if isinstance(value, str) else value
        value += (b"\0" if kind == "UI" else b" ") * (len(value) % 2)
        length = struct.pack("<HI", 0, len(value)) if kind == "OW" else struct.pack("<H", len(value))
        return struct.pack("<HH2s", group, number, kind.encode()) + length + value

    path.mkdir()
    for k in range(2):
        meta = element(2, 0x10, "UI", "1.2.840.10008.1.2.1")
        parts = [
            (8, 0x18, "UI", f"1.2.3.{k}"),
            (0x18, 0x50, "DS", "3"),
            (0x20, 0xE, "UI", "1.2.4"),
            (0x20, 0x13, "IS", str(k + 1)),
            (0x20, 0x32, "DS", f"0\\0\\{3 * k}"),
            (0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0"),
            (0x28, 2, "US", struct.pack("<H", 1)),
            (0x28, 4, "CS", "MONOCHROME2"),
            (0x28, 0x10, "US", struct.pack("<H", 3)),
            (0x28, 0x11, "US", struct.pack("<H", 12)),
            (0x28, 0x30, "DS", "2\\2"),
            (0x28, 0x100, "US", struct.pack("<H", 16)),
            (0x28, 0x101, "US", struct.pack("<H", 16)),
            (0x28, 0x102, "US", struct.pack("<H", 15)),
            (0x28, 0x103, "US", struct.pack("<H", 0)),
            (0x7FE0, 0x10, "OW", VALUES[k].astype("<u2").tobytes()),
        ]
        head = b"\0" * 128 + b"DICM" + element(2, 0, "UL", struct.pack("<I", len(meta))) + meta
        (path / f"{2 - k}.dcm").write_bytes(head + b"".join(element(*part) for part in parts))


def write_netcdf(path):
    steps = {"z": np.array([0, 3], ">f8"), "y": np.array([0, 2, 4], ">f8"), "x": np.arange(12, dtype=">f8")}
    variables = {name: ((i,), values, {}) for i, (name, values) in enumerate(steps.items())}
    variables["values"] = ((0, 1, 2), VALUES.astype(">f4"), {})
    small_files.write_netcdf(path, {"z": 2, "y": 3, "x": 12}, variables)


def write_slc(path):
    head = b"11111\n12 3 2 8\n1 2 3\n1 0 0 0\n1 1 X\0\0\0"  # with an icon of one pixel
    path.write_bytes(head + VALUES.astype(np.uint8).tobytes())


# An image in VTKHDF, version 1.0, which VTK 9.1 cannot write.
VTKHDF = """
eNrtWMtu00AUPePUqZM4bUqBQnmlPMv7Fd6PpJCUICRakahkiRVZqaWQRElA8Adl1yVLliz5BJZ8Rj+BZXdhbN9p7GnToIDogjlejK59Z+5o7vE91/5UzC
8m47NxuDAMjCGFIHqE3KGwLZ6/oZHRuEbjV03cZ94zmo4pWl/2K78qFFzvngQRZ0P3RwMK/yOKhYVld6yQLVj6Qwv7rZRfcEb3+Vj8w7iMMy7I3xRFnh/3
7dZv8rdiKv4q/vb5K/i0pof9lptOo5u3upZUV3Mjxi29XMozj8U+0pHwukWyV3WVo90gdEs+L5MqjHvCJs/qit3uOM0GUoZ41/3MMeafuChXmpRfARPX6L
7O5xsof2zZrj3NHWMB/+dvrZod4ImJFs0zvX28Xm3W7cKHrt3o+nVrwH6iND8q7SMh2dq2uijiVsgex34ed6nt1JwGP690diteJoFMT/CO4pK5NQ5Cf33D
W7/UsqpOozbi+j+z4dfJyJlYp/Xj3vp5p21Xu24GKe9D4sTIL7ZznAEY/pzxne+kO5szYV0bpjvfJpTuKN3Z3jfBDPu9t+rv7M7f65tk3fkcC9eN72RvJF
SOdu8/df/MmLDv+mMkrCcRKa2D7kc4AxjpgRZghE59rqZpzK8XfuWJsM1Jf+a6tLPWnpyHzKsvScWRUZmlcTaM8cxHuXYbXMHiXPVNJDGBSc6KKezDNNfE
AziIGc6Gw5jFERzFMRzHCaQxh5M4hdM4g7M4h3mcxwVcxCVcxhVc5V3MddzATWRwC7dxh7P2Hu7jAR7iER4jy9V0AU/wFHkUsIhnKh0KCgoKCgr/8H+G3I
ebXMnF97Z7lapW3Wp3vP8P0UD/Lr4XfgEjmp41
"""

def write_cube(path):
    """Lengths in Bohr; z runs fastest."""
    values = " ".join(f"{value:.5e}" for value in VALUES.transpose().ravel())
    axes = "12 1 0 0\n3 0 2 0\n2 0 0 3\n"
    path.write_text(f"ramp\nvalues\n1 0 0 0\n{axes}6 6.0 1 2 3\n{values}\n")


VOLUMES = {
    "cube": write_cube,
    "dicom": write_dicom,
    "h": small_files.write_sep,
    "h5rage": small_files.write_h5rage,
    "mnc": lambda path: write(path, vtkMINCImageWriter(), ramp()),
    "nc": write_netcdf,
    "slc": write_slc,
    "vpc": small_files.write_vpic,
    "vtkhdf": lambda path: path.write_bytes(zlib.decompress(base64.b64decode(VTKHDF))),
}


@pytest.mark.parametrize("extension", VOLUMES)
def test_volumes(tmp_path, extension):
    path = tmp_path / f"ramp.{extension}"
    VOLUMES[extension](path)
    if extension != "dicom" and not has_reader(extension):
        pytest.skip(f"this VTK has no {FORMATS[extension].reader}")
    volume = read(str(path))
    assert volume.IsA("vtkImageData") and volume.GetDimensions() == (12, 3, 2)
    values = vtk_to_numpy(volume.GetPointData().GetScalars()).astype(int).reshape(2, 3, 12)
    if extension == "dicom":  # VTK turns a slice's rows upside down, and orders slices from the feet to the head
        assert volume.GetSpacing() == pytest.approx((2, 2, 3))
        assert np.array_equal(np.sort(values.ravel()), VALUES.ravel())
        assert np.all(np.diff(values, axis=2) == 1) and np.all(np.abs(np.diff(values, axis=1)) == 12)
    else:
        assert volume.GetSpacing() == pytest.approx((1, 2, 3))
        assert np.array_equal(values, VALUES)


def test_cubes_that_are_none(tmp_path):
    path = tmp_path / "orbitals.cube"
    write_cube(path)
    content = path.read_text()
    for old, new, words in (
        ("1 0 0 0", "-1 0 0 0", "several orbitals"),
        ("12 1 0 0", "12 1 0.5 0", "its axes are not along x, y and z"),
        ("12 1 0 0", "12 one 0 0", "'one'"),
        ("12 1 0 0", "120 1 0 0", "cut short"),
    ):
        path.write_text(content.replace(old, new, 1))
        check_fault(path, words)


# Volumes of levels: x + 10 y + 100 z at the centres of cells, of 4 x 4 x 4 cells of 1 from the origin on, and in the middle
# of these, where there is a second level, of as many of 0.5.


def linear(points):
    return points @ (1, 10, 100)


def block(level):
    """Where it begins, and its cells' size."""
    return level * 1.0, 0.5**level


def cell_values(level):
    begin, size = block(level)
    centers = begin + (np.arange(4) + 0.5) * size
    return linear(np.stack(np.meshgrid(centers, centers, centers, indexing="ij")[::-1], axis=-1))


def write_amr(path):
    levels = vtkOverlappingAMR()
    try:
        levels.Initialize([1, 1])
    except TypeError:  # before VTK 9.6
        levels.Initialize(2, [1, 1])
    levels.SetOrigin((0, 0, 0))
    levels.SetGridDescription(8)  # along x, y and z
    for level in range(2):
        begin, size = block(level)
        grid = vtkUniformGrid()
        grid.SetOrigin([begin] * 3)
        grid.SetDimensions(5, 5, 5)
        grid.SetSpacing([size] * 3)
        values = numpy_to_vtk(cell_values(level).ravel(), deep=True)
        values.SetName("v")
        grid.GetCellData().AddArray(values)
        levels.SetSpacing(level, [size] * 3)
        levels.SetAMRBox(level, 0, vtkAMRBox([begin] * 3, [5] * 3, [size] * 3, [0] * 3))
        levels.SetDataSet(level, 0, grid)
    levels.SetRefinementRatio(0, 2)
    write(path, vtkXMLUniformGridAMRWriter(), levels)


def write_amrex(path):
    """A folder: a header, and of each level a header and values."""
    path.mkdir()
    boxes = ["((0,0,0) (3,3,3) (0,0,0))", "((2,2,2) (5,5,5) (0,0,0))"]
    rows = ["HyperCLaw-V1.1", "1", "v", "3", "0", "1", "0 0 0", "4 4 4", "2", f"{boxes[0]} ((0,0,0) (7,7,7) (0,0,0))"]
    rows += ["0 0", "1 1 1", "0.5 0.5 0.5", "0", "0"]
    for level, box in enumerate(boxes):
        begin, size = block(level)
        rows += [f"{level} 1 0", "0", *[f"{begin} {begin + 4 * size}"] * 3, f"Level_{level}/Cell"]
        folder = path / f"Level_{level}"
        folder.mkdir()
        (folder / "Cell_H").write_text(f"1\n1\n1\n0\n(1 0\n{box}\n)\n1\nFabOnDisk: Cell_D 0\n\n1,1\n0,\n\n1,1\n999,\n")
        head = f"FAB ((8, (64 11 52 0 1 12 0 1023)),(8, (8 7 6 5 4 3 2 1))){box} 1\n"
        (folder / "Cell_D").write_bytes(head.encode() + cell_values(level).astype("<f8").tobytes())
    (path / "Header").write_text("\n".join(rows) + "\n")


def write_enzo(path):
    path.with_suffix("").write_text("InitialCycleNumber = 0\nInitialTime = 0\nTopGridRank = 3\n")
    path.with_suffix(".boundary").write_text("")
    unpack(ENZO, path.with_suffix(".grid"))
    text = ""
    for level in range(2):
        begin, size = block(level)
        text += (
            f"Grid = {level + 1}\nGridRank = 3\nGridDimension = 4 4 4\nGridStartIndex = 0 0 0\nGridEndIndex = 3 3 3\n"
            f"GridLeftEdge = {begin} {begin} {begin}\nGridRightEdge = {' '.join([str(begin + 4 * size)] * 3)}\nTime = 0\n"
            f"NumberOfBaryonFields = 1\nBaryonFileName = {path.stem}.grid\nNumberOfParticles = 0\n"
            f"Pointer: Grid[{level + 1}]->NextGridThisLevel = 0\n"
            f"Pointer: Grid[{level + 1}]->NextGridNextLevel = {2 - 2 * level}\n"
        )
    path.write_text(text)


# In HDF5: Enzo's groups of both levels; of one level, what Velodyne and Flash (version 2) write.
ENZO = """
eNrt1zts01AUgGE/YmFakBI1IAsxZGDwGFAHbwSpAUu8QgvIA0OBAK7EIxRUMnY0W0ePHT0wMDBkYOjA4JExY0aPHT0ghZjzu2oMiKgIVCk+y6dzfR+K78mV
73t35erphXMLShamqVSUqnI4xkR4djrPn6+jigFGWt6u/nhm0V5j/mK/u6vtdtZ7XIh8nZEhWkoZ8xhu+0on0yO3Mdam+13b3Og2JS4W8kuH67Q547q/q19X
l9w3ZqtfxxTNcivL+p1EfsoGxnS/rcJ56v7lumu3bq+oinZQdw29MH+hjvM6365N94vI46X53D9VMeRdqHnuiLo0VOg3q/rkTWcja43L7E1LWV5UlsfshzFp
zZ5rmqbKuSE7o6vbJ5micPL5//V9SF2pB3Vlnyj/40eOvestKYEb4h62borrHXEXR9i4Q75KvkZ/3M3ze+Q4wsZ9sfdY3MGP+DXPu+S4j9Un5Fh9Kjaxk+fP
yLGHO7j/SjR7ooU2hhjhAGN0XosueujjEBNM0dxk/Bbj0UMfh5hgiuY7sY8Bhhih1ef3oIMueg9ZD/sYYIrmI+ZDG0OMcIAxOuyjix76GLIPEQ4wRsdnPHro
4xATTNHc4PdggCFGOHzBeEzRfMl4DDDECC3qx0YHXRxgjENM8BR1UMfzeAEfYBef41v8gJ/wM37Bb1h5w3pYxzLKKGNOvyt/fb8sfm//6X7ZOVPeL8v75c/3
y2Tp394vj9G9aPE43ota9bI2jxLfAXNz/WM=
"""
VELODYNE = """
eNrtmD1QGkEUx3cPGC8IGZx8cDEpKFJQWqSgExN0biagBIxzpaecgQkEAkqwsySdpaUlZUpLS8uUlpaWlnbm7va/wB53gCSFE+/N3Pzu3e2+3Xv7dm/f/lQz
a9HwYphYIsskSGJkWO4g3Teizt9vgxTsgj2JP6f2OwXPF2DfWW6zsLpqlb5zCG/nKsQoE18eo6irK3mLGnQepReSWG4lVxDiUf3LdimJCvEbQ8vJOaYfBaaL
37N5P379+B3EL4+nbkgsVzD0Uk5vkKyht43WII7TM7ZbXN/IWCswj7tEQFyvVejlkD9G44T/t5z+ipAU/CmT5+ZVrNQ2KzWDLCSW4fM0eTdP3t05/M5lUP+J
eS+TnN7JGm2jyt/HTCNBNnJCfdqvr0KfN+8VYlf+UD/4tu9Rn1JXO3SkP0/t/qwf1HaM5sbeer1kheMU/clDD9v9eV+t737NVGotMr4/cE+fwaGL2dVgd870
s0IK9fq+ViTefvaw6yVu9jParPZvlp2MYAZTEhf8ulYxqqUtvVnRd6qWgyf7N93/L8lmP3nVbKVlj/gzysp6jXN7ZJxe2uMk9COj7+ubhw3jHvEjjdiNj9pd
aTb1Q2b4vnFJSYjdU64nGSXq2g+nHjDnL3X5npDpReu5JDFDMlbmgOVg1z/20YNYj9i6Lg126y/E705CV+PiV/TC/lo+LM548ZTzj2zipbOM52A6x7idZzwF
r8DEJ+gF6EWUB0+5/hk6eAUmthgbu4zH4C/wN9dL0MEbMGZAB2N7jEtgnutfoIMN8Bi8qTPKDUYFTIInYA88Ay/A1HdGFdTAMngJXoO3oNxE/TbqgxpYBi/B
a/AWlH8wdsAueAL2QKWD7wFToNpJ+7PEF1988eX/E2ruDN3Od86xb8qT6c53Eq/EvN6Xx32+kwDLcbEcT+61JTEf4/vP1IznEs79foQs9c8l7HzTTsRbE/PL
0TxLGZuf3T+vkqODDH9Yjh/kuLI8K9DPn2ITJjjPx8qL48txM53Xj2WdnS5/D4zEF6diP/M6j/GOt0jUfWXuPDB/4PwpJPoj6EHnPJxUbnb/vY06UmW+4v1T
f/wB5QEDLw==
"""
FLASH = """
eNrtmD9M20AUxu8c01q0FaYgmtION3RgYGBgyFCJVIIqUv+l0FaMJORCLBI7tR0wTB3pxsjImLEjI2NHxowZGTOyUdv3mSYudpMUqqTNk5Kf3927O9/zl4vv
vmaWXz4Ynx0nnikKkYlK2u0S1njS6Qf1GyAFD8C6FJRTvy6J8kn0H477sLqyQoh01X94nAVZMAWfocM0Gdn/YJmVF1lfbxBaHeXO7O2OS8mY0DYNfCE8SmmH
7gMmXH1716pCiJAs87/HiOKXS5LkhyroJ0HdS9/k0MiHA/kc1t6+W6bkztXdqY/i46tgazo+7ktwMRMfdwyWHsfHKcE6kYiPC9aT0LJ360bd5+0JISV1q6um
XzPjTmzepW3YuTLLl43Nbaub8dr1aGsVfp3iwjbJlpDHNFm8RxYv3Vx6bS2bB4+V3O+jD5MXrJJWtIOY6T760GuVPDeZUWTe3VjkaQ/z15182y+zyzZ7os2z
XtrsizZzPbSJXidkSHr+RnV4t01jP621RNr0J7d9Lv/ACly36LXjqeku/Qiq1/P0lWD6NXww/UZwIyt4DDZB9h7+Kvw1xIPHgf8RPtgE2SfB6qbgIfgNPAv8
AnywBaocPqgWBRfAbOBvwQer4CHYMgSVqmASnAOPwDp4An4HU58FM+A6WAIb4Dl4ASom2u+gPbgOlsAGeA5egMquoAMegEdgHUw6mA+YAjPO6LVwZCMb2ch6
3t+ItxUqdb6HToTeRyf63u8s4D3medQOYCjyEcUE5j1FRT6i81CO2PcdjEQ50Pv16lDt128/H/aQ50OcANAEDeVBmPRLfjrLE24eaMQeNT5vDvK2ELrD0kCu
d4mIPPQ//zrmnwzdkTMU6//N5+N0IPMhzvvkq3P+5lR8fBY8exgfF5y9OGPxccFGTp381/6XMoJyp67kCP6uvn/dNZTQkgZb/yt5KWplzoqGWcnZbIeblmbo
frmlVWrlnO26rJozcxVuu5Vu+ZZW8Otr+rZu7OpMd6u8cpMXNZ2zMt/hZa9eNwqc2XtVjnHyRk0vaPoWyxv+D2rTMEzXz9lcHJ/6J6nM0vbRwDuras/7yZDp
7QciTibN
"""

LEVELS = {
    "amrex": write_amrex,
    "flash": lambda path: unpack(FLASH, path),
    "hierarchy": write_enzo,
    "vth": write_amr,
    "xamr": lambda path: unpack(VELODYNE, path),
}


@pytest.mark.parametrize("extension", LEVELS)
def test_volumes_of_levels(tmp_path, extension):
    path = tmp_path / f"levels.{extension}"
    LEVELS[extension](path)
    if extension == "xamr" and vtkVersion.GetVTKVersion().startswith("9.1"):
        check_fault(path, "vtkAMRVelodyneReader says: nothing, and crashes")  # on any file
        return
    volume = read(str(path))
    fine = extension not in ("flash", "xamr")
    samples = 9 if fine else 5
    assert volume.IsA("vtkImageData") and volume.GetDimensions() == (samples,) * 3
    step = 4 / (samples - 1)
    assert volume.GetSpacing() == pytest.approx((step,) * 3, rel=1e-5)
    scalars = volume.GetPointData().GetScalars()
    assert scalars.GetName() == ("dens" if extension == "flash" else "v")
    found = vtk_to_numpy(scalars).reshape(samples, samples, samples)
    places = np.arange(samples) * step
    expected = linear(np.stack(np.meshgrid(places, places, places, indexing="ij")[::-1], axis=-1))
    inner = slice(3, 6) if fine else slice(1, 4)  # off the borders of a level, where means are of fewer cells
    assert np.allclose(found[inner, inner, inner], expected[inner, inner, inner], rtol=1e-4)
    assert np.abs(found - expected).max() <= 0.5 * 111 + 1  # half a cell off at the most, in each direction


OF_CONTENT = {
    ("amrex", "particles"): small_files.write_amrex_particles,
    ("flash", "particles"): lambda path: unpack(small_files.FLASH_PARTICLES, path),
    ("h5", "TRUCHAS"): lambda path: unpack(small_files.TRUCHAS, path),
    ("h5", "VERA"): lambda path: unpack(small_files.VERA, path),
    ("hierarchy", "particles"): small_files.write_enzo_particles,
    ("nc", "CAM"): small_files.write_cam,
    ("nc", "MPAS"): small_files.write_mpas,
    ("nc", "SLAC"): small_files.write_slac,
    ("nc", "SLAC particles"): small_files.write_slac_particles,
    ("nc", "UGRID"): small_files.write_ugrid,
    ("obj", "MNI"): lambda path: write(path, vtkMNIObjectWriter(), triangles()),
    ("out", "tessellation"): small_files.write_tessellation,
    ("xyz", "molecule"): small_files.write_molecule,
}
HEIGHTS = {"amrex": "height", "hierarchy": "particle_height"}  # and not of Flash, whose values VTK mixes up


def test_every_reader_that_the_content_tells_has_a_file():
    assert set(OF_CONTENT) == {(e, kind) for e, kinds in BY_CONTENT.items() for kind in kinds if e != "ncdf"}


def check_core(volume):
    """Vera's values are of cells: of pins that are 20 / 5 wide."""
    assert volume.GetDimensions() == (5, 5, 3)
    assert np.allclose(volume.GetOrigin() + volume.GetSpacing(), (2, 2, 1.5, 4, 4, 3))
    for name, factor in (("pin_volumes", 1), ("pin_powers", 10)):
        assert np.array_equal(vtk_to_numpy(volume.GetPointData().GetArray(name)), factor * np.arange(75))


@pytest.mark.parametrize("extension, kind", OF_CONTENT)
def test_formats_that_the_content_tells(tmp_path, extension, kind):
    """Their extension is that of another one. (Of AMReX it is a folder in that of the plotfile.)

    Before those of CGNS and Exodus: after them, VTK 9.1's readers of Flash and Enzo let HDF5 crash as the process ends.
    """
    form = BY_CONTENT[extension][kind]
    if not hasattr(pytest.importorskip(f"vtkmodules.{form.module}"), form.reader):
        pytest.skip(f"this VTK has no {form.reader}")
    path = tmp_path / ("particles" if extension == "amrex" else f"four.{extension}")
    OF_CONTENT[extension, kind](path)
    cloud = read(str(path))
    if kind == "VERA":
        check_core(cloud)
        return
    expected = CORNERS * (1, 1, 0) if kind in ("CAM", "UGRID") else CORNERS
    if kind == "CAM":
        expected = np.concatenate([expected + (0, 0, 1), expected])
    assert np.allclose(vtk_to_numpy(cloud.GetPoints().GetData()), expected)
    if extension in HEIGHTS or kind in ("MPAS", "TRUCHAS", "UGRID"):
        heights = cloud.GetPointData().GetArray(HEIGHTS.get(extension, "height"))
        assert vtk_to_numpy(heights).tolist() == [0, 1, 2, 3]


def test_names_are_looked_for_in_one_go(tmp_path, monkeypatch):
    """Wherever they are, where a window ends among these; the first of the kinds is taken."""
    monkeypatch.setattr(formats, "_WINDOW", 64)
    maps = []
    usual = mmap.mmap
    monkeypatch.setattr(mmap, "mmap", lambda *args, **options: maps.append(args) or usual(*args, **options))
    path = tmp_path / "names.nc"
    for start in range(200):
        path.write_bytes(b"\0" * start + b"cellsOnVertex" + b"\0" * (250 - start) + b"particlePos")
        maps.clear()
        wanted = [b"mesh_topology", b"cellsOnVertex", b"particlePos"]
        assert sorted(formats.names_in(path, wanted)) == wanted[1:]
        assert readers._kind_of_netcdf(path) == "SLAC particles"
        assert len(maps) == 2
    path.write_bytes(b"")
    assert list(formats.names_in(path, [b"particlePos"])) == []


def test_volumes_of_levels_are_not_sampled_without_end(tmp_path, monkeypatch):
    monkeypatch.setattr("pointsurface.readers._MOST_SAMPLES", 130)
    write_amr(tmp_path / "levels.vth")
    assert read(str(tmp_path / "levels.vth")).GetDimensions() == (5, 5, 5)


def test_plotfile_that_is_a_file(tmp_path):
    (tmp_path / "levels.amrex").write_text("HyperCLaw-V1.1\n")
    check_fault(tmp_path / "levels.amrex", "no plotfile of AMReX: that is a folder")


def test_slice_and_folder_without_slices(tmp_path):
    write_dicom(tmp_path / "slices")
    check_fault(tmp_path / "slices" / "1.dcm", "a slice of a volume", "the folder")
    check_fault(tmp_path, "is a folder without slices (.dcm)", "no plotfile of AMReX")
    assert "slices" in subjects.load(f"{tmp_path}/slices/", 35.5).title


# Points.


def write_byu(path):
    writer = vtkBYUWriter()
    writer.SetGeometryFileName(str(path))
    writer.SetInputData(triangles())
    writer.Write()


def write_fluent(path):
    faces = "".join("{:x} {:x} {:x} 1 0\n".format(*(i + 1 for i in face)) for face in FACES)
    path.write_text(
        '(0 "four")\n(2 3)\n(10 (0 1 4 0 3))\n(12 (0 1 1 0))\n(13 (0 1 4 0))\n'
        f"(10 (1 1 4 1 3)(\n{rows('{1} {2} {3}' + chr(10))}))\n(12 (2 1 1 1 2))\n(13 (3 1 4 3 3)(\n{faces}))\n"
        "(45 (2 fluid fluid)())\n(45 (3 wall wall)())\n"
    )
    path.with_suffix(".dat").write_text('(0 "four")\n')


def write_ensight(path):
    """By hand: what VTK's writer has written is not all there before its process ends."""
    geometry, heights = path.with_suffix(".geo"), path.with_suffix(".scl")
    part = f"part\n{1:10d}\n"
    path.write_text(
        f"FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: {geometry.name}\n"
        f"VARIABLE\nscalar per node: height {heights.name}\n"
    )
    coordinates = "".join(f"{x:12.5e}\n" for x in CORNERS.T.ravel())
    geometry.write_text(
        f"four\npoints\nnode id off\nelement id off\n{part}cell\ncoordinates\n{4:10d}\n{coordinates}tetra4\n{1:10d}\n"
        f"{1:10d}{2:10d}{3:10d}{4:10d}\n"
    )
    heights.write_text(f"height\n{part}coordinates\n" + "".join(f"{i:12.5e}\n" for i in range(4)))


def write_servers(path):
    write_ensight(path.with_suffix(".case"))
    server = f"#Server 1\nmachine id: here\nexecutable: ensight\ncasefile: {path.stem}.case\n"
    path.write_text(f"FORMAT\ntype: master_server gold\nSERVERS\nnumber of servers: 1\n{server}")


def write_foam(path):
    """A folder of files, beside an empty one of the name that is read."""

    def write_part(name, kind, body):
        part = path.parent / name
        part.parent.mkdir(parents=True, exist_ok=True)
        part.write_text(f"FoamFile\n{{\nversion 2.0;\nformat ascii;\nclass {kind};\nobject {part.name};\n}}\n{body}\n")

    write_part("system/controlDict", "dictionary", "startTime 0;\nendTime 0;\ndeltaT 1;\nwriteInterval 1;\n")
    mesh = "constant/polyMesh"
    write_part(f"{mesh}/points", "vectorField", "4\n(\n" + rows("({1} {2} {3})\n") + ")")
    write_part(f"{mesh}/faces", "faceList", "4\n(\n" + rows("3({1} {2} {3})\n", FACES) + ")")
    write_part(f"{mesh}/owner", "labelList", "4\n(\n0\n0\n0\n0\n)")
    write_part(f"{mesh}/neighbour", "labelList", "0\n(\n)")
    write_part(f"{mesh}/boundary", "polyBoundaryMesh", "1\n(\nwall\n{\ntype wall;\nnFaces 4;\nstartFace 0;\n}\n)")
    path.write_text("")


def write_gml(path):
    rings = "".join(
        "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>"
        + " ".join(f"{x:g}" for i in (*face, face[0]) for x in CORNERS[i])
        + "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>"
        for face in FACES
    )
    path.write_text(
        '<?xml version="1.0"?><CityModel xmlns="http://www.opengis.net/citygml/2.0" '
        'xmlns:bldg="http://www.opengis.net/citygml/building/2.0" xmlns:gml="http://www.opengis.net/gml">'
        f'<cityObjectMember><bldg:Building gml:id="b"><bldg:lod3MultiSurface><gml:MultiSurface>{rings}'
        "</gml:MultiSurface></bldg:lod3MultiSurface></bldg:Building></cityObjectMember></CityModel>"
    )


def write_gambit(path):
    path.write_text(
        "        CONTROL INFO 2.4.6\n** GAMBIT NEUTRAL FILE\nfour\nPROGRAM:  Gambit  VERSION:  2.4.6\n 1 Jan 2000 00:00:00\n"
        "     NUMNP     NELEM     NGRPS    NBSETS     NDFCD     NDFVL\n"
        "         4         1         1         0         3         3\nENDOFSECTION\n   NODAL COORDINATES 2.4.6\n"
        + rows("{:10d}{:20.11e}{:20.11e}{:20.11e}\n")
        + "ENDOFSECTION\n      ELEMENTS/CELLS 2.4.6\n       1  6  4        1       2       3       4\nENDOFSECTION\n"
        "       ELEMENT GROUP 2.4.6\nGROUP:          1 ELEMENTS:          1 MATERIAL:          2 NFLAGS:          1\n"
        "                           fluid\n       0\n       1\nENDOFSECTION\n"
    )


def write_plot3d(path):
    grid = path.with_suffix(".grid")
    grid.write_bytes(struct.pack("<3i", 2, 2, 2) + BOX.astype("<f4").tobytes())
    path.write_text(json.dumps({"auto-detect-format": True, "filenames": [{"time": 0.0, "xyz": grid.name}]}))


def write_prostar(path):
    path.write_text("PROSTAR_VERTEX\n4000 0 0 0 0 0 0 0\n" + rows("{} {} {} {}\n"))
    path.with_suffix(".cel").write_text("PROSTAR_CELL\n4000 0 0 0 0 0 0 0\n1 11 4 1 4\n1 1 2 3 4\n")


def write_segy(path):
    """Four traces of two samples, one above the other by a millisecond."""
    header = bytearray(400)
    for position, value in ((16, 1000), (20, 2), (24, 5)):  # microseconds, samples, values of 32-bit IEEE floats
        struct.pack_into(">h", header, position, value)
    content = b" " * 3200 + bytes(header)
    for x, y in ((0, 0), (3, 0), (0, 2), (3, 2)):
        trace = bytearray(240)
        for position, value in ((70, 1), (114, 2), (116, 1000)):
            struct.pack_into(">h", trace, position, value)
        struct.pack_into(">2i", trace, 72, x, y)
        content += bytes(trace) + struct.pack(">2f", 0, 1)
    path.write_bytes(content)


def write_3ds(path):
    def chunk(kind, content):
        return struct.pack("<HI", kind, 6 + len(content)) + content

    corners = chunk(0x4110, struct.pack("<H", 4) + CORNERS.astype("<f4").tobytes())
    faces = chunk(0x4120, struct.pack("<H", 4) + b"".join(struct.pack("<4H", *face, 0) for face in FACES))
    path.write_bytes(chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, b"four\0" + chunk(0x4100, corners + faces)))))


def write_vrml(path):
    """Moved by the scene: the corners are five to the left."""
    points = ", ".join(f"{x - 5:g} {y:g} {z:g}" for x, y, z in CORNERS)
    faces = " ".join(f"{a} {b} {c} -1" for a, b, c in FACES)
    path.write_text(
        "#VRML V2.0 utf8\nTransform { translation 5 0 0 children [ Shape { geometry IndexedFaceSet {\n"
        f"coord Coordinate {{ point [ {points} ] }} coordIndex [ {faces} ] }} }} ] }}\n"
    )


def write_tri(path):
    """Triangles of corners with normals, big-endian."""
    corners = np.concatenate([CORNERS, np.zeros((4, 3))], axis=1).astype(">f4")
    path.write_bytes(b"".join(corners[list(face)].tobytes() for face in FACES))


def write_geojson(path):
    rings = [[CORNERS[i].tolist() for i in (*face, face[0])] for face in FACES]
    features = [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [r]}} for r in rings]
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))


def write_htg(path):
    """A tree of one cell: the box of the others."""
    tree = vtkHyperTreeGrid()
    tree.SetDimensions(2, 2, 2)
    for axis, end in zip("XYZ", (3.0, 2.0, 1.0)):
        getattr(tree, f"Set{axis}Coordinates")(numpy_to_vtk(np.array([0, end]), deep=True))
    tree.SetBranchFactor(2)
    cursor = vtkHyperTreeGridNonOrientedCursor()
    tree.InitializeNonOrientedCursor(cursor, 0, True)
    cursor.SetGlobalIndexStart(0)
    write(path, vtkXMLHyperTreeGridWriter(), tree)


def partitioned():
    data = vtkPartitionedDataSet()
    data.SetNumberOfPartitions(1)
    data.SetPartition(0, cell())
    return data


def collection():
    data = vtkPartitionedDataSetCollection()
    data.SetPartitionedDataSet(0, partitioned())
    return data


# A structured zone with the corners of BOX and "height", 0 to 7, at them: the nodes of the standard (SIDS) in HDF5.
CGNS = """
eNrr9HBx4+WS4mIAAQ4OBhYGAQZk8B8KFmqj8mHyCQz4gb+HSxATLycjkxKYy8yCZi464GJiYATJC4Cd0coEUe0FM44NYTKPI4hkZGBl4ADCvMTcVBBfGI
gVweIQAPSeqYJvfklGapFffkoqpgNBxjACIRvYmJzEpNQcLMYE5eeXKIAMUMhPUwCb6ZaZg2wajzIDAxPcNSWVBXDXMCMZ4xvCwOWzcQVIGSMDQpyRQQJC
M0IEFKHKYTQzMFJAMgIcMC0cYBJkGYjPxMTECBGFmMPMCFUANwEGJjAMRuDv7OEtKsMAShvMzDiTBiRJ3GeGBiVMMyxFMTxYKslA+5BVHHIhCwk3cVaISD
BGuLHJg0OIBZZIeRQyUtJMy1KLijPz885Dc6BQHNMWcF7meQDLyowkZeUsqP1Tyc7Kzu5+wT6ZSUWJRZVhEMeRlZUxjYkvQTHmrP+JdYhwC2eHiLpihpsq
JNygIcQghGmyDlTxkqvrAhFG8kON9MAWFESVI0EmDDw2ICGQZ3mAaTMtJzG9GJqOIXYqoKR7mEZk+qHf3EOE8gu6PmagPIgtqCAPt0ecg0G8HiqPO984ca
AFHxR0DNqSiAVnymaTgMQ8TBerQkpiSeJ/aApP5rP3ApnDJoWqil0hLb8oN7GkFBqYbOIQeWZYwnJKLE6FVb8lRW0BxDkGkqaChKGpG2YbNFWGy8pcxOdh
T1dX13gfz5AQH9d4YyMsCsCVHTQ5KxjqGRqgK0hLc3NghqbP4JKi0uSS0qLUFKCOktQKRqSkg+wwGGZEwrgBhwNlfDhwQKNJlUcDH+zx0+jqYObC3CcApU
WgtASUlnFgGAWjYBSMglEwCmjb4AH3z73h/XNmkhr1c9BassQ15MHtHHyA+IY8yCi05jupbWlParSlkZvwK/1eOhJqVzOhttJQ+qHIduJuT7tB29McQ6Mf
SknXcaowpV3HqPy81BBo/FOQ4mDG4ExxWZpq68FNf6wdhHBB1IY/LPJZQOY2iUI4ic5qFYiuopUopV1FZ0MqJO8t65WvEErSXFD1XGQPrfhxoJowdAatSO
0qaolA+06RLlvQS2DSRkhfikNUZ1KUN6hQGoOMwZkv6Fwaf9916TBmctWA0JBUx8AMT6a4aFJL5CJo8lVB83jDEEqukERlKwnR44c2mMAmjTpSyAErENOF
IAJtF2/+RyvqSWtQdEtSWtS7F2WmOOfnF6Vk5iWWpBaTm5zRjMFM2c3NdlMR5XQtNNLd0UNMCbWo50czN0gCqi5FNhZhGrc0WviTXOr7hlAhG+2xUF9MUc
UdKU3xmC88qCIoKZxcgGWuY1FRYiWuEurE953ciPA3lMMd/mxyqAU6N5ITFaQgYncz581HmPZPhuLhXgsqxOYPw5s8mIWiBYRmxt4sJUQjhoPtobW7A4MJ
N4PJf2ZCw8HTOLAPtWUMmTr8HTRxy8pOaqcol9TLUS+XRNI0lxxRcfiPNDOiSDiXMGLmkkg3WYiY16dz8gjTVBQGRS7JVt93evDkkmtDPpeIyEN479aUPK
EolyxVpF4uiaJpLqm1kJ5CZJDJobYOkHJJVA40P/DfL1+IyCVeyoMil9xlyHkyeHKJGOdQzyVWkCzBkB18zAgtlzCRlEuOqFCaS4Lzc0pLMOfWSc0lbjn5
5TCjsGYU+2dLVuIeKrkphtrjgPUiOGBmToJmhInaSW2I7OGiBo2LgW04z93a2ktRYTdZjRrdIJ/85EScUUl8NwhmDNZoFOvg3YoI/2xNaC8eW5NAHjWieZ
DNjlSFFgYHz81CGGehMShGv6aeWlNLaPSLDc2FpI9+RXBg+HGYjn5pqEN4XZM/r6Eom2zRpDSbZKRmpmeUUDz4RbBNUGQi3kNkkEmitpzZIE5sgGYF/37n
04gMEqk9KJoD70Vl0wdPcyBsyDcHPLUgPOEONxEAhHRt4Q==
"""

# Four particles with "height", 0 to 3: h5part's group of a step.
H5PART = """
eNrr9HBx4+WS4mIAAQ4OBhYGAQZk8B8KNoig8mHyCVCaEUp3QOkVTDBxRrCcBFRcEGo+urqQIFdXkOr/aABmzwNWCM3BMApGIvBwdQwA0RFQPiyVnmBCVRdc
klqgbIBIjx4U2osr/XowQ/gZrMSlXwtowpUYjcrR9AsEGrDykhVVXQWUroTSVVA6IzUzPaMEka4NiLQ32M/fBZSCYeWmAjNqeY2ejkcBrnKAFRJmjDA+JCcz
MkIEWKDqYDQzUB4kI6hgDw17BwYTbgaT/9DwZgWKguSZmJgYIfUaxDxmxgZOaEyhuaBjUIUHJF2xwF25QBi/elj602DHrw5WrjcI4lcHK0cnCA2H1PXBnj7q
4OIO0FhxGM3Zo2AUjIJRMApGwXBuVy4YEu1K+oXHgdHwQAmPB0MiPAAdjl/r
"""

UCD = "4 1 1 0 0\n" + rows("{} {} {} {}\n") + "1 0 tet 1 2 3 4\n1 1\nheight, m\n" + rows("{} {}\n", [[i] for i in range(4)])
TECPLOT = (
    'TITLE = "four"\nVARIABLES = "X", "Y", "Z", "height"\nZONE T="one", N=4, E=1, F=FEPOINT, ET=TETRAHEDRON\n'
    + rows("{1} {2} {3} {0}\n", first=0)
    + "1 2 3 4\n"
)
PDB = rows("ATOM  {:5d}  C   ALA A   1    {:8.3f}{:8.3f}{:8.3f}  1.00  0.00           C\n") + "END\n"
VASP = "time = 0\n1 0 0\n0 1 0\n0 0 1\n4\n" + rows("{} 6 C {} {} {} 1.0 0.0\n")
OFF = "OFF\n4 4 6\n" + rows("{1} {2} {3}\n") + rows("3 {1} {2} {3}\n", FACES)
XDMF = f"""<?xml version="1.0"?><Xdmf Version="2.0"><Domain><Grid Name="four">
<Topology TopologyType="Tetrahedron" NumberOfElements="1">
<DataItem Dimensions="1 4" NumberType="Int" Format="XML">0 1 2 3</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem Dimensions="4 3" Format="XML">{rows("{1} {2} {3} ")}</DataItem></Geometry>
<Attribute Name="height" Center="Node"><DataItem Dimensions="4" Format="XML">0 1 2 3</DataItem></Attribute>
</Grid></Domain></Xdmf>"""

CML = (
    '<?xml version="1.0"?><molecule xmlns="http://www.xml-cml.org/schema"><atomArray>'
    + rows('<atom id="a{}" elementType="C" x3="{}" y3="{}" z3="{}"/>')
    + "</atomArray></molecule>"
)
FACET = (
    "FACET FILE\n1\nfour\n0\n4 0 0\n" + rows("{1} {2} {3}\n") + "1\nfour\n4 3\n"
    + "".join("{} {} {} 0 1\n".format(*(i + 1 for i in face)) for face in FACES)
)

BOXES = {
    "cgns": lambda path: path.write_bytes(zlib.decompress(base64.b64decode(CGNS))),
    "htg": write_htg,
    "nek5000": small_files.write_nek5000,
    "p3d": write_plot3d,
    "pio": small_files.write_pio,
    "res": small_files.write_mfix,
    "sgy": write_segy,
    "wind": small_files.write_wind,
}
POINTS = {
    "3ds": write_3ds,
    "avm": small_files.write_avmesh,
    "b3dm": small_files.write_b3dm,
    "bts": small_files.write_bts,
    "byu": write_byu,
    "cas": write_fluent,
    "cas.h5": lambda path: unpack(small_files.FLUENT, path),
    "case": write_ensight,
    "cfg": small_files.write_motion,
    "cml": lambda path: path.write_text(CML),
    "d3plot": small_files.write_dyna,
    "erfh5": lambda path: unpack(small_files.ERF, path),
    "exo": lambda path: write(path, vtkExodusIIWriter(), cell()),
    "facet": lambda path: path.write_text(FACET),
    "foam": write_foam,
    "geojson": write_geojson,
    "gml": write_gml,
    "h5": lambda path: unpack(small_files.CONVERGE, path),
    "h5part": lambda path: unpack(H5PART, path),
    "inp": lambda path: path.write_text(UCD),
    "json": small_files.write_tileset,
    "neu": write_gambit,
    "off": lambda path: path.write_text(OFF),
    "omf": small_files.write_omf,
    "out": lambda path: path.write_text(VASP),
    "pdb": lambda path: path.write_text(PDB),
    "pvtk": lambda path: write(path, vtkPDataSetWriter(), cell()),
    "smv": small_files.write_fds,
    "sos": write_servers,
    "tag": lambda path: write(path, vtkMNITagPointWriter(), triangles()),
    "tec": lambda path: path.write_text(TECPLOT),
    "tri": write_tri,
    "vrt": write_prostar,
    "vtpc": lambda path: write(path, vtkXMLPartitionedDataSetCollectionWriter(), collection()),
    "vtpd": lambda path: write(path, vtkXMLPartitionedDataSetWriter(), partitioned()),
    "wrl": write_vrml,
    "x3d": small_files.write_x3d,
    "xmf": lambda path: path.write_text(XDMF),
    **BOXES,
}
MIXED = ("avm", "cas", "cfg", "erfh5", "geojson", "gml", "h5", "pio", "sgy", "tri")  # points twice, or in another order
WITH_HEIGHT = ("case", "exo", "h5part", "inp", "pvtk", "tec", "vtpc", "vtpd", "xmf", "cgns", "omf", "wind")


def has_reader(extension):
    form = FORMATS[extension]
    return hasattr(pytest.importorskip(f"vtkmodules.{form.module}", reason=f"no {form.module}"), form.reader)


@pytest.mark.parametrize("extension", POINTS)
def test_points(tmp_path, extension, capfd):
    path = tmp_path / f"points.{extension}"
    POINTS[extension](path)
    if not has_reader(extension):
        pytest.skip(f"this VTK has no {FORMATS[extension].reader}")
    cloud = read(str(path))
    assert capfd.readouterr() == ("", "")
    assert cloud.IsA("vtkPolyData")
    points = vtk_to_numpy(cloud.GetPoints().GetData())
    expected = BOX.reshape(3, -1).T if extension in BOXES else CORNERS
    if extension == "sgy":
        expected = expected * (1, 1, -1)  # time goes down
    if extension == "res":
        expected = np.stack(np.meshgrid(*(np.arange(-1, 3) * size for size in (3, 2, 1))), axis=-1).reshape(-1, 3)
        points, expected = np.unique(points, axis=0), np.unique(expected, axis=0)
    if extension == "wind":
        expected = expected + (0, 0, 0.5)
    if extension == "json":
        expected = expected[:, [0, 2, 1]] * (1, -1, 1)
    if extension in MIXED:
        points, expected = np.unique(points, axis=0), np.unique(expected, axis=0)
    assert np.allclose(points, expected)
    if extension in WITH_HEIGHT:
        heights = cloud.GetPointData().GetArray("height")
        assert vtk_to_numpy(heights).tolist() == list(range(len(expected)))


def test_obstacles_of_fds(tmp_path):
    """Their nodes are points as well, the room's are not."""
    if not has_reader("smv"):
        pytest.skip("this VTK has no vtkFDSReader")
    small_files.write_fds(tmp_path / "room.smv", " 1\n 1 2 1 2 1 2 1\n 1 2 1 2 1 2 1")
    points = vtk_to_numpy(read(str(tmp_path / "room.smv")).GetPoints().GetData())
    cube = np.stack(np.meshgrid([1, 2], [1, 2], [1, 2]), axis=-1).reshape(-1, 3)
    assert np.array_equal(np.unique(points, axis=0), np.unique(np.concatenate([CORNERS, cube]), axis=0))


@pytest.mark.parametrize("extension", ["3ds", "wrl"])
def test_scenes_need_no_display(tmp_path, extension, monkeypatch, capfd):
    """Nor OpenGL; and a reader that cannot tell how far it is is none the worse for being asked to."""
    monkeypatch.setenv("DISPLAY", ":4711")
    monkeypatch.setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/none.json")
    path = tmp_path / f"scene.{extension}"
    POINTS[extension](path)
    assert read(str(path), tell=True).GetNumberOfPoints() == 4
    assert capfd.readouterr() == ("", "")


LOOKED_AT = ("amrex", "cube", "d3plot", "dcm", "h", "mrc", "ply", "res", "stl", "tag", "tri")  # before a reader is asked for


@pytest.mark.parametrize("extension", FORMATS)
def test_readers_that_this_vtk_does_not_have(tmp_path, extension, monkeypatch):
    """Module or class: both are named, with what to do."""
    form = FORMATS[extension]
    path = tmp_path / f"points.{extension}"
    path.write_text("")
    for missing in (form._replace(module="vtkIONowhere"), form._replace(reader="vtkNoReader")):
        monkeypatch.setitem(FORMATS, extension, missing)
        if extension not in LOOKED_AT:
            check_fault(path, missing.module, missing.reader, "pip install vtk")


BROKEN = [e for e in (*VOLUMES, *LEVELS, *POINTS) if e not in ("dicom", "foam", "off", "xmf")]


@pytest.mark.parametrize("content", [b"", b"\x00\xff\x13 no such thing \n" * 50], ids=["empty", "garbage"])
@pytest.mark.parametrize("extension", BROKEN)
def test_broken_files(tmp_path, extension, content, capfd):
    path = tmp_path / f"broken.{extension}"
    path.write_bytes(content)
    check_fault(path)
    assert capfd.readouterr() == ("", "")


CUT = "3ds avm b3dm bts cas.h5 cgns cube erfh5 exo facet flash gml h5 h5part inp mnc nc nek5000 neu omf out slc tag vtkhdf x3d"


SHARES = [(e, s) for e in CUT.split() for s in (0.9, 0.5)] + [("byu", 0.5), ("case", 0.5), ("tri", 0.9)]


@pytest.mark.parametrize("extension, share", SHARES)
def test_files_cut_short(tmp_path, extension, share):
    path = tmp_path / f"short.{extension}"
    {**VOLUMES, **LEVELS, **POINTS}[extension](path)
    if not has_reader(extension):
        pytest.skip(f"this VTK has no {FORMATS[extension].reader}")
    content = path.read_bytes()
    path.write_bytes(content[: int(len(content) * share)])
    check_fault(path)


COMPANIONS = {
    "cfg": "{}.stl",
    "d3plot": "{}.d3plot01",
    "h": "{}.h@",
    "h5rage": "{}-h0001values000001",
    "nek5000": "{}0.f00001",
    "pio": "{}-dmp000000",
    "vpc": "fields/T.0/fields.000000.0000",
    "wind": "steps/step.0",
}


@pytest.mark.parametrize("share", [0.6, 0])
@pytest.mark.parametrize("extension", COMPANIONS)
def test_files_cut_short_beside_a_header(tmp_path, extension, share):
    if not has_reader(extension):
        pytest.skip(f"this VTK has no {FORMATS[extension].reader}")
    path = tmp_path / f"short.{extension}"
    {**VOLUMES, **POINTS}[extension](path)
    companion = tmp_path / COMPANIONS[extension].format("short")
    content = companion.read_bytes()
    companion.write_bytes(content[: int(len(content) * share)])
    check_fault(path)


def test_steps_and_cells_that_are_missing(tmp_path):
    """Beside a restart file of MFIX, and beside columns of CAM."""
    small_files.write_mfix(tmp_path / "run.res")
    (tmp_path / "run.SP1").unlink()
    check_fault(tmp_path / "run.res", "has no steps", "SP1")
    (tmp_path / "run.res").write_bytes((tmp_path / "run.res").read_bytes()[:2100])
    check_fault(tmp_path / "run.res", "cut short")
    small_files.write_cam(tmp_path / "columns.nc")
    (tmp_path / "cells.nc").unlink()
    check_fault(tmp_path / "columns.nc", "element_corners")


def test_a_reader_that_does_not_come_to_an_end(tmp_path, monkeypatch, capsys):
    """VTK's of Tecplot, on a file that ends amid its points."""
    path = tmp_path / "short.tec"
    path.write_text(TECPLOT[: len(TECPLOT) // 2])
    monkeypatch.setattr("pointsurface.readers._TRIAL_SECONDS", 2.0)
    with pytest.raises(UnreadableFile, match="cannot be read"):
        read(str(path), tell=True)
    assert f"reading {path} in a process of its own first: 1 s" in capsys.readouterr().err


def test_time_for_data_that_lie_in_another_file(tmp_path, monkeypatch):
    """How long a trial may take is told by the data, not by their header."""
    (tmp_path / "large.raw").write_bytes(bytes(range(250)) * 4000)
    (tmp_path / "large.mhd").write_text(
        "ObjectType = Image\nNDims = 3\nDimSize = 100 100 100\nElementType = MET_UCHAR\nElementDataFile = large.raw\n"
    )
    monkeypatch.setattr("pointsurface.readers._TRIAL_SECONDS", 0.0)
    monkeypatch.setattr("pointsurface.readers._TRIAL_SECONDS_PER_MEGABYTE", 20.0)
    assert read(str(tmp_path / "large.mhd")).GetNumberOfPoints() == 1_000_000


def test_netcdf_whose_header_makes_no_sense(tmp_path):
    """A variable of a dimension that is not there."""
    path = tmp_path / "broken.nc"
    write_netcdf(path)
    content = path.read_bytes()
    variable = struct.pack(">3i", 3, 0, 1) + struct.pack(">i", 2)  # "values", by z, y, x
    assert content.count(variable) == 1
    path.write_bytes(content.replace(variable, struct.pack(">4i", 3, 0, 1, 9)))
    check_fault(path, "its header makes no sense")


def test_every_reader_of_this_vtk_is_in_the_table_or_it_is_said_why_not():
    """In a process of its own, since it loads all of VTK."""
    code = (
        "import importlib, pkgutil, vtkmodules\n"
        "from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm\n"
        "from vtkmodules.vtkIOImport import vtkImporter\n"
        "for module in pkgutil.iter_modules(vtkmodules.__path__):\n"
        "    if not module.name.startswith(('vtkIO', 'vtkFilters', 'vtkDomains', 'vtkGeovis')):\n"
        "        continue\n"
        "    try:\n"
        "        members = vars(importlib.import_module('vtkmodules.' + module.name))\n"
        "    except ImportError:\n"
        "        continue\n"
        "    for name, kind in members.items():\n"
        "        if name.endswith(('Reader', 'Importer')) and issubclass(kind, (vtkAlgorithm, vtkImporter)):\n"
        "            print(name)\n"
    )
    known = set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())
    read = {form.reader for form in (*FORMATS.values(), *(form for kinds in BY_CONTENT.values() for form in kinds.values()))}
    left_out = [name for names in NOT_READ.values() for name in names.split()]
    assert len(known) > 150 and len(left_out) == len(set(left_out))
    assert known - read - set(left_out) == set()
    assert read & set(left_out) == set()
