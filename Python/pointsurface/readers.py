# SPDX-License-Identifier: BSD-3-Clause
"""Opens a user's file, whatever its format, as a volume or as points."""

import glob
import importlib.util
import json
import math
import os
import re
import struct
import subprocess
import sys
import warnings
from contextlib import nullcontext

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray, vtkVersion
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet,
    vtkHyperTreeGrid,
    vtkImageData,
    vtkMolecule,
    vtkPointSet,
    vtkPolyData,
    vtkRectilinearGrid,
    vtkUniformGridAMR,
)
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCellDataToPointData, vtkResampleToImage
from vtkmodules.vtkFiltersGeneral import vtkRectilinearGridToPointSet
from vtkmodules.vtkFiltersHyperTree import vtkHyperTreeGridToUnstructuredGrid

from . import formats, scans
from .clouds import make_cloud
from .errors import UnreadableFile, complaints, silent
from .progress import followed, waiting


def read(path, tell=False):
    """The content of a file: vtkImageData for a volume, vtkPolyData for points or a mesh.

    By extension (upper case, too), as the module formats tells, with what VTK has a reader for: volumes, with one component
    of active scalars, evenly spaced; a tif has a slice a picture, and a folder of dcm files is a volume of slices; points,
    with normals, colours and polygons if the file has them; of grids their points, of molecules their atoms, of scenes
    what is on stage, in its place; of trees all blocks' points as one cloud, with the arrays that all have. Volumes of
    levels (AMR) are sampled evenly, as finely as their finest level, but at no more than 2^24 places; a file that holds
    particles and no levels, or a plotfile's folder of them, is points. Of FDS what was measured, the slices and obstacles.
    las, laz, e57: as the module scans tells; pcd, where PointSurface was built with PCL: as vtkPCDReader tells;
    xyz (text, of a molecule, or one point a line: x y z, or x y z nx ny nz, or x y z r g b with colours of 0 to 255; blanks
    or commas between the numbers; comments start with # or //); pts (text; behind a line with their number, one point a
    line: x y z, x y z intensity, x y z r g b or x y z intensity r g b).
    An array "radius" is the points' size and never their colour, so it is not left as the active scalars.
    tell: show on standard error how far VTK is, where that takes over a second, and let Ctrl-C stop it.
    Raises UnreadableFile for a file that is missing, broken, empty or of an unknown format.
    """
    if not os.path.exists(path):
        raise UnreadableFile(f"{path} does not exist")
    if not os.access(path, os.R_OK):
        raise UnreadableFile(f"{path} may not be read by this user")
    if os.path.isdir(path) and _kind_of_folder(path) is None:
        raise UnreadableFile(
            f"{path} is a folder without slices (.dcm) and no plotfile of AMReX; a file, or a folder of such, is needed"
        )

    extension = _extension(path)
    form = _form(path, extension)
    if extension in _TEXTS and form is None:
        data = _TEXTS[extension](path)
    elif extension in scans.READERS:
        data = scans.read(path, extension, tell)
    else:
        data = _points_or_volume(path, _read_with_vtk(path, extension, form, tell))
        if isinstance(data, vtkPolyData):
            _make_arrays_plain(data)
        if extension == "cube":
            _place_cube(path, data)
        if form and form.reader == "vtkMPASReader" and data.GetNumberOfPoints() > 0:
            data = _without_first_point(data)
    if isinstance(data, vtkImageData):
        _check_volume(path, data)
    else:
        _check_points(path, data)
    return data


def _kind_of_folder(folder):
    names = os.listdir(folder)
    if any(name.lower().endswith(".dcm") for name in names):
        return "dcm"
    return "amrex" if {"Header", "Level_0"} <= set(names) else None


def _form(path, extension):
    """How VTK reads it, if it does. What has the extension of another format is told by its content."""
    kinds = formats.BY_CONTENT.get(extension)
    kind = kinds and _KINDS[extension](path)
    return kinds[kind] if kind else formats.FORMATS.get(extension)


def _kind_of_plotfile(path):
    """Its particles are in a folder of their own, which has a header of its own."""
    if os.path.isdir(path):
        with open(os.path.join(path, "Header"), "rb") as file:
            return "particles" if file.readline().startswith(b"Version_") else None


