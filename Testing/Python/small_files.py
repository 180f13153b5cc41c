# SPDX-License-Identifier: BSD-3-Clause
"""Small files of formats that VTK reads and does not write, by hand: the corners of a tetrahedron, or of a box."""

import base64
import json
import struct
import uuid
import zlib

import numpy as np

CORNERS = np.eye(4)[:, :3]  # of the tetrahedron, which has "height", 0 to 3, at them
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
BOX = np.stack(np.meshgrid([0, 1], [0, 2], [0, 3], indexing="ij")[::-1])  # corners of a box: x 0 and 3, y 0 and 2, z 0 and 1

VALUES = np.arange(72).reshape(2, 3, 12)  # of the ramp, by z, y, x


def rows(pattern, values=CORNERS, first=1):
    return "".join(pattern.format(i, *row) for i, row in enumerate(values, first))


def unpack(content, path):
    path.write_bytes(zlib.decompress(base64.b64decode(content)))


def text(value, length):
    return value.encode().ljust(length, b"\0")


def ints(*values):
    return struct.pack(f"<{len(values)}i", *values)


def doubles(*values):
    return struct.pack(f"<{len(values)}d", *values)


def write_avmesh(path):
    """Version 2: a tetrahedron, and the patch that is its outside."""
    content = b"AVMESH" + ints(1, 2, 1) + text("", 128) + ints(2, 3, 4) + text("four", 4)
    content += text("four", 128) + text("unstruc", 128) + text("", 256) + doubles(1) + text("m", 128)
    content += doubles(*[1] * 4, *[0] * 3) + text("", 128) + ints(0) + text("", 128)  # lengths of reference
    content += ints(4, 4, 1, 3, 4, 4)  # nodes, faces, cells; the most nodes of a face and of a cell, and faces of a cell
    content += text("uniform", 32) + ints(1, 1)  # linear
    content += ints(1, 0, 1, 0, 0)  # patches; hexahedra, tetrahedra, prisms, pyramids
    content += ints(4, 4, 0, 0) + ints(*[0] * 5)  # triangles and quadrangles, at the border and in all; geometry
    content += text("outside", 32) + text("wall", 16) + ints(-1)
    content += CORNERS.astype("<f8").tobytes()
    path.write_bytes(content + b"".join(ints(*(i + 1 for i in face), -1) for face in FACES) + ints(1, 2, 3, 4))


def write_bts(path):
    content = b"ENGYS binary surface format".ljust(80) + ints(1) + text("four", 160)
    content += ints(4) + CORNERS.astype("<f4").tobytes()
    path.write_bytes(content + ints(4) + np.array(FACES, "<i4").tobytes())


def write_x3d(path):
    """Of Los Alamos: a cell of four faces, in columns of fixed widths."""
    sizes = {"process": 1, "numdim": 3, "materials": 1, "nodes": 4, "faces": 4, "elements": 1, "ghost_nodes": 0}
    sizes |= {"slaved_nodes": 0, "nodes_per_slave": 0, "nodes_per_face": 3, "faces_per_cell": 4}
    sizes |= {"node_data_fields": 1, "cell_data_fields": 2}

    def columns(*values):
        return "".join(f"{value:10d}" for value in values) + "\n"

    blocks = {"header": "".join(f"   {name:<23}{size:10d}\n" for name, size in sizes.items())}
    blocks |= dict.fromkeys(("matnames", "mateos", "matopc"), "            1   one\n")
    blocks["nodes"] = rows("{:10d} {:22.14E} {:22.14E} {:22.14E}\n")
    corners = [[j + 1 for j in face] for face in FACES]
    blocks["faces"] = "".join(columns(i, 3, *face, 1, 0, 0, *[1] * 5) for i, face in enumerate(corners, 1))
    blocks["cells"] = columns(1, 4, 1, 2, 3, 4)
    blocks |= {"slaved_nodes": None, "ghost_nodes": None}
    blocks["cell_data"] = f"matid\n{columns(1)}end_matid\npartelm\n{columns(1)}end_partelm\n"
    blocks["node_data"] = "velocity\n" + rows("{1:20.12E}{2:20.12E}{3:20.12E}\n") + "end_velocity\n"
    content = "x3dtoflag ascii\n"
    for name, rest in blocks.items():
        content += f"{name:<12}{0:10d}\nend_{name}\n" if rest is None else f"{name}\n{rest}end_{name}\n"
    path.write_text(content)


def write_motion(path):
    """A body in a file beside it, and how it moves."""
    facets = ""
    for face in FACES:
        corners = "".join(f"vertex {x:g} {y:g} {z:g}\n" for x, y, z in CORNERS[list(face)])
        facets += f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n"
    path.with_suffix(".stl").write_text(f"solid four\n{facets}endsolid four\n")
    motion = f'motion_type IMPOSE_VEL\nstl {path.stem}.stl\nimpose_vel "1 0 0"\ntstart_prescribe 0\ntend_prescribe 4\n'
    path.write_text(f"motions\n{{\nmotion\n{{\n{motion}}}\n}}\n")


def glb():
    binary = CORNERS.astype("<f4").tobytes() + np.array(FACES, "<u2").tobytes()
    places = {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]}
    header = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [places, {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in ((0, 48), (48, 24))],
        "buffers": [{"byteLength": len(binary)}],
    }
    content = json.dumps(header).encode()
    content += b" " * (-len(content) % 4)
    chunks = struct.pack("<I4s", len(content), b"JSON") + content + struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4s2I", b"glTF", 2, 12 + len(chunks)) + chunks


