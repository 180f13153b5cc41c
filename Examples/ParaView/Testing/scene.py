# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the plugin share: the unit sphere as points and as a mesh, views, pictures, and their comparison.

The truth is what ParaView itself draws of the mesh.
"""

import os
import struct
import sys
import zlib
from xml.etree import ElementTree

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

OUTPUT = os.environ["POINTSURFACE_TEST_OUTPUT"]
BASELINES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "Baseline")
BACKGROUND = 51  # grey level

simple._DisableFirstRenderCameraReset()
simple.LoadPlugin(os.environ["POINTSURFACE_PLUGIN"], ns=vars(simple))

POINTS = """
import numpy as np
i = np.arange({count}) + 0.5
z = 1 - 2 * i / {count}
angle = np.pi * (1 + 5 ** 0.5) * i
r = np.sqrt(1 - z * z)
normals = np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=-1)[z <= {top}]
output.Points = normals + {center}
output.PointData.append(normals, "Normals")
output.VTKObject.GetPointData().SetActiveNormals("Normals")
output.PointData.append(normals[:, 2].copy(), "height")
"""


def sphere_points(count=20000, center=(0, 0, 0), top=1):
    """Even points on a sphere of radius 1, without cells, with normals and the array height, their z; up to top."""
    source = simple.ProgrammableSource(OutputDataSetType="vtkPolyData",
                                       Script=POINTS.format(count=count, center=list(center), top=top))
    source.UpdatePipeline()
    return source


def sphere_mesh(center=(0, 0, 0)):
    sphere = simple.Sphere(Center=center, Radius=1, ThetaResolution=256, PhiResolution=128)
    mesh = simple.Calculator(sphere, ResultArrayName="height", Function=f"coordsZ - ({center[2]})")
    mesh.UpdatePipeline()
    return mesh


def view(width=300, height=300, scale=1.25, kind="RenderView", **properties):
    """A view in parallel projection, from the side, half of the height being scale."""
    return simple.CreateView(kind, ViewSize=[width, height], OrientationAxesVisibility=0, UseColorPaletteForBackground=0,
                             Background=[BACKGROUND / 255] * 3, CameraPosition=[6, 4, 5], CameraFocalPoint=[0, 0, 0],
                             CameraViewUp=[0, 0, 1], CameraParallelProjection=1, CameraParallelScale=scale,
                             **properties)


def show(source, where, system=None, **properties):
    """Shows it as points, or as ParaView's own surface where no system is named."""
    display = simple.Show(source, where)
    display.Representation = "Point Surface" if system else "Surface"
    if system:
        display.PointSurfaceSystem = system
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = [0.9, 0.7, 0.4]
    for name, value in properties.items():
        setattr(display, name, value)
    return display


def picture(where, name):
    """What the view draws, rows from the top, as grey levels of red, green and blue; kept as name.png."""
    return read(save(where, name))


def interactive(where, name):
    """The same of what it shows while it is turned."""
    return read(save_interactive(where, name))


def save(where, name):
    """Keeps what the view draws as name.png, which the first rank writes; returns the path."""
    path = os.path.join(OUTPUT, name + ".png")
    simple.Render(where)
    simple.SaveScreenshot(path, where, ImageResolution=where.ViewSize)
    return path


def save_interactive(where, name):
    """The same of what it shows while it is turned, which each rank writes."""
    where.SMProxy.InteractiveRender()
    grab = vtkWindowToImageFilter()
    grab.SetInput(where.GetClientSideObject().GetRenderWindow())
    grab.ShouldRerenderOff()
    writer = vtkPNGWriter()
    writer.SetFileName(os.path.join(OUTPUT, name + ".png"))
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()
    return writer.GetFileName()