def _kind_of_enzo(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        counts = re.findall(r"^(NumberOfBaryonFields|NumberOfParticles)\s*=\s*(\d+)", file.read(), re.M)
    fields, particles = ({int(n) for name, n in counts if name.endswith(end)} for end in ("Fields", "Particles"))
    return "particles" if fields == {0} and max(particles, default=0) > 0 else None


def _kind_of_flash(path):
    """By names in HDF5, which are as they are."""
    found = list(formats.names_in(path, [b"tracer particles", b"node type"]))
    return "particles" if found == [b"tracer particles"] else None


def _kind_of_hdf5(path):
    """By names, which are as they are."""
    return _kind_by_bytes(path, {b"Nodal Coordinates": "TRUCHAS", b"axial_mesh": "VERA"})


def _kind_of_netcdf(path):
    kinds = {b"tetrahedron_interior": "SLAC", b"particlePos": "SLAC particles", b"mesh_topology": "UGRID"}
    return _kind_by_bytes(path, {**kinds, b"cellsOnVertex": "MPAS", b"ncol\0": "CAM"})


def _kind_by_bytes(path, kinds):
    """The first of those whose name is there."""
    found = set(formats.names_in(path, kinds))
    return next((kind for name, kind in kinds.items() if name in found), None)


def _kind_of_obj(path):
    """MNI's begins with the letter of an object, as text or (small) bytes; a line of Wavefront's with small ones."""
    with open(path, "rb") as file:
        head = file.read(64)
    return "MNI" if re.match(rb"[PL] ", head) or (head[:1] in (b"p", b"l") and b"\0" in head) else None


def _kind_of_vasp(path):
    """Both of VASP's begin with a time; that with the cells of atoms tells the lattice by names."""
    with open(path, "rb") as file:
        return "tessellation" if b"Rx1" in file.read(200) else None


def _kind_of_xyz(path):
    """Of a molecule: how many atoms, a title, and of each atom its element and its place."""
    with open(path, encoding="utf-8", errors="replace") as file:
        count, _, atom = [next(file, "").split() for _ in range(3)]
    return "molecule" if len(count) == 1 and count[0].isdecimal() and len(atom) > 3 and atom[0].isalpha() else None


_KINDS = {
    "amrex": _kind_of_plotfile,
    "flash": _kind_of_flash,
    "h5": _kind_of_hdf5,
    "hierarchy": _kind_of_enzo,
    "nc": _kind_of_netcdf,
    "ncdf": _kind_of_netcdf,
    "obj": _kind_of_obj,
    "out": _kind_of_vasp,
    "xyz": _kind_of_xyz,
}


def _extension(path):
    if os.path.isdir(path):
        return _kind_of_folder(path)
    name = "." + os.path.basename(path).lower()  # so that a name may be an extension and nothing else
    known = (*formats.FORMATS, "pcd", *_TEXTS, *scans.READERS)
    for extension in known:
        if name.endswith("." + extension):
            return extension
    raise UnreadableFile(f"{path} has an unknown extension; known are {', '.join(known)}")


def _read_with_vtk(path, extension, form, tell):
    if extension in _CHECKS:
        _CHECKS[extension](path)
    if form:
        _require_reader(form, path)
        _require_cells(form, path)
    if form and form.is_tried:
        with waiting(f"reading {path} in a process of its own first") if tell else nullcontext():
            _try(form, extension, path)
    with complaints() as said:
        reader = formats.make_reader(form, path) if form else _pcd_reader(path)
        can_tell = hasattr(reader, "AbortExecuteOn")  # importers cannot
        shown = followed(reader, f"reading {path}") if tell and can_tell else nullcontext()
        with silent(form.prints if form else 0), shown:
            reader.Update()
    errors = said("ERROR")
    if errors:
        raise UnreadableFile(f"{path} cannot be read: {reader.GetClassName()} says: {errors[0]}")
    return reader.GetOutputDataObject(form.port if form else 0)


def _require_reader(form, path):
    try:
        formats.reader_class(form)
    except (ImportError, AttributeError):
        raise UnreadableFile(
            f"{path} needs {form.reader} in VTK's module {form.module}, which this VTK ({vtkVersion.GetVTKVersion()}) does "
            "not have; that of the Python index may: pip install vtk"
        ) from None


def _require_cells(form, path):
    if form.reader == "vtkNetCDFCAMReader" and formats.cells_of_cam(path) is None:
        raise UnreadableFile(f"{path} has columns of CAM; a file .nc with their cells (element_corners) is needed beside it")


# A trial that goes on for longer has lost its way: this, and so much more for each megabyte.
_TRIAL_SECONDS = 30.0
_TRIAL_SECONDS_PER_MEGABYTE = 2.0

# What has its data in other files: of the same folder, or of folders in it.
_HEADERS = """amrex cas cas.h5 case cfg d3plot dcm encas foam h h5rage hierarchy json mhd nek5000 p3d pio res smv sos vpc vrt
    wind xdmf xmf""".split()
_HEADERS_OF_FOLDERS = ("amrex", "foam", "h5rage", "json", "pio", "vpc", "wind")


def _bytes_to_read(path, extension):
    """At most: of a header all that lies beside it."""
    if extension not in _HEADERS:
        return os.path.getsize(path)
    folder = path if os.path.isdir(path) else os.path.dirname(os.path.abspath(path))
    names = glob.iglob(os.path.join(glob.escape(folder), "**" if extension in _HEADERS_OF_FOLDERS else "*"), recursive=True)
    return sum(os.path.getsize(name) for name in names if os.path.isfile(name))


def _try(form, extension, path):
    """Reads the file in a process of its own; a crash, anything printed, or no end raises UnreadableFile."""
    command = [sys.executable, formats.__file__, json.dumps(form), path]
    limit = _TRIAL_SECONDS + _TRIAL_SECONDS_PER_MEGABYTE * _bytes_to_read(path, extension) / 1e6
    try:
        trial = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=limit)
    except subprocess.TimeoutExpired:
        raise UnreadableFile(f"{path} cannot be read: {form.reader} does not come to an end in {limit:.0f} s") from None
    complains = "ERR|" in trial.stderr if form.prints == 2 else trial.stderr.strip()
    if trial.returncode != 0 or complains:
        said = re.sub(r"\x1b\[\d*m", "", trial.stderr)  # colours
        said = re.sub(r"^(?:.*\| )?(?:\w+ \(0x\w+\): )?", "", said, flags=re.M)  # time, place, object
        reason = next((line.strip() for line in said.splitlines() if line.strip()), "nothing, and crashes")
        raise UnreadableFile(f"{path} cannot be read: {form.reader} says: {reason}")


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


