# SPDX-License-Identifier: BSD-3-Clause
"""Opens a user's file, whatever its format, as a volume or as points."""

import os
import re
import subprocess
import sys
import warnings
from contextlib import nullcontext

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOImage import vtkMetaImageReader, vtkNIFTIImageReader, vtkNrrdReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader

from .errors import WrongUse, complaints
from .progress import followed


class UnreadableFile(WrongUse):
    """A file that cannot be opened as a volume or as points; its text is one line that says why."""


def read(path, tell=False):
    """The content of a file: vtkImageData for a volume, vtkPolyData for points or a mesh.

    By extension: vti, mhd, mha, nhdr, nrrd, nii, nii.gz (volumes, with one component of active scalars);
    vtp, ply, obj, stl (points, with normals, colours and polygons if the file has them; an array "radius" is the
    points' size and never their colour, so it is not left as the active scalars);
    xyz (text, one point a line: x y z, or x y z nx ny nz, or x y z r g b with colours of 0 to 255; blanks or commas
    between the numbers; comments start with # or //).
    tell: show on standard error how far VTK is, where that takes over a second, and let Ctrl-C stop it.
    Raises UnreadableFile for a file that is missing, broken, empty or of an unknown format.
    """
    if os.path.isdir(path):
        raise UnreadableFile(f"{path} is a folder; a file is needed")
    if not os.path.exists(path):
        raise UnreadableFile(f"{path} does not exist")
    if not os.access(path, os.R_OK):
        raise UnreadableFile(f"{path} may not be read by this user")

    extension = _extension(path)
    if extension == "xyz":
        cloud = _read_xyz(path)
        _check_points(path, cloud)
        return cloud
    if extension == "stl":
        _check_stl(path)
    if extension == "ply":
        _check_ply(path)
    if extension in _NEED_TRIAL:
        _try_reader(_READERS[extension], path)
    data = _run_reader(_READERS[extension](), path, tell)
    if isinstance(data, vtkImageData):
        _check_volume(path, data)
    else:
        _check_points(path, data)
    return data


_READERS = {
    "vti": vtkXMLImageDataReader,
    "mhd": vtkMetaImageReader,
    "mha": vtkMetaImageReader,
    "nhdr": vtkNrrdReader,
    "nrrd": vtkNrrdReader,
    "nii": vtkNIFTIImageReader,
    "nii.gz": vtkNIFTIImageReader,
    "vtp": vtkXMLPolyDataReader,
    "ply": vtkPLYReader,
    "obj": vtkOBJReader,
    "stl": vtkSTLReader,
}

# On a file cut short these readers crash (PLY), or print a line and go on with a part of the data (MetaImage).
_NEED_TRIAL = ("ply", "mhd", "mha")


def _extension(path):
    name = os.path.basename(path).lower()
    for extension in (*_READERS, "xyz"):
        if name.endswith("." + extension):
            return extension
    known = ", ".join([*_READERS, "xyz"])
    raise UnreadableFile(f"{path} has an unknown extension; known are {known}")


def _run_reader(reader, path, tell):
    """The reader's output; whatever VTK has to complain about, from any object below it, raises UnreadableFile."""
    with complaints() as said, followed(reader, f"reading {path}") if tell else nullcontext():
        reader.SetFileName(path)
        reader.Update()
    errors = said("ERROR")
    if errors:
        raise UnreadableFile(f"{path} cannot be read: {reader.GetClassName()} says: {errors[0]}")
    return reader.GetOutput()


def _try_reader(reader_class, path):
    """Reads the file in a process of its own; a crash, or anything printed, raises UnreadableFile."""
    code = f"""
import sys
from {reader_class.__module__} import {reader_class.__name__}
reader = {reader_class.__name__}()
reader.SetFileName(sys.argv[1])
reader.Update()
"""
    trial = subprocess.run([sys.executable, "-c", code, path], capture_output=True, text=True, errors="replace")
    if trial.returncode != 0 or trial.stderr.strip():
        said = re.sub(r"\x1b\[\d*m", "", trial.stderr)  # colours
        said = re.sub(r"^(?:.*\| )?(?:\w+ \(0x\w+\): )?", "", said, flags=re.M)  # time, place, object
        reason = next((line.strip() for line in said.splitlines() if line.strip()), "nothing, and crashes")
        raise UnreadableFile(f"{path} cannot be read: {reader_class.__name__} says: {reason}")


def _check_stl(path):
    """VTK takes whatever bytes there are for triangles."""
    size = os.path.getsize(path)
    with open(path, "rb") as file:
        head = file.read(84)
    is_text = head.lstrip()[:5].lower() == b"solid"
    triangles = int.from_bytes(head[80:84], "little")
    if not is_text and (len(head) < 84 or size < 84 + 50 * triangles):
        raise UnreadableFile(f"{path} is no STL: neither text that starts with solid, nor as long as its header says")