def read(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    levels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return levels.reshape(height, width, -1)[::-1, :, :3].astype(float)


def covered(levels):
    return (np.abs(levels - BACKGROUND) > 2).any(axis=-1)


def compare(levels, truth, name):
    """Intersection over union of what is covered; the mean difference of grey levels within both; holes."""
    a, b = covered(levels), covered(truth)
    both = a & b
    iou = both.sum() / (a | b).sum()
    difference = np.abs(levels - truth)[both].mean()
    inside = b.copy()
    for axis in (0, 1):  # pixels whose neighbours within 3 are all covered
        inside = np.all([np.roll(inside, k, axis) for k in range(-3, 4)], axis=0)
    holes = int((inside & ~a).sum())
    print(f"{name}: IoU {iou:.4f}, difference {difference:.2f} grey levels, {holes} holes of {b.sum()} pixels")
    return iou, difference, holes


def compare_with_one_rank(levels, name, ranks, label):
    """What differs by several ranks from the picture that one has kept of `name`: the mean difference of grey levels, of which
    a seam with no exchange makes 0.01 to 0.03 on the sphere; how many pixels are left out. A row of the table in Parallel.md."""
    serial = read(os.path.join(OUTPUT, f"parallel-1-{name}.png"))
    ours, theirs = covered(levels), covered(serial)
    difference = np.abs(levels - serial)[ours | theirs].mean()
    unfilled, more = (theirs & ~ours).sum(), (ours & ~theirs).sum()
    print(f"| {label} | {ranks} | {difference:.3f} | {unfilled} | {more} | {theirs.sum()} |", flush=True)
    return difference, unfilled


def assert_like(levels, truth, name, iou=0.98, difference=4.0):
    """That a picture is that of the mesh."""
    measured = compare(levels, truth, name)
    assert measured[0] >= iou, f"{name}: outlines differ"
    assert measured[1] <= difference, f"{name}: shades differ"
    assert measured[2] == 0, f"{name}: holes"


def assert_baseline(levels, name, threshold=0.5):
    """That a picture is that in Baseline/; without one it fails and leaves its picture, as name.png in the output."""
    path = os.path.join(BASELINES, name + ".png")
    assert os.path.exists(path), f"no baseline {path}"
    difference = np.abs(levels - read(path)).mean()
    print(f"{name}: difference from the baseline {difference:.3f} grey levels")
    assert difference <= threshold, f"{name} differs from its baseline by {difference:.3f} grey levels"


def load(path):
    """A shared model as a source; the test is skipped where the models are not at hand.

    Read by hand: with the libexpat1 of Debian 12's updates, ParaView 5.11 reads no raw data appended to XML.
    """
    path = os.path.join("/src/shared/data", path)
    if not os.path.exists(path):
        print(f"skipped: {path} is not here")
        sys.exit(77)
    with open(path, "rb") as file:
        head, rest = file.read().split(b"<AppendedData", 1)
    raw = rest[rest.index(b"_") + 1:]
    root = ElementTree.fromstring(head + b"</VTKFile>")
    piece = root.find(".//Piece")
    arrays = {}
    for element in root.iter("DataArray"):
        components = int(element.get("NumberOfComponents", 1))
        values = np.frombuffer(decode(raw, int(element.get("offset"))), element.get("type").lower())
        arrays[element.get("Name")] = values.reshape(-1, components) if components > 1 else values
    if root.get("type") == "ImageData":
        image = root.find("ImageData")
        data = vtkImageData()
        data.SetExtent([int(value) for value in piece.get("Extent").split()])
        data.SetOrigin([float(value) for value in image.get("Origin").split()])
        data.SetSpacing([float(value) for value in image.get("Spacing").split()])
        names = list(arrays)
    else:
        data = vtkPolyData()
        data.SetPoints(vtkPoints())
        data.GetPoints().SetData(numpy_to_vtk(arrays["Points"], deep=True))
        if int(piece.get("NumberOfPolys")):
            triangles = arrays["connectivity"].reshape(-1, 3)
            cells = np.insert(triangles, 0, 3, axis=1).astype(np.int64)
            data.SetPolys(vtkCellArray())
            data.GetPolys().ImportLegacyFormat(numpy_to_vtkIdTypeArray(cells.ravel(), deep=True))
        names = [name for name in ("Normals", "radius") if name in arrays]
    for name in names:
        array = numpy_to_vtk(arrays[name], deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    data.GetPointData().SetActiveScalars(names[0] if root.get("type") == "ImageData" else None)
    data.GetPointData().SetActiveNormals("Normals")
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def decode(raw, offset):
    """The bytes of an array: blocks compressed by zlib, after their number, their sizes and the size of each."""
    count = struct.unpack_from("<I", raw, offset)[0]
    sizes = struct.unpack_from(f"<{count}I", raw, offset + 12)
    start = offset + 12 + 4 * count
    blocks = []
    for size in sizes:
        blocks.append(zlib.decompress(raw[start:start + size]))
        start += size
    return b"".join(blocks)
