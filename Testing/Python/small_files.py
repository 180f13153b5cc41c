# SPDX-License-Identifier: BSD-3-Clause
"""Small files of formats that VTK reads and does not write, by hand: the corners of a tetrahedron, or of a box."""

import json
import struct
import uuid
import zlib

import numpy as np

CORNERS = np.eye(4)[:, :3]  # of the tetrahedron, which has "height", 0 to 3, at them
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
BOX = np.stack(np.meshgrid([0, 1], [0, 2], [0, 3], indexing="ij")[::-1])  # corners of a box: x 0 and 3, y 0 and 2, z 0 and 1


def rows(pattern, values=CORNERS, first=1):
    return "".join(pattern.format(i, *row) for i, row in enumerate(values, first))


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