def _check_avm(path):
    """VTK takes what it finds in memory for the part of a file that is missing."""
    with open(path, "rb") as file:
        head = file.read(10)
        if not head.startswith(b"AVMESH"):
            return  # VTK's reader says so
        order = "little" if head[6:] == b"\1\0\0\0" else "big"

        def take(count):
            content = file.read(4 * count)
            return [int.from_bytes(content[i : i + 4], order, signed=True) for i in range(0, 4 * count, 4)]

        version = take(1)[0]
        is_first = version == 1  # with neighbours of faces, and polyhedra, that VTK does not read
        file.seek(154)
        file.seek(158 + max(take(1)[0], 0) + (944 if is_first else 964))
        nodes, *_ = take(6)
        file.seek(0 if is_first else 40, os.SEEK_CUR)
        patches, hexahedra, tetrahedra, prisms, pyramids = take(5)
        file.seek(4 if is_first else 0, os.SEEK_CUR)
        triangles, _, quadrangles, _ = take(4)
        needed = file.tell() + (36 if is_first else 20) + 52 * patches + 24 * nodes
    needed += 4 * ((4 + is_first) * triangles + (5 + is_first) * quadrangles)
    needed += 4 * (8 * hexahedra + 4 * tetrahedra + 6 * prisms + 5 * pyramids)
    if os.path.getsize(path) < needed:
        raise UnreadableFile(f"{path} is cut short: its header asks for {needed} bytes, not {os.path.getsize(path)}")


_MRC_SIZES = {0: 1, 1: 2, 2: 4, 6: 2}  # bytes of a value, by mode


def _check_mrc(path):
    """VTK takes what it finds in memory for the part of a file that is missing."""
    with open(path, "rb") as file:
        header = file.read(1024)
    order = "big" if header[212:213] == b"\x11" else "little"
    numbers = [int.from_bytes(header[i : i + 4], order, signed=True) for i in (0, 4, 8, 12, 92)]
    *counts, mode, extension = numbers
    if len(header) < 1024 or min(*counts, extension + 1) < 1 or mode not in _MRC_SIZES:
        raise UnreadableFile(f"{path} is no MRC of real numbers: its header makes no sense")
    needed = 1024 + extension + counts[0] * counts[1] * counts[2] * _MRC_SIZES[mode]
    if os.path.getsize(path) < needed:
        raise UnreadableFile(f"{path} is cut short: its header asks for {needed} bytes, not {os.path.getsize(path)}")