def write_b3dm(path):
    """Cesium's tile of a scene: a glTF behind a table of features."""
    features, scene = b'{"BATCH_LENGTH":0}  ', glb()
    path.write_bytes(struct.pack("<4s6I", b"b3dm", 1, 28 + len(features + scene), len(features), 0, 0, 0) + features + scene)


def write_omf(path):
    """Arrays, packed, and a tree of what they are."""
    content = b""

    def array(kind, values):
        nonlocal content
        packed = zlib.compress(np.asarray(values, "<f8").tobytes())
        content += packed
        start = 60 + len(content) - len(packed)
        return {"__class__": kind, "array": {"start": start, "length": len(packed), "dtype": "<f8"}}

    names = [str(uuid.UUID(int=i)) for i in range(6)]
    project, element, geometry, vertices, data, heights = names
    tree = {
        project: {"__class__": "Project", "name": "four", "origin": [0, 0, 0], "elements": [element]},
        element: {"__class__": "PointSetElement", "subtype": "point", "name": "four", "geometry": geometry, "data": [data]},
        geometry: {"__class__": "PointSetGeometry", "origin": [0, 0, 0], "vertices": vertices},
        vertices: array("Vector3Array", CORNERS),
        data: {"__class__": "ScalarData", "name": "height", "location": "vertices", "array": heights},
        heights: array("ScalarArray", range(4)),
    }
    head = b"\x84\x83\x82\x81" + text("OMF-v0.9.0", 32) + uuid.UUID(int=0).bytes + struct.pack("<Q", 60 + len(content))
    path.write_bytes(head + content + json.dumps(tree).encode())


def write_nek5000(path):
    """A header, and a step of one element of 2 x 2 x 2 nodes, with temperatures."""
    path.write_text(f"filetemplate: {path.stem}%01d.f%05d\nfirsttimestep: 1\nnumtimesteps: 1\n")
    head = b"#std 4  2  2  2          1          1  0.0000000000000E+00         0      0      1 XT".ljust(132)
    nodes = BOX.astype("<f4").tobytes() + np.arange(8, dtype="<f4").tobytes()
    path.with_name(f"{path.stem}0.f00001").write_bytes(head + struct.pack("<fi", 6.54321, 1) + nodes)


def write_wind(path):
    """A header, and a step in a folder. Heights of its places are those of the middles of layers."""
    values = np.arange(8, dtype="<f4").tobytes()
    (path.parent / "steps").mkdir()
    (path.parent / "steps" / "step.0").write_bytes(ints(len(values)) + values + ints(len(values)))
    path.write_text(
        "WIND_HEADER_VERSION 1\nGRID_SIZE_X 2\nGRID_SIZE_Y 2\nGRID_SIZE_Z 2\n"
        "GRID_DELTA_X 3\nGRID_DELTA_Y 2\nGRID_DELTA_Z 1\nUSE_TOPOGRAPHY_FILE 0\nCOMPRESSION 1\nFIT 0\n"
        "TIME_STEP_FIRST 0\nTIME_STEP_LAST 0\nTIME_STEP_DELTA 1\nUSE_TURBINE_FILE 0\n"
        'DATA_DIRECTORY steps\nDATA_BASE_FILENAME step.\nDATA_VARIABLES 1\n"height" SCALAR 1 FLOAT 4\n'
    )


def write_vpic(path):
    """A header, and a step in a folder, whose values have a layer around them."""
    folder = path.parent / "fields" / "T.0"
    folder.mkdir(parents=True)
    head = bytes((8, 2, 4, 4, 8)) + struct.pack("<HIfd", 0xCAFE, 0xDEADBEEF, 1, 1)  # sizes of types, and the order of bytes
    head += ints(0, 1, 0, 12, 3, 2) + struct.pack("<10f", 1, 1, 2, 3, 0, 0, 0, 1, 1, 0)
    head += ints(0, 1, 0, 0, 4, 3, 14, 5, 4)
    (folder / "fields.000000.0000").write_bytes(head + np.pad(VALUES, 1).astype("<f4").tobytes())
    axes = "".join(
        f"GRID_EXTENTS_{axis} 0 {count * step}\nGRID_DELTA_{axis} {step}\nGRID_TOPOLOGY_{axis} 1\n"
        for axis, count, step in (("X", 12, 1), ("Y", 3, 2), ("Z", 2, 3))
    )
    path.write_text(
        f"VPIC_HEADER_VERSION 1.0.0\nDATA_HEADER_SIZE 123\nGRID_DELTA_T 1\nGRID_CVAC 1\nGRID_EPS 1\n{axes}"
        "FIELD_DATA_DIRECTORY fields\nFIELD_DATA_BASE_FILENAME fields\n"
        'FIELD_DATA_VARIABLES 1\n"values" SCALAR 1 FLOATING_POINT 4\nNUM_OUTPUT_SPECIES 0\n'
    )


def write_fds(path, obstacles=""):
    """A room of 2 x 2 x 2 cells, and four devices in it, whose values are in a file beside it."""
    axes = "".join(f"TRN{axis}\n 0\n" + "".join(f" {i} {i}\n" for i in range(3)) + "\n" for axis in "XYZ")
    room = f"GRID room\n 2 2 2 0\n\nPDIM\n 0 2 0 2 0 2 0 0 0\n\n{axes}OBST\n{obstacles or ' 0'}\n\n"
    devices = rows("DEVICE\n d{} % TEMPERATURE\n {} {} {} 0 0 0 0 0 0\n\n")
    path.write_text(f"{room}CSVF\n devc\n {path.stem}_devc.csv\n\n{devices}")
    path.with_name(f"{path.stem}_devc.csv").write_text("s,C,C,C,C\nTime,d1,d2,d3,d4\n0,0,1,2,3\n")


