# SPDX-License-Identifier: BSD-3-Clause
"""Tells what a file holds, and what a mapper would make of it."""

import json

from vtkmodules.vtkCommonDataModel import vtkImageData

from .options import add_json
from .readers import read


def add_arguments(parser):
    """The command's part of the command line."""
    parser.add_argument("file", help="volume, mesh or points")
    add_json(parser)


def run(arguments):
    """Prints the content. Raises UnreadableFile with a line for the user."""
    content = describe(read(arguments.file, tell=True))
    if arguments.json:
        print(json.dumps(content))
        return
    for name, value in content.items():
        if name != "arrays":
            print(f"{name:<12} {value if isinstance(value, (str, int)) else ' '.join(f'{number:g}' for number in value)}")
    for array in content["arrays"]:
        low, high = array["range"]
        print(f"array        {array['name']}: {array['type']} x {array['components']}, {low:g} to {high:g}")


def describe(data):
    """A dict of what is told of a vtkImageData or vtkPolyData."""
    arrays = data.GetPointData()
    content = {"kind": "volume" if isinstance(data, vtkImageData) else "points"}
    content["points"] = data.GetNumberOfPoints()
    content["bounds"] = data.GetBounds()
    if isinstance(data, vtkImageData):
        content["dimensions"] = data.GetDimensions()
        content["spacing"] = data.GetSpacing()
    else:
        content["polygons"] = data.GetNumberOfPolys() + data.GetNumberOfStrips()
        content["normals"] = "of the file" if arrays.GetNormals() else "none: a mapper estimates them"
        content["radii"] = "of the file" if arrays.GetArray("radius") else "none: a mapper estimates them"
    content["arrays"] = [
        {
            "name": array.GetName() or "",
            "type": array.GetDataTypeAsString(),
            "components": array.GetNumberOfComponents(),
            "range": array.GetRange(-1 if array.GetNumberOfComponents() > 1 else 0),
        }
        for array in (arrays.GetArray(i) for i in range(arrays.GetNumberOfArrays()))
        if array is not None
    ]
    return content