def _pcd_reader(path):
    from .vtkPointSurfacePCL import vtkPCDReader  # here, as PCL takes half a second to load

    reader = vtkPCDReader()
    reader.SetFileName(path)
    return reader


def _check_pcd(path):
    if importlib.util.find_spec(f"{__package__}.vtkPointSurfacePCL") is None:
        raise UnreadableFile(
            f"{path} needs PointSurface built with PCL: configure it with -DPOINTSURFACE_PCL=ON (Debian: libpcl-dev)"
        )


_NETCDF_SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8}  # bytes of a value, by kind


def _check_netcdf(path):
    """Values that a file in the classic format lacks are taken for zeros. (Others are HDF5, which notices.)"""
    with open(path, "rb") as file:
        version = {b"CDF\x01": 4, b"CDF\x02": 8}.get(file.read(4))
        if version is None:
            return
        try:
            needed = _netcdf_bytes(file, offset_bytes=version)
        except (EOFError, LookupError) as error:
            raise UnreadableFile(f"{path} is cut short, or no NetCDF: its header makes no sense") from error
    if os.path.getsize(path) < needed:
        raise UnreadableFile(f"{path} is cut short: its header asks for {needed} bytes, not {os.path.getsize(path)}")


def _netcdf_bytes(file, offset_bytes):
    """Of a file behind its first four bytes: how many the header and all variables but those of many records take."""

    def take(count):
        content = file.read(count + -count % 4)
        if len(content) < count + -count % 4:
            raise EOFError
        return content[:count]

    def number(size=4):
        return int.from_bytes(take(size), "big")

    def count_of_list():
        number()  # which says what the list is of
        return number()

    def skip_attributes():
        for _ in range(count_of_list()):
            take(number())
            size = _NETCDF_SIZES[number()]
            take(number() * size)

    records = number()
    lengths = []
    for _ in range(count_of_list()):
        take(number())
        lengths.append(number())
    skip_attributes()
    needed = 0
    for _ in range(count_of_list()):
        take(number())
        dimensions = [lengths[number()] for _ in range(number())]
        skip_attributes()
        size = _NETCDF_SIZES[number()]
        number()  # bytes, which overflow for large variables
        begin = number(offset_bytes)
        is_record = dimensions[:1] == [0]  # one after the other with those of the other variables
        for length in dimensions[1:] if is_record else dimensions:
            size *= length
        needed = max(needed, begin + size if not is_record or records else 0)
    return needed


def _check_res(path):
    """VTK takes what it finds in memory for the part of a file that is missing, and crashes where there are no steps."""
    with open(path, "rb") as file:
        head = file.read(2048)
    sizes = np.frombuffer(head[1536:1596].ljust(60, b"\0"), ">i4").tolist()
    along, cells = sizes[9:12], sizes[13]
    if not head.startswith(b"RES = ") or min(along) < 1 or math.prod(along) != cells:
        raise UnreadableFile(f"{path} is no restart file of MFIX: its header makes no sense")
    needed = 2048 + 8 * sum(along) + 4 * cells
    if os.path.getsize(path) < needed:
        raise UnreadableFile(f"{path} is cut short: it needs more than {needed} bytes, not {os.path.getsize(path)}")
    if not glob.glob(glob.escape(path[:-4]) + ".SP[1-9AB]"):
        raise UnreadableFile(f"{path} has no steps: files with its name that end with SP1 to SPB are needed beside it")


def _check_tag(path):
    """VTK takes the points that are there."""
    with open(path, "rb") as file:
        if not file.read().rstrip().endswith(b";"):
            raise UnreadableFile(f"{path} is no tag file, or cut short: it does not end with a semicolon")


def _check_tri(path):
    """VTK takes whatever bytes there are for triangles: of corners, each with a normal, in single precision."""
    size = os.path.getsize(path)
    if size % 72:
        raise UnreadableFile(f"{path} is no file of triangles, or cut short: its {size} bytes are not 72 a triangle")


def _check_dcm(path):
    if not os.path.isdir(path):
        raise UnreadableFile(f"{path} is a slice of a volume; give the folder that has all of them")


