# SPDX-License-Identifier: BSD-3-Clause
"""Scanners' files, which packages read that are not required."""

import contextlib
import os

import numpy as np

from .clouds import make_cloud
from .errors import UnreadableFile
from .progress import shown

_POINTS_A_STEP = 1_000_000


def read_las(path, show):
    """The points of a LAS or LAZ file: coordinates in double precision, "RGB", "intensity" and "classification".

    Raises UnreadableFile where the package laspy is missing (for LAZ one that decompresses, too), and what laspy raises.
    """
    try:
        import laspy
    except ImportError:
        raise UnreadableFile(f'{path} needs the package laspy: pip install "laspy[lazrs]"') from None
    if path.lower().endswith(".laz") and not any(backend.is_available() for backend in laspy.LazBackend):
        raise UnreadableFile(f'{path} is compressed, and laspy needs a package for that: pip install "laspy[lazrs]"')
    columns = {}
    with laspy.open(path) as file:
        names = set(file.header.point_format.dimension_names)
        kept = [name for name in ("red", "green", "blue", "intensity", "classification") if name in names]
        count = 0
        for chunk in file.chunk_iterator(_POINTS_A_STEP):
            for name in ("x", "y", "z", *kept):
                columns.setdefault(name, []).append(np.asarray(chunk[name]))
            count += len(chunk)
            show(count / file.header.point_count)
    if count != file.header.point_count:
        raise ValueError(f"its header tells of {file.header.point_count} points, and {count} are there")
    return _cloud({name: np.concatenate(parts) for name, parts in columns.items()}, "xyz", ("red", "green", "blue"))


def read_e57(path, show):
    """The points of all scans of an E57 file, each in its place: coordinates in double precision, "RGB", "intensity".

    Raises UnreadableFile where the package pye57 is missing, and what pye57 raises.
    """
    try:
        import pye57
    except ImportError:
        raise UnreadableFile(f"{path} needs the package pye57: pip install pye57") from None
    with contextlib.closing(pye57.E57(path)) as file:
        scans = []
        for i in range(file.scan_count):
            scans.append(file.read_scan(i, colors=True, intensity=True, ignore_missing_fields=True))
            show((i + 1) / file.scan_count)
    coordinates, colors = ("cartesianX", "cartesianY", "cartesianZ"), ("colorRed", "colorGreen", "colorBlue")
    kept = [name for name in (*coordinates, *colors, "intensity") if scans and all(name in scan for scan in scans)]
    return _cloud({name: np.concatenate([scan[name] for scan in scans]) for name in kept}, coordinates, colors)


READERS = {"las": read_las, "laz": read_las, "e57": read_e57}


def read(path, extension, tell):
    """The points of a file of one of READERS. Raises UnreadableFile with a line for the user.

    tell: show on standard error how far that is, where it takes over a second.
    """
    try:
        with shown(f"reading {path}") if tell else contextlib.nullcontext(lambda _: None) as show:
            return READERS[extension](os.fspath(path), show)
    except UnreadableFile:
        raise
    except Exception as error:  # whatever those packages raise of a broken file
        reason = next((line for line in str(error).splitlines() if line), type(error).__name__)
        raise UnreadableFile(f"{path} cannot be read: {reason}") from error


def _cloud(columns, coordinates, colors):
    """A vtkPolyData of columns by their names; what is neither a coordinate nor a colour is an array of its own."""
    if not columns:
        return make_cloud(())
    xyz = np.stack([columns.pop(name) for name in coordinates], axis=1)
    has_colors = all(name in columns for name in colors)
    rgb = _bytes(np.stack([columns.pop(name) for name in colors], axis=1)) if has_colors else None
    return make_cloud(xyz, colors=rgb, arrays=columns)


def _bytes(colors):
    """Colours of 16 bits as LAS is to have them, or of 8 as some writers leave them, as 8 bits."""
    return colors >> 8 if colors.max(initial=0) > 255 else colors