def write_dyna(path):
    """Words of 32 bits: a header, the corners and a cell; in a file beside it a time, and where the corners are then."""
    header = np.zeros(64, "<i4")
    header[14] = np.array(960, "<f4").view("<i4")  # the version
    header[[15, 16, 20, 23, 24, 27]] = 4, 4, 1, 1, 1, 7  # 3 dimensions, 4 nodes that move, 1 solid of 1 material, its values
    end = struct.pack("<f", -999999)
    cell = ints(1, 2, 3, 4, 4, 4, 4, 4, 1)
    path.write_bytes(header.tobytes() + (CORNERS - 1).astype("<f4").tobytes() + cell + end + bytes(512))
    state = struct.pack("<f", 0) + CORNERS.astype("<f4").tobytes() + bytes(4 * 7)
    path.with_name(path.name + "01").write_bytes(state + end)


def write_pio(path):
    """A header, and a dump of one cell: words of 64 bits, and at the end what they are."""
    path.write_text(f"DUMP_BASE_NAME {path.stem}\n")
    sizes, lengths = np.zeros(50), np.zeros(40)
    sizes[42], sizes[[16, 17, 29]], lengths[[21, 22, 38]] = 3, 1, (3, 2, 1)  # dimensions; cells along each, their sizes
    name = np.frombuffer(b"none    " * 32, "<f8")
    fields = [("hist_size", [1]), ("global_numcell", [1]), ("cell_daughter", [0]), ("cell_level", [1])]
    fields += [("cell_center", [place]) for place in (1.5, 1, 0.5)] + [("cell_momentum", [1])] * 3
    fields += [("amhc_i", sizes), ("amhc_r8", lengths), ("controller_i", [0, 0]), ("controller_r8", [0, 0])]
    fields += [("l_eap_version", name[:2]), ("hist_usernm", name[:4]), ("hist_prbnm", name), ("mass", [1]), ("vcell", [1])]
    content = index = b""
    for i, (field, values) in enumerate(fields):
        part = i - 3 if field == "cell_center" else i - 6 if field == "cell_momentum" else 0
        index += field.ljust(32).encode() + doubles(part, len(values), 11 + len(content) // 8, 0)
        content += np.asarray(values, "<f8").tobytes()
    head = b"pio_file" + doubles(2, 4, 32, 11, 8) + b" " * 16 + doubles(len(fields), 11 + len(content) // 8, 0)
    path.with_name(f"{path.stem}-dmp000000").write_bytes(head + content + index)


def write_h5rage(path):
    path.write_text(f"HDF_BASE_NAME {path.stem}\n")
    unpack(H5RAGE, path.with_name(f"{path.stem}-h0001values000001"))


def write_amrex_particles(path):
    (path / "Level_0").mkdir(parents=True)
    (path / "Header").write_text("Version_Two_Dot_Zero_double\n3\n1\nheight\n0\n0\n4\n5\n0\n1\n0 4 0\n")
    (path / "Level_0" / "DATA_00000").write_bytes(np.column_stack([CORNERS, range(4)]).astype("<f8").tobytes())


def write_enzo_particles(path):
    path.with_suffix("").write_text("InitialCycleNumber = 0\nInitialTime = 0\nTopGridRank = 3\n")
    path.with_suffix(".boundary").write_text("")
    unpack(ENZO_PARTICLES, path.with_suffix(".grid"))
    path.write_text(
        "Grid = 1\nGridRank = 3\nGridDimension = 4 4 4\nGridStartIndex = 0 0 0\nGridEndIndex = 3 3 3\n"
        "GridLeftEdge = 0 0 0\nGridRightEdge = 1 1 1\nTime = 0\nNumberOfBaryonFields = 0\n"
        f"BaryonFileName = {path.stem}.grid\nNumberOfParticles = 4\nParticleFileName = {path.stem}.grid\n"
        "Pointer: Grid[1]->NextGridThisLevel = 0\nPointer: Grid[1]->NextGridNextLevel = 0\n"
    )


def write_netcdf(path, dimensions, variables, title=None):
    """The classic format: lengths by name; of each variable its dimensions' numbers, values (>f4, >f8, >i4), attributes.

    title: the attributes of the whole.
    """
    kinds = {">f4": 5, ">f8": 6, ">i4": 4}

    def named(name):
        return struct.pack(">i", len(name)) + name.encode() + b"\0" * (-len(name) % 4)

    def count(kind, items):
        return struct.pack(">2i", kind if items else 0, len(items))

    def listed(attributes):
        content = count(12, attributes)
        for key, value in attributes.items():
            is_text = isinstance(value, str)
            content += named(key) + (struct.pack(">i", 2) + named(value) if is_text else struct.pack(">3i", 4, 1, value))
        return content

    def header(offset):
        content = b"CDF\x01" + bytes(4) + count(10, dimensions)
        content += b"".join(named(name) + struct.pack(">i", length) for name, length in dimensions.items())
        content += listed(title or {}) + struct.pack(">2i", 11, len(variables))
        for name, (axes, values, attributes) in variables.items():
            content += named(name) + struct.pack(f">{len(axes) + 1}i", len(axes), *axes) + listed(attributes)
            content += struct.pack(">3i", kinds[values.dtype.str], values.nbytes, offset)
            offset += values.nbytes
        return content

    data = b"".join(values.tobytes() for _, values, _ in variables.values())
    path.write_bytes(header(len(header(0))) + data)


def write_slac(path):
    """A mesh of a tetrahedron, which is inside and at the border."""
    cell = np.array([[1, 0, 1, 2, 3, 6, 6, 6, 6]], ">i4")
    variables = {
        "coords": ((0, 1), CORNERS.astype(">f8"), {}),
        "tetrahedron_interior": ((2, 3), np.ascontiguousarray(cell[:, :5]), {}),
        "tetrahedron_exterior": ((2, 4), cell, {}),
    }
    write_netcdf(path, {"ncoord": 4, "three": 3, "cells": 1, "five": 5, "nine": 9}, variables)


def write_slac_particles(path):
    variables = {
        "particlePos": ((0, 1), np.concatenate([CORNERS, CORNERS], axis=1).astype(">f8"), {}),
        "particleInfo": ((0, 2), np.array([[i, 0] for i in range(4)], ">i4"), {}),
        "time": ((), np.array(0, ">f8"), {}),
    }
    write_netcdf(path, {"particles": 4, "six": 6, "two": 2}, variables)


def write_ugrid(path):
    """A mesh in the plane, as topologies of UGRID are of two dimensions, with heights."""
    mesh = {"cf_role": "mesh_topology", "topology_dimension": 2}
    mesh |= {"node_coordinates": "x y", "face_node_connectivity": "faces"}
    faces = np.array([[0, 2, 3], [1, 3, 2]], ">i4")
    variables = {
        "mesh": ((), np.array(2, ">i4"), mesh),
        "x": ((0,), CORNERS[:, 0].astype(">f8"), {}),
        "y": ((0,), CORNERS[:, 1].astype(">f8"), {}),
        "faces": ((1, 2), faces, {}),
        "height": ((0,), np.arange(4, dtype=">f8"), {"location": "node", "mesh": "mesh"}),
    }
    write_netcdf(path, {"nodes": 4, "faces": 2, "three": 3}, variables)


def write_mpas(path):
    """The cells' centres, with heights, and which of them meet."""
    axes = {f"{axis}Cell": ((0,), CORNERS[:, i].astype(">f8"), {}) for i, axis in enumerate("xyz")}
    meeting = (np.array(FACES) + 1).astype(">i4")
    variables = {**axes, "cellsOnVertex": ((1, 2), meeting, {}), "height": ((3, 0), np.arange(4.0).astype(">f8")[None], {})}
    dimensions = {"nCells": 4, "nVertices": 4, "vertexDegree": 3, "Time": 1, "nVertLevels": 1}
    write_netcdf(path, dimensions, variables, {"on_a_sphere": "YES"})


def write_cam(path):
    """Columns at the corners' places, on two levels, with heights, and beside it the file with the cell of them."""
    variables = {
        "time": ((0,), np.zeros(1, ">f8"), {}),
        "lev": ((1,), np.arange(2.0).astype(">f8"), {}),
        "lon": ((2,), CORNERS[:, 0].astype(">f8"), {}),
        "lat": ((2,), CORNERS[:, 1].astype(">f8"), {}),
        "height": ((0, 1, 2), np.arange(8.0).astype(">f8").reshape(1, 2, 4), {}),
    }
    write_netcdf(path, {"time": 1, "lev": 2, "ncol": 4}, variables)
    cell = np.array([[1], [3], [2], [4]], ">i4")
    write_netcdf(path.with_name("cells.nc"), {"four": 4, "ncells": 1}, {"element_corners": ((0, 1), cell, {})})


def write_mfix(path):
    """3 x 3 x 3 cells of 3 x 2 x 1, in records of 512 bytes, and a step."""

    def record(content=b""):
        return content.ljust(512, b"\0")

    sizes = [2, 2, 2, 1, 1, 1, 2, 2, 2, 3, 3, 3, 9, 27, 0]  # first, inner, last and all cells along each axis; in all; solids
    content = record(b"RES = 01.00") + 2 * record() + record(struct.pack(">15i4d", *sizes, 1, 3, 2, 1))
    content += b"".join(record(struct.pack(">3d", *[size] * 3)) for size in (3, 2, 1))
    content += record(b"".join(name.ljust(length) for name, length in ((b"", 120), (b"", 32), (b"CARTESIAN", 16))))
    path.write_bytes(content + 120 * record())  # boundaries: none
    step = record(struct.pack(">f", 0)) + record(struct.pack(">27f", *range(27)))
    path.with_suffix(".SP1").write_bytes(2 * record() + record(struct.pack(">2i", 6, 2)) + step)


def write_sep(path):
    axes = enumerate(((12, 1, "CDP"), (3, 2, "LINE"), (2, 3, "DEPTH"), (1, 1, "OFFSET")), 1)
    header = "".join(f'n{i}={count}\nd{i}={step}\no{i}=0\nlabel{i}="{name}"\n' for i, (count, step, name) in axes)
    path.write_text(f'{header}esize=4\ndata_format="native_float"\nendian="little"\nin={path.name}@\n')
    path.with_name(path.name + "@").write_bytes(VALUES.astype("<f4").tobytes())


def write_tileset(path):
    """Of a coarse tile, and a fine one in its place. What is up in glTF, y, is z in tiles."""
    write_b3dm(path.with_name("fine.b3dm"))
    box = {"boundingVolume": {"box": [0] * 12}}
    fine = {**box, "geometricError": 0, "content": {"uri": "fine.b3dm"}}
    root = {**box, "geometricError": 1, "content": {"uri": "absent.b3dm"}, "children": [fine]}
    path.write_text(json.dumps({"asset": {"version": "1.0"}, "geometricError": 2, "root": root}))


def write_tessellation(path):
    """VASP's: atoms, and the cell of each, here of all the same corners and faces."""
    corners = " ".join("({:g},{:g},{:g})".format(*corner) for corner in CORNERS)
    faces = " ".join("({},{},{})".format(*face) for face in FACES)
    atoms = "".join(f"{i}, ({x:g}, {y:g}, {z:g}), 1.0\n4, {corners}\n4, {faces}\n" for i, (x, y, z) in enumerate(CORNERS))
    lattice = "Rx1 = 1, Rx2 = 0, Rx3 = 0, Ry2 = 1, Ry3 = 0, Rz3 = 1\n"
    path.write_text(f"time = 0\n{lattice}Natoms = 4\nAtomic_Numbers =\n6,6,6,6\n{atoms}")


def write_molecule(path):
    path.write_text("4\nfour\n" + rows("C {1} {2} {3}\n"))


# In HDF5: values of the ramp, with its rows in y from the last one on; the corners, as ERF and CONVERGE have nodes, and as
# particles.
H5RAGE = """
eNrt1zFIw0AUgOG7pJUoCi0IFhHM4ODg0MGhg2ArrXQQLerg4FDBoYODQ4cqgkVEoog4Ojo6Ojp2dHR0dHR0dNM/yQuYqEUrlBbz6NfXXC6543qXXk/LxcWR
ofEh5YZlqYRKqY/xJpFKh4+D81XJWrIj+cYIyrV3LiPlabl/tN76aqnk1n6LRNBONuFnW8XxH6NcKlTcvCHH05LvjXC97a36lpsbcrwneT8yT7M/bFerpH+N
Do5zfjb9gqB5U/Kw5O/KTVaCe2XanlQJmdFjlho7lPNJZXnnDcPwGrBk5dCcJStAh3tY6+r3sLa8UtT0XDqjbLN9/eBp0ki2rxc8H5yB9vXs6I37ND7PK38E
tNah+fL3eWMPfj3jnb4aDzOynjofj8pgeGR7czy6F60CT1E84BFPeMYLXqEWlErAwjDylFVQxS6acHCJK1zjBre4K/htNOd5y/NCE9do4QmKOinYyLr3pI06
GjhAE0c4xgkcnOEcF25/UEQZS6hgHRvYRBXbqGEHKYwigwnYmMI0ZpDFLHKYW/h9/72Qet7HfPzrHUccccQRR7/tQ41P/2c63Xdtyr7L6ul91zsjJ3Ar
"""

ERF = """
eNrtWz1M20AUPucHAhSVtKiKSqtGtKIRrWiKGKhaARG4DWoLiDKwNQGMiBqSKDYItox0Y2RkZGRk7MjIyMiYkZGNOr67JO85TpyUUKq+D6HjOe/usP3d9979
5Gd85mNv9+NuVkIgwHysj1XjWiA3B235eUKUiij3RHnkkdcV67OQuB4U7WO/pUVVLXlfI8h+Lvy8DDDC/4i4GlsolcvCliw99UC/XFY3qvkY/8N+nfgb93J7
w++Ov8Uu4i/xt8LfiNRLP/TT8usbWnJNywt7NZvRjWTGYEhnoy77/TY3P1NisORd2AvbwTwmNKcDC51Cd7rc6cBlL+kA6UBFBySf9rtsOrCSzq7+wON+qsV+
uQ54yv2N34ftJoRdCEJ+RjqhH+Y76QDXgeUebu/0VusAc9QBAulAtQ7I8XbQi/kmxt0N9YvzgWgP7AfzmNCcDmAdbZQPnPRTPkA6UNEBGd8Pg9BvO5lPJVfS
mrT1Xd3QNs08IWOkjN28pm+lDZ3PFzLaqpHaThkpTa+M65BL/oYfiP+jn+IYofU4lui/jTjmK8+D4x9gPzlh70+Iea+4fvwU+p0L++oZGiePoF9E2PEQvM+r
IPTD4+dfjWP4fhvFscIAxTHSAfu8diPU3nmtwjoAf/sEf0+fcLvIKI4RWo9jkYHbnY/9CsF+ijLeDNA7qgcZt/DzuicyBMX8K2D+6Nn0tpb/nklu8lT6ofmg
fVXPez27la9Tz/zVG9SLiHo+Xm/XrX+H5W9m81aS7+TvFK9xHtMoXkefU7wmvbPvp4bC0M+UJ7Vaj9q1n3og+j0ZdMff8ZfEX+KvPd88H4R+0/PzizOzc7El
9WbyTRyvc2HYLuYxoTkdOHwh8qAhdzow9Yp0gHTAHscuhqCfrhnsJuMY1oGdF1AHMI8JzenAkTggczrsTgfib0gHSAfs+UBxuL3rT1gHChHYLuYxwUkHvDXX
8fajcL2l4fmqdzAOEEgHLF6MIB3IGKk1s8xrelt0YO811IFjYZ+N0DuqBxn/8fOqrMf5rRW5jMbPxPYF+DqZ3OGTz9tX1hU/v6ZImzNCURTgJ0uv2b9So12/
2WfpusfjUXiewdvxKpdvayvO/h3VWfMerPus3LM5Oibr12r989r9EQgEAoFAuE3I7wHIPPWiwReJZFYz/p6eHcxrcF4p9nE9CsonWU3ba+aPJc9geFK8iyk2
1sPGroWDc77JRrlHAv1HO3/5edRex8Pn8BrN309jvKR1PJq/V+vP8QT0W1KXFmOs/fvSUTGzWYi54++ZSvwl/tr5m4tBv3bvRwUmGWgf85jQnA6MT3N7WXWn
A+ezpAOkA/Z16B0V+rV7P6pvGraLeUxw0oHa58rDn7l9xdzpQOQr6QDpgD0fKMxCv9Qqa2s+EPqE9EXYiVl6R/Ug4z9+XpX9qC7r3LZm7OYy2bXy9zPx+W15
jta2j7WW2rR44bCPJdcLKvU6eL2cZp0Tb7T/Zd83498hdaqnuFzfsO+z4XWOZvfREqNwhEgU7gQPbOPpC42NVvAbWEQcxg==
"""

ENZO_PARTICLES = """
eNrr9HBx4+WS4mIAAQ4OBhYGAQZk8B8KCsRQ+TD5BCjNCKU7oPQKJpg4I1hOAiouCDUfXV1IkKsrSPV/NAB3CNRZHAyjYCQCD1fHABAdAeXD0tMJJlR17kWZ
KQYQYIicLh3ItJeRgRViBiOMD7GZkREiwAJVB6OZgfIgGUEFe2hadWAw4WYw+c8MkWcFioLkmZiYGCHpGWIeMyMsaSuguaBjUMUDrvwcAQ2ACjbi8rOHIGr5
MQpGZn7eAOUXQOkFwrROv/TKzwpDIj9DwAd7+qiDi0OLYw4HRmhUMCKV1aNgFIyCUTAKRsEooC0I9vN3AbXoYf1qAxbU/jx6u34U4AtHVoYAKD9ABL96WHgr
MONXB2s9fiAQ/hZQeoIQfnWw/laC6OAMR/q1zx2GUPsc2D9KLCrJTM5JjS/IL84syczPi6/AIV6JQ7wKVTwjNTM9owTBL6ksSB1S4yUJQ2S8hNTwEAArFeCA
iSkQCIcGaDgIoNk8YVCmYwAp6YJW
"""

FLASH_PARTICLES = """
eNrr9HBx4+WS4mIAAQ4OBhYGAQZk8B8KHnCg8mHyCVCaEUp3QOkVTDBxRrCcBFRcEGo+urqQIFdXkOr/aABmjwELhJZgGAUjEXi4OgaA6AhYeoDSJ5hQ1RUk
FpVkJuekKuQl5qYWMzCUFCUmpxYpwISLGdDSqwYBexkZ2CBqGWF8iA5GJogAC5p56HxmBg4wWxiadlmhfCYmiAEc0BTNzMjAgZqjIEAIKgxSvKqdO5uBoWJA
4yHYz9+FkYEJ5lgGBWb86mH5tYJ1NA2jpitWotIVLpoZGLIglYIK9tC4cGAw4WYw+Q+ND9zpLAEadQ1oLqoYjZQRCDJSM9MzShQwQEF+cYWCAlbxShziVdjE
UW37YI/dFejiGOoc8OvjcMDlPwCvfFXY
"""

CONVERGE = """
eNrtWr1v01AQf7YTcEuRUqiaKAiwioCCCmTokK1141diKbGj2KkSFpeNoUM32OgYto5ZGBiQIgbEX4AYOyFGJsTYsWJiosT2ndP31Djpp+rm/aT2fPY5Lznf
x++d/K5srF6fzE8SH6pKUiRDDmIf0C2wOl5fBymBbIPsynheCa7l4HwGPl9T2PvdOqW+9T4HXGf5SihzRGAcUaZ6zZdN0OdB7sis3YrdsAy9blIn1J1eYOlV
r1Dg4rQw4rrTEK98XE+RZfi8KTJDVGI33FrD9VyzSsP7tKXe2SByyeI1srivsOuT6PtITH7gel2w30mPlh+djMgPkR/9/CiC3E0fmh8tz9Krfo5YjapHK7RK
LddhrpuGczBetQHrOpZtSESGWCdki4tzPo6j+Jxh7eZBL8+O5/OTSDr0hYR66ClJkhg/oVR6HvePb/b++a5Ngy7LcmCiwv2K1IFHwwUC6Vxof7x+ubHRIyPh
D3Zp1Q/uraXwj0f8OT8AffIwEVTtEDLnUQWkDMd4n6//gyo7SAoICAgICAicFkJeqUT7vL0b8fbIP9tX4+2Qf/6eFrzycF6ZCY4zPYemDjD/wfzyPbg+xa28
Pab++JAwfxw+f+D3Y8PmD9v5o81VBC73/AHz5xW3n1/T66a+UqE4fyjRSsUrUculdc/QXT2yo3WXNr2SbdcN09JdnOeVbMuiJddcM93W2e6bPyZy3zwon/9m
of/lR8vnn7fYviow3vmM8VTMs3ZB/mJSO/08Wz4R70tF6xXusPnbBP2NBt8T5z2PWbsu6DsLbBz/yLJ2fF5g/yrfY+02Qd++nyT+LEW/+9usiOnz4Yu54Hha
uxvxxaxKsm8JGcIbPw3gje1E9Bc+L4f1lz1N9BfRX/r9Bd866GisHYz+o/wqn3Jd1G6LZ3EWdRGrWOrEdfGzykZIsuoizxuG1UX1Acu3BMa7LmI5/MLxTrze
AvmC4yHFY9VFJaqLxbl4e8zG2sN4O4zj9XlRF0+3Ln5NSF08L398vxT+SBN26nT0+fMv8MMMt3Ky5s/8/n3o+6FPRN8UfbPfF3H+tLvA2tXsSuu5bXn26qpD
3b7u2l44csa5VjhnpobnT7icqK/mBvRNnBt1nsV/T+yvm49G65vtp6Jv+sA3t6aOXRf/gOsLCamL8f5QuXg6uj/mJliGebH98R/ljTXm
"""

# Fluent's case of a tetrahedron: zones of its nodes, cell and faces.
FLUENT = """
eNrtXL1zGkcUvzvAIBmPZHlGllSRrwljOxOUKGNsZyIcSzaayDaOSEISZQKBk2EGcUwOT3AqlWQmhYoUKlK4SKEuKvUnUKqkTOlSJZ3CsbvHveW+BELDx3sea3l3
b9nj3W/fvt+7jz/ia4+vTS9NC5oEAoJXmBWMckYl/AvU2f40bUXa1mh7KLHtYnvfAt1+nX4/b5f8en1dsz7jhI3zn4+0AQFlEiW+/jChtSmqh2hbl6CdKlcqhdJL
lem7spqX1Q4+o+cc1wq/cQ/R8z4jfgVL/KIgfo34ZXGs5uPxRiRxQeNuPXu+JgqSjt+wnxuH6uUpeFwhD7Tj8T5pYhUHeP85rWOHQVzHMA504gDLtvanoN0yFw/i
feN3CuB3lo58eo3oDdEdfmtziF/Eb3celghCu5KS09IuISsXi1q7k8m29V7zMLKOiTru3k7B+TFLGIwQCeI5shO2bvH+CtIzIgpXW58D7fP3fGenlU534hTxfQz4
nbWd/tN6/0fKq1JFsO/vFczH13DTz/hafzfjixbja3jtZ3ytf2+/n/TPFXblklpQSqx/gNmGQH+PQ35yOkP7z7mL7/vzGN8xvnfH98gctPtdKclJpawUlZevNT2r
KL/m1H7ju0fPh44+gPOrQfXmh6RlOG/cgnahz0gbuwtxXJ+Bdvy8GB+e4jHN8xo3Ia90igPRdzAOYBzoxIEIw8U8tNstlDZyWpuptttCjmzn1y8278LnrFc078H+
9Q2a/30F8XlyA9o1qb4wP9l5Hu+HID2TouAnedoPrUCuOuc3ouAjn0WmkzMkiqKpvRbJRZO8x9fStO2SJInk/JHv8YjRRfOIsz+kcRbmbyLIxWArGfZJFv09Bhvj
ZybKq4payMl08Vq1P7je93voP/ZzJHqoEj1U9lO8dLuX6iL3HwUFBQUFZSyF5KlenR+/ed/enuWz++/Z2zH+u/euvR3LksILo85XB51XxkYsr+zRH1x90Nof8UWY
eY6pP1zjY3PE8GFe5+XrY071nchtrO9gfadT32F4WuAKNHydl82zWM/4Na9PVu8Q3W19svER4hfxKwhHAsRNecU+TvLXB6zwePAAfi/M+zrXocthuP4cUP34Fp4j
O2Hng/fX8NYnkyOVJxCcXtHr9olP7O1ZPE9/am/H+E5s2R3fiUTc8Z3Qx+74Tv3OuOWf28hPgD9yyE+AP/KID+CP8mTgw7U/KiPlDyZurxtr93ElX5dl1i+bLxRz
Wk6wkQN+Sw/oOJ14SOI+8hDkId33SaTv2vNo/f5Y2iG7DONA2BUuJUtcNj+HeVj5CTw+lMnix3tsVXhkz4/5+2us+HHiBdFTprzDcF3ke4jrOtXf/ghxPvsztItS
PZWBOA7dh3bHz2g9KMHF4ducHZ2PjXujxY/54x5eflwdQX7s0+s7sTV3vDcdc8ej9760tyuz73vsjkcnVocTp4PH1R7yH+CPGvJj4I8/ER/AH38hPwb+OBhrftzm
FQZ+rD13ZMeX1Xwmp/zW2bBTzLRfllDK7MpGP0eG5vz9jXgG/niD/gD++Gek/MHyTnbdI/aFvb3+vOsDe7sq4zkOD4qzOlli3d6Ozf/yw3HJOwl+brT++G3xdEjx
5OdGPBjq9cKpTll+inVKrAd1v3cisAntLv69E35unpKKj0imHXj+xUz3tOalZnk9tKrzgZWrwsoZNbCex/8uwojH10+utOsnLM9yfr6b60fzMqfnuvkZx98/kt5E
bA4i3uWTGO8w3nXHu2ZisPFOr9tydemu92NsydlKi8aphuOzr996TevwR98QveZyXsS/g/5Amex5oeMpCe1K9AIlu07Z732//Lp3+ALi+4Tqp1t4jtzEF95fl53X
OPEvb1c+1+H1kiECWedvM0vmK/gw83pJP9rot/b2+nvfUojp8/D6oI5bDleC23rRzSVY4Rj2+pn59ff0NtFTLtf9+k+YD+O6b8L/ty8nH+bv++g/H/b3tv64jhNP
lswy5cuvH4R6yq+OtxHzFxlvTzJm8Rbf943iLt6yeVnN8HgjclHv+2bxlr9/rtd4y+R/0C+EQQ==
"""

# Truchas': a tetrahedron, with "height", 0 to 3, at its nodes.
TRUCHAS = """
eNrtWjtvGkEQ3gUMJ+JIIDuK87B8keMElFhyJBd0hvgOHQrGKBDJ7kDxKZzEQzKXyOkoUjgdZcqULl26TOkyPyGlS0p35I6bBXbN82IUWcwnodHsDnvH7sy3M8t+
15Tk/eDjILEhScRHQqQfbcDBJq+z/gJICvIU5JmHtdNO3wq0h2F80S7/XlVt67aA7ouEOIGYM2hqImvLA9BlkJce3m5Pr5f0OiE5o/K5XDSNWrXO+WdsyudSsuB8
lzI94kiP0+ADOy9IUfdanm9bhuUdInVa4mT7Htlug8GC1Wr3ezzOgBJEipeCeTfCGE7+6zoMi+cD+OEn/sniubTkSAldG+O5j9d/+Hk7RU0mPqTz3fjVZuS/WtjR
VwKD34/xRizAj5epHRXL8m6tdnxkVIumXod2taxX9Kpp9VSr+kfT+GKYX/t5SJ7y/aSHjh55NNruJ/T/ejLNrLR2ZtVP4eMBTvQJHzp8rDgwRByjBYFAIBCI20Uu
s69Qa3dmefiWj6/nxbye5WnNAG8n5ifzhnH1zvky1jsYZ92inrT8fPyI9QdiNF+x+un6wWh7Nt+yF+eOr8tGn2tRYf5E3WvtBHZbSGJnXs6KDD/PKkiDK9/GneDv
2FPk73nGsPMqTch39hKpDMfrM/bLuIx+iX7Z88sIyD/C+V9OPzb0uqwUzWJHz9Sqm/W+NuavWy7zmQuhHnB3DjmP+/Dgc9yzVUe/XJuMB7TnyAPIAz0eYP50tTaQ
B94QIa+L/2M+zp53/YIfV34J40d5/2ys8naiv88fD3g5HggBDzQ34Bxmwnwg9Bp5AHngZp7aWuftSrrxqWTeXp4q5gOnz/j4Pgf99zqu0Siw/V+cr0X4B9qu25et
WTaNit6xH3KvhI6t9x2moZSv96nr+r4BS+8Tnty8U3mXuF+N49uLKPIt8u1Nvi1Eebu36f3ddyllZnx7tYFr4Y4H/CN5kbFZ716f2/t83waefy5CxU1J0LKVSDKl
ppX8YVaF/iXK35Oxlh26sjOZD9GvyCv0ETf4C+0pG30=
"""

# Vera's: an assembly of 5 x 5 pins, of 3 levels of 3, with volumes of 0 to 74, x fastest, and ten times these as powers.
VERA = """
eNrtmMtPE1EUh++0hTQ1JkUxqcTFxBDTGGOKouKTQSgWUUBoTI2JpWpVFGhtBYovxhfijqVLli75E7pk6dIlS5f8B9j2frdyJynFupBKz+bruefM/Z37mpnOl0hf
/35fm08UzesVHuEXW20T+9Gm+yo+Dg24BL+5VLtRigVob6F/Z150NBwuZm86rFyIX0PD9phFwj0jRcbwTbjm0vN6h0fDRY5Fe6LheCgU6tD3Z9cf6hqiSV5rKF/u
ZMOQDR7yFN2FeDHSYnYLb6nFEp37ROemW8abCq3FuMvlKnXgpT+3QXp5ZMJxonaHVTrPMSYg17yz8xxpqW09GvZ/nucI/Nqs5yVyE4nJ+FQy+0T6D1KZZHwqkVbx
kp+dn1J+emI6PpuanClcoZ17f8XzHJSUx7GcX4nuQk/F336vOvNmlXNtevU7hDJ7F66K15IMwKOWsWXsv+088QHYCq9I2oP47fg9+EPwJOyTtEbwO8nvh7do3+iW
vED7gKPObngDHoNXyVe6IXx0baV7Bl6TzCtdAS/C6/AItOhH6Qbx0RXDsAOG6V/pniUfXTFq6etwibjSNfHRFTfhcdhLXOmewkdXqHGdgxHmX+n64WU4WN4Hkqyj
rXRP4KMr1LhOQ9bRUrpd5KNrK12HWSmuW9D3WT4jGXpH+x3J9Rni7+F94vOSIx/xJyTN11z3Sd+nVpr2BX2/jmepF137LpyV9H8g/6HkCror6FpPqQvd0KK+39fR
tWzHvn8h+V2N9x71z1EXulYSvpTcQNd+Rt4b/EXHOX0uuYyuiFI3uibzaY1TP7qr6NqPqB9di/nMT9LfW+pf1M+7yTquq/He5nrWMY2unaD+HNczrvxj4q+oX63j
NPWja362Gk/ahjWsso0NDfcZwqX+fIiQR3/fcb7Xq/eo/CE97ye+N7CX59FTnkfTvX2+mqaN5u3zgnD5wPZ56n/UysH6nsdq/7f//n28vcL7+HKdzIf8p2R4DMYp
NLod81MtXvv3iiDzGHN8gYntsv1R6/hsH3e0uvwe47wfV/seYwf0+1LD9vb3GPXcCTo2RDKXTmVnMsmt31vSqblkJqufu1CN7x+rrTt7bq4dbqxZfTwnlnz/4jnx
C7ZaDf8=
"""