def _check_amrex(path):
    if not os.path.isdir(path):
        raise UnreadableFile(f"{path} is no plotfile of AMReX: that is a folder, with a file Header and a folder Level_0")


def _cube_header(path):
    """The number of atoms, and by axis, the origin first: how many samples, and the step from one to the next, in Bohr."""
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [line.split() for _, line in zip(range(6), file)]
    try:
        atoms, *axes = [(int(line[0]), np.array([float(word) for word in line[1:4]])) for line in lines[2:]]
        if len(axes) != 3 or any(step.size != 3 for _, step in (atoms, *axes)):
            raise ValueError(f"{len(lines)} lines")
    except (IndexError, ValueError) as error:
        raise UnreadableFile(f"{path} is no cube file: its header makes no sense at {error}") from error
    return atoms[0], atoms[1], axes


def _check_cube(path):
    atoms, _, axes = _cube_header(path)
    steps = np.array([step for _, step in axes])
    if atoms < 0:
        raise UnreadableFile(f"{path} holds several orbitals; a cube file of one volume is needed (cubegen's, say)")
    if np.any(steps[~np.eye(3, dtype=bool)] != 0) or np.any(np.diag(steps) <= 0):
        raise UnreadableFile(f"{path}: its axes are not along x, y and z; resample it to a vti first")
    needed = 6 + atoms + 1
    with open(path, encoding="utf-8", errors="replace") as file:
        found = sum(len(line.split()) for i, line in enumerate(file, 1) if i >= needed)
    if found < np.prod([count for count, _ in axes]):
        raise UnreadableFile(f"{path} is cut short: its header asks for more than the {found} values that follow it")


def _place_cube(path, volume):
    """VTK leaves out where the samples are."""
    _, origin, axes = _cube_header(path)
    volume.SetOrigin(origin)
    volume.SetSpacing([step[axis] for axis, (_, step) in enumerate(axes)])


def _check_sep(path):
    """VTK takes what it finds in memory for the part of a file that is missing."""
    with open(path, encoding="utf-8", errors="replace") as file:
        header = dict(re.findall(r'^\s*(\w+)\s*=\s*"?([^"\n]*)', file.read(), re.M))
    try:
        size = 8 if "double" in header["data_format"] else 4
        needed = size * math.prod(int(header.get(f"n{i}", 1)) for i in range(1, 9))
        data = os.path.join(os.path.dirname(path), header["in"].strip())
    except (KeyError, ValueError) as error:
        raise UnreadableFile(f"{path} is no header of SEP: it makes no sense at {error}") from error
    found = os.path.getsize(data) if os.path.exists(data) else 0
    if found < needed:
        raise UnreadableFile(f"{path}: its data, {data}, are cut short or missing: {found} bytes, not {needed}")


def _check_d3plot(path):
    """VTK leaves points where they were for the part of the last file that is missing: -999999 says where that ends."""
    last = path
    number = 1
    while os.path.exists(f"{path}{number:02d}"):
        last = f"{path}{number:02d}"
        number += 1
    ends = [struct.pack(order + kind, -999999) for order in "<>" for kind in "fd"]
    if not any(formats.names_in(last, ends)):
        raise UnreadableFile(f"{last} is cut short, or not of LS-DYNA: it does not have the number -999999 at its end")


def _check_vpc(path):
    """VTK takes what it finds in memory for the part of a file that is missing."""
    try:
        parts = list(_parts_of_vpc(path))
    except (IndexError, ValueError) as error:
        raise UnreadableFile(f"{path} is no file of VPIC: its header makes no sense at {error}") from error
    for name, size in parts:
        with open(name, "rb") as file:
            head = file.read(123)  # ends with how many places the part has along each axis
        needed = 123 + size * math.prod(map(int, np.frombuffer(head[-12:], "=i4"))) if len(head) == 123 else 123
        if os.path.getsize(name) < needed:
            raise UnreadableFile(f"{path} cannot be read: {name} is cut short: {os.path.getsize(name)} bytes, not {needed}")


def _parts_of_vpc(path):
    """The files of all steps, and how many bytes each has for a place."""
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [line.split() for line in file]
    for i, words in enumerate(lines):
        if words[:1] in (["FIELD_DATA_DIRECTORY"], ["SPECIES_DATA_DIRECTORY"]):
            folder = os.path.join(os.path.dirname(path), words[1])
        elif words[:1] in (["FIELD_DATA_VARIABLES"], ["HYDRO_DATA_VARIABLES"]):
            variables = lines[i + 1 : i + 1 + int(words[1])]
            size = sum(int(line[-3]) * int(line[-1]) for line in variables)  # components, and bytes of each
            for name in glob.iglob(os.path.join(glob.escape(folder), "T.*", "*")):
                yield name, size


