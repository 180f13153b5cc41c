# SPDX-License-Identifier: BSD-3-Clause
"""Files that are there whole or not at all, and clouds as files."""

import os
import tempfile
from contextlib import contextmanager

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_DOUBLE, VTK_UNSIGNED_CHAR
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from .errors import WrongUse, complaints
from .progress import followed


@contextmanager
def whole_file(path):
    """The path of an empty file beside `path`, which takes its name if the block ends well, and else goes.

    An OSError of the block, or of the folder, names `path`.
    """
    folder, name = os.path.split(os.path.abspath(path))
    try:
        handle, temporary = tempfile.mkstemp(dir=folder, prefix=name + ".", suffix=os.path.splitext(name)[1])
        os.close(handle)
        try:
            yield temporary
            os.chmod(temporary, 0o644)
            os.replace(temporary, path)
        except BaseException:
            os.unlink(temporary)
            raise
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), path) from error


def write_whole(path, content):
    """Writes bytes to a file that appears under its name once it is complete."""
    with whole_file(path) as temporary, open(temporary, "wb") as file:
        file.write(content)


def check_writable(path):
    """Raises WrongUse if the folder that a file is to be written to is not there."""
    folder = os.path.dirname(os.path.abspath(path))
    if not os.path.isdir(folder):
        raise WrongUse(f"{folder} is no folder, so that {path} cannot be written")
    if os.path.isdir(path):
        raise WrongUse(f"{path} is a folder, so that it cannot be written")


def cloud_extension(path):
    """The extension of a file that write_cloud can write. Raises WrongUse."""
    extension = os.path.splitext(path)[1].lower().lstrip(".")
    if extension not in _WRITERS:
        raise WrongUse(f"{path} has an unknown extension; known for writing are {', '.join(_WRITERS)}")
    return extension


def write_cloud(path, cloud):
    """Writes the points of a vtkPolyData, by extension.

    vtp: with all arrays; ply: with normals and colours (active scalars of bytes); xyz: with normals, else colours.
    Returns a list of what the format cannot hold, in words. Raises WrongUse or OSError.
    """
    extension = cloud_extension(path)
    check_writable(path)
    with whole_file(path) as temporary:
        _WRITERS[extension](temporary, cloud)
    return _left_out(extension, cloud)


def _left_out(extension, cloud):
    if extension == "vtp":
        return []
    data = cloud.GetPointData()
    kept = [array for array in (data.GetNormals(), _colors(data)) if array is not None]
    kept = kept[:1] if extension == "xyz" else kept
    arrays = (data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays()))
    return [f'the array "{array.GetName()}"' for array in arrays if array not in kept]


def _colors(data):
    scalars = data.GetScalars()
    has_colors = scalars is not None and scalars.GetDataType() == VTK_UNSIGNED_CHAR
    return scalars if has_colors and scalars.GetNumberOfComponents() in (3, 4) else None


def _write_vtp(path, cloud):
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetFileName(path)
    writer.SetInputData(cloud)
    with complaints() as said, followed(writer, "writing"):
        writer.Write()
    if said("ERROR"):
        raise OSError(said("ERROR")[0])


def _write_ply(path, cloud):
    """By numpy: VTK's own writer rounds coordinates, and has normals from 9.4 on alone."""
    kind = "double" if cloud.GetPoints().GetDataType() == VTK_DOUBLE else "float"
    columns = [(name, kind, values) for name, values in zip("xyz", _columns(cloud.GetPoints().GetData()))]
    normals, colors = cloud.GetPointData().GetNormals(), _colors(cloud.GetPointData())
    if normals is not None:
        columns += [(name, "float", values) for name, values in zip(("nx", "ny", "nz"), _columns(normals))]
    if colors is not None:
        columns += [(name, "uchar", values) for name, values in zip(("red", "green", "blue", "alpha"), _columns(colors))]
    records = np.empty(cloud.GetNumberOfPoints(), [(name, _PLY_TYPES[kind]) for name, kind, _ in columns])
    for name, _, values in columns:
        records[name] = values
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(records)}"]
    header += [f"property {kind} {name}" for name, kind, _ in columns]
    header += ["element face 0", "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode())
        records.tofile(file)


_PLY_TYPES = {"double": "<f8", "float": "<f4", "uchar": "u1"}


def _columns(array):
    return vtk_to_numpy(array).T


def _write_xyz(path, cloud):
    columns = [vtk_to_numpy(cloud.GetPoints().GetData())]
    data = cloud.GetPointData()
    formats = ["%.9g" if cloud.GetPoints().GetDataType() != VTK_DOUBLE else "%.17g"] * 3
    if data.GetNormals() is not None:
        columns.append(vtk_to_numpy(data.GetNormals()))
        formats += ["%.6g"] * 3
    elif _colors(data) is not None:
        columns.append(vtk_to_numpy(_colors(data))[:, :3])
        formats += ["%d"] * 3
    np.savetxt(path, np.hstack(columns), fmt=formats)


_WRITERS = {"vtp": _write_vtp, "ply": _write_ply, "xyz": _write_xyz}