_PLY_SIZES = {
    **dict.fromkeys(("char", "uchar", "int8", "uint8"), 1),
    **dict.fromkeys(("short", "ushort", "int16", "uint16"), 2),
    **dict.fromkeys(("int", "uint", "float", "int32", "uint32", "float32"), 4),
    **dict.fromkeys(("double", "float64"), 8),
}


def _check_ply(path):
    """From 9.6 on VTK fills up a file that is cut short: it must have the lines or bytes that its header asks for."""
    with open(path, "rb") as file:
        header = []
        for line in file:
            header.append(line.decode("ascii", "replace").split())
            if header[-1] == ["end_header"]:
                break
        is_text = ["format", "ascii"] in [words[:2] for words in header]
        found = sum(1 for _ in file) if is_text else os.path.getsize(path) - file.tell()
    try:
        needed = _ply_lines(header) if is_text else _ply_bytes(header)
    except (IndexError, KeyError, ValueError) as error:
        raise UnreadableFile(f"{path} is no PLY: its header makes no sense at {error}") from error
    if found < needed:
        unit = "lines" if is_text else "bytes"
        raise UnreadableFile(f"{path} is cut short: its header asks for at least {needed} {unit}, and {found} follow it")


def _ply_lines(header):
    return sum(int(words[2]) for words in header if words[:1] == ["element"])


def _ply_bytes(header):
    """At least: a face has three corners or more, other lists may be empty."""
    size = count = 0
    for words in header:
        if words[:1] == ["element"]:
            count = int(words[2])
        elif words[:2] == ["property", "list"]:
            corners = 3 if words[4] in ("vertex_indices", "vertex_index") else 0
            size += count * (_PLY_SIZES[words[2]] + corners * _PLY_SIZES[words[3]])
        elif words[:1] == ["property"]:
            size += count * _PLY_SIZES[words[1]]
    return size


def _check_volume(path, volume):
    data = volume.GetPointData()
    if data.GetScalars() is None and data.GetNumberOfArrays() > 0:
        data.SetActiveScalars(data.GetArrayName(0))
    scalars = data.GetScalars()
    if volume.GetNumberOfPoints() == 0 or scalars is None or scalars.GetNumberOfTuples() == 0:
        raise UnreadableFile(f"{path} holds no volume with values at its points")
    if scalars.GetNumberOfComponents() != 1:
        raise UnreadableFile(
            f'{path}: the array "{scalars.GetName()}" has {scalars.GetNumberOfComponents()} components; '
            "a volume of one component is needed"
        )
    if min(volume.GetDimensions()) < 2:
        size = " x ".join(map(str, volume.GetDimensions()))
        raise UnreadableFile(f"{path} is {size} samples; a volume needs at least 2 along each axis")


def _check_points(path, data):
    if data.GetNumberOfPoints() == 0:
        raise UnreadableFile(f"{path} holds no points")
    if not np.any(np.isfinite(vtk_to_numpy(data.GetPoints().GetData())).all(axis=1)):
        raise UnreadableFile(f"{path} holds no points with finite coordinates")
    scalars = data.GetPointData().GetScalars()
    if scalars is not None and scalars.GetName() == "radius":
        data.GetPointData().SetActiveScalars(None)


def _read_xyz(path):
    try:
        with open(path, encoding="utf-8") as file, warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # of an empty file, which is an error below
            lines = (line.replace(",", " ") for line in file)
            values = np.loadtxt(lines, comments=("#", "//"), ndmin=2)
    except ValueError as error:  # UnicodeDecodeError among them
        raise UnreadableFile(f"{path} cannot be read as columns of numbers: {error}") from error
    if values.size > 0 and values.shape[1] not in (3, 6):
        raise UnreadableFile(
            f"{path} has {values.shape[1]} columns; x y z, x y z nx ny nz or x y z r g b are needed"
        )
    return _points_with_attributes(values) if values.size > 0 else vtkPolyData()


def _points_with_attributes(values):
    """Points from columns x y z, and three more: normals if all are in -1 to 1, else colours of 0 to 255."""
    result = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(values[:, :3]), deep=True))
    result.SetPoints(points)
    attributes = np.ascontiguousarray(values[:, 3:])
    if attributes.shape[1] == 0:
        return result
    if np.nanmax(np.abs(attributes)) <= 1.001:  # some writers round up
        normals = numpy_to_vtk(attributes.astype(np.float32), deep=True)
        normals.SetName("Normals")
        result.GetPointData().SetNormals(normals)
    else:
        colors = numpy_to_vtk(np.clip(np.nan_to_num(attributes), 0, 255).astype(np.uint8), deep=True)
        colors.SetName("RGB")
        result.GetPointData().SetScalars(colors)
    return result