# What VTK's readers do not notice.
_CHECKS = {
    "amrex": _check_amrex,
    "avm": _check_avm,
    "cube": _check_cube,
    "d3plot": _check_d3plot,
    "dcm": _check_dcm,
    "h": _check_sep,
    "mrc": _check_mrc,
    "pcd": _check_pcd,
    "ply": _check_ply,
    "res": _check_res,
    "stl": _check_stl,
    "tag": _check_tag,
    "tri": _check_tri,
    "vpc": _check_vpc,
    **dict.fromkeys(("e", "ex2", "exii", "exo", "mnc", "nc", "ncdf"), _check_netcdf),
}


def _points_or_volume(path, data):
    """What a reader of VTK's gave as vtkPolyData or vtkImageData."""
    if isinstance(data, (vtkImageData, vtkPolyData)):
        return data
    if isinstance(data, vtkRectilinearGrid):
        return _even_volume(path, data)
    if isinstance(data, vtkPointSet):
        return _points_of_grid(data)
    if isinstance(data, vtkUniformGridAMR):
        return _even_volume_of_levels(path, data)
    if isinstance(data, vtkCompositeDataSet):
        return _points_of_blocks(data)
    if isinstance(data, vtkMolecule):
        return _atoms(data)
    if isinstance(data, vtkHyperTreeGrid):
        return _points_of_tree(data)
    raise UnreadableFile(f"{path} holds neither points nor a volume but a {data.GetClassName() if data else 'nothing'}")


def _make_arrays_plain(cloud):
    """Some readers give arrays by component, which numpy would have VTK copy, and warn of it, each time."""
    points, data = cloud.GetPoints(), cloud.GetPointData()
    if points is not None and not points.GetData().HasStandardMemoryLayout():
        points.SetData(_plain(points.GetData()))
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        if array is not None and not array.HasStandardMemoryLayout():
            data.AddArray(_plain(array))  # in the place of the one of this name


def _plain(array):
    copy = vtkDataArray.CreateDataArray(array.GetDataType())
    copy.DeepCopy(array)
    copy.SetName(array.GetName())
    return copy


def _without_first_point(cloud):
    """VTK's reader of MPAS puts one before the others, in the middle of the earth."""
    data = cloud.GetPointData()
    arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))[1:] for i in range(data.GetNumberOfArrays())}
    return make_cloud(vtk_to_numpy(cloud.GetPoints().GetData())[1:], arrays=arrays)


def _even_volume(path, grid):
    """Of what cells have, where that is all, the places are their centres."""
    coordinates = [vtk_to_numpy(getattr(grid, f"Get{axis}Coordinates")()).astype(float) for axis in "XYZ"]
    data = grid.GetPointData()
    if data.GetNumberOfArrays() == 0:
        data = grid.GetCellData()
        coordinates = [(values[1:] + values[:-1]) / 2 if values.size > 1 else values for values in coordinates]
    steps = [np.diff(values) for values in coordinates]
    for axis, step in zip("xyz", steps):
        if step.size and not np.allclose(step, step.mean(), rtol=1e-4, atol=0):
            raise UnreadableFile(f"{path} is unevenly spaced along {axis}: resample it to a vti first (vtkResampleToImage)")
    volume = vtkImageData()
    volume.SetDimensions([values.size for values in coordinates])
    volume.SetOrigin(*(values[0] for values in coordinates))
    volume.SetSpacing(*(step.mean() if step.size else 1.0 for step in steps))
    volume.GetPointData().ShallowCopy(data)
    return volume


_MOST_SAMPLES = 2**24


