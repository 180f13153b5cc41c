# SPDX-License-Identifier: BSD-3-Clause
"""Writes the points of a volume, mesh or cloud to a file: as they are, with normals, with radii, or as splats."""

import json

from . import vtkPointNormals, vtkPointSpacing
from .errors import WrongUse, complaints
from .methods import splat_filter
from .options import add_json, add_subject, positive, whole_number
from .progress import announce, followed
from .subjects import load
from .writers import check_writable, cloud_extension, write_cloud

CONTENTS = ("points", "normals", "radii", "splats")


def add_arguments(parser):
    """The command's part of the command line."""
    add_subject(parser)
    parser.add_argument("output", help="the file to write: .vtp (all arrays), .ply or .xyz (points and normals or colours)")
    parser.add_argument(
        "--to", choices=CONTENTS, default="points",
        help="points as they are (of a volume: its isosurface, with normals and radii); with normals or with radii, "
        "estimated where the file has none; or few polynomial splats. Default: %(default)s",
    )  # fmt: skip
    parser.add_argument(
        "--neighbors", type=whole_number(4), metavar="K",
        help="points that an estimate or a splat is made from; normals and radii of the file are then made anew",
    )  # fmt: skip
    parser.add_argument("--order", type=whole_number(1, 4), help="of splats; default: 3")
    parser.add_argument("--tolerance", type=positive, metavar="T", help="of splats: each of the lowest order that meets it")
    add_json(parser)


def run(arguments):
    """Writes the file. Raises WrongUse or OSError with a line for the user."""
    _check(arguments)
    subject = load(arguments.file, arguments.isovalue)
    if subject.remark:
        announce(subject.remark)
    cloud = _converted(subject.points, arguments)
    announce(f"writing {cloud.GetNumberOfPoints()} points to {arguments.output}")
    left_out = write_cloud(arguments.output, cloud)
    if left_out:
        announce(f"left out, for {arguments.output} cannot hold it: {', '.join(left_out)}")
    if arguments.json:
        data = cloud.GetPointData()
        arrays = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
        report = {"output": arguments.output, "points": cloud.GetNumberOfPoints(), "arrays": arrays, "left_out": left_out}
        print(json.dumps(report))


def _check(arguments):
    extension = cloud_extension(arguments.output)
    check_writable(arguments.output)
    if arguments.to in ("radii", "splats") and extension != "vtp":
        raise WrongUse(f"{arguments.output} cannot hold {arguments.to}; a file of the extension vtp can")
    for option in ("order", "tolerance"):
        if getattr(arguments, option) is not None and arguments.to != "splats":
            raise WrongUse(f"--{option} is of splats: it needs --to splats")
    if arguments.neighbors is not None and arguments.to == "points":
        raise WrongUse("--neighbors needs --to normals, --to radii or --to splats")


def _converted(cloud, arguments):
    data = cloud.GetPointData()
    if arguments.to == "normals" and (arguments.neighbors or data.GetNormals() is None):
        return _run(vtkPointNormals(), cloud, "estimating normals", arguments.neighbors)
    if arguments.to == "radii" and (arguments.neighbors or data.GetArray("radius") is None):
        return _run(vtkPointSpacing(), cloud, "estimating radii", arguments.neighbors)
    if arguments.to == "splats":
        splats = splat_filter(cloud)
        splats.SetOrder(arguments.order or splats.GetOrder())
        splats.SetTolerance(arguments.tolerance or splats.GetTolerance())
        return _run(splats, cloud, "fitting splats", arguments.neighbors)
    return cloud


def _run(filter_, cloud, what, neighbors):
    if neighbors:
        filter_.SetNumberOfNeighbors(neighbors)
    filter_.SetInputData(cloud)
    with complaints() as said, followed(filter_, what):
        filter_.Update()
    for text in said("Warning"):
        announce(text)
    if said("ERROR"):
        raise WrongUse(said("ERROR")[0])
    return filter_.GetOutput()