def _even_volume_of_levels(path, levels):
    """Between the centres of the cells of each block, whose values they have, linear; nan outside of all blocks."""
    steps = []
    blocks = levels.NewIterator()
    while not blocks.IsDoneWithTraversal():
        steps.append(blocks.GetCurrentDataObject().GetSpacing())
        blocks.GoToNextItem()
    if not steps:
        raise UnreadableFile(f"{path} holds no blocks")
    at_points = vtkCellDataToPointData()
    at_points.SetInputDataObject(levels)
    bounds = [0.0] * 6
    levels.GetBounds(bounds)
    extent = np.array(bounds[1::2]) - bounds[::2]
    samples = 1 + np.rint(extent / np.min(steps, axis=0))
    samples = np.maximum(samples * min(1, (_MOST_SAMPLES / samples.prod()) ** (1 / 3)), 1).astype(int)
    even = vtkResampleToImage()
    even.SetInputConnection(at_points.GetOutputPort())
    even.SetUseInputBounds(True)
    even.SetSamplingDimensions(*map(int, samples))
    even.Update()
    volume = vtkImageData()
    volume.CopyStructure(even.GetOutput())
    data = even.GetOutput().GetPointData()
    is_outside = vtk_to_numpy(data.GetArray("vtkValidPointMask")) == 0
    for i in range(data.GetNumberOfArrays()):
        name = data.GetArrayName(i)
        if data.GetArray(i) is None or name in ("vtkValidPointMask", "vtkGhostType"):
            continue
        values = vtk_to_numpy(data.GetArray(i)).astype(float)
        values[is_outside] = np.nan
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        volume.GetPointData().AddArray(array)
    return volume


def _atoms(molecule):
    cloud = vtkPolyData()
    cloud.SetPoints(molecule.GetAtomicPositionArray())
    return cloud


def _points_of_tree(tree):
    grid = vtkHyperTreeGridToUnstructuredGrid()
    grid.SetInputData(tree)
    grid.Update()
    return _points_of_grid(grid.GetOutput())


def _points_of_grid(grid):
    if isinstance(grid, vtkRectilinearGrid):
        convert = vtkRectilinearGridToPointSet()
        convert.SetInputData(grid)
        convert.Update()
        grid = convert.GetOutput()
    cloud = vtkPolyData()
    cloud.SetPoints(grid.GetPoints())
    cloud.GetPointData().ShallowCopy(grid.GetPointData())
    return cloud


def _points_of_blocks(tree):
    append = vtkAppendPolyData()
    blocks = tree.NewIterator()
    while not blocks.IsDoneWithTraversal():
        block = blocks.GetCurrentDataObject()
        if isinstance(block, (vtkPointSet, vtkRectilinearGrid)) and block.GetNumberOfPoints() > 0:
            append.AddInputData(block if isinstance(block, vtkPolyData) else _points_of_grid(block))
        blocks.GoToNextItem()
    if append.GetNumberOfInputConnections(0) == 0:
        return vtkPolyData()
    append.Update()
    return append.GetOutput()


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
    values = _read_columns(path, (3, 6), "x y z, x y z nx ny nz or x y z r g b")
    others = values[:, 3:] if values.shape[1] > 3 else None
    if others is not None and np.nanmax(np.abs(others)) <= 1.001:  # some writers round up
        return make_cloud(values[:, :3], normals=others)
    return make_cloud(values[:, :3], colors=others)


def _read_pts(path):
    """By numpy: vtkPTSReader leaves out the last point."""
    columns = "x y z, x y z intensity, x y z r g b or x y z intensity r g b"
    values = _read_columns(path, (3, 4, 6, 7), columns, skipped=1)
    with open(path, encoding="utf-8") as file:
        first = file.readline().strip()
    if first != str(len(values)):
        raise UnreadableFile(f"{path} is no PTS, or cut short: its first line, {first!r}, is not {len(values)}, its points")
    arrays = {"intensity": values[:, 3]} if values.shape[1] in (4, 7) else {}
    return make_cloud(values[:, :3], colors=values[:, -3:] if values.shape[1] > 4 else None, arrays=arrays)


_TEXTS = {"xyz": _read_xyz, "pts": _read_pts}


def _read_columns(path, counts, columns, skipped=0):
    """The numbers of a text, of as many columns as one of `counts`; of 3 columns and no rows if there are none."""
    try:
        with open(path, encoding="utf-8") as file, warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # of an empty file, which is an error later
            lines = (line.replace(",", " ") for line in file)
            values = np.loadtxt(lines, comments=("#", "//"), ndmin=2, skiprows=skipped)
    except ValueError as error:  # UnicodeDecodeError among them
        raise UnreadableFile(f"{path} cannot be read as columns of numbers: {error}") from error
    if values.size == 0:
        return np.empty((0, 3))
    if values.shape[1] not in counts:
        raise UnreadableFile(f"{path} has {values.shape[1]} columns; {columns} are needed")
    return values

