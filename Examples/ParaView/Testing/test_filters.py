# SPDX-License-Identifier: BSD-3-Clause
"""The filters in ParaView: what they make, and that it is shown as a surface by itself."""

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import scene

ISOVALUES = [130.0, 200.0]
ARRAY = ["POINTS", "RTData"]


def values_of(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


# in the menu
for name in ("IsosurfacePoints", "PointSpacing", "AlgebraicSplats"):
    hints = simple.servermanager.ProxyManager().GetPrototypeProxy("filters", name).GetHints()
    assert hints.FindNestedElementByName("ShowInMenu").GetAttribute("category") == "Point Surface", name

# isosurfaces: the vertices of the mesh, in other order
wavelet = simple.Wavelet(WholeExtent=[-60, 60] * 3)
mesh = simple.Contour(wavelet, ContourBy=ARRAY, Isosurfaces=ISOVALUES)
points = simple.IsosurfacePoints(wavelet, ContourBy=ARRAY, Isosurfaces=ISOVALUES)
made, meant = simple.servermanager.Fetch(points), simple.servermanager.Fetch(mesh)
print(made.GetNumberOfPoints(), "points,", meant.GetNumberOfPoints(), "vertices")
assert made.GetNumberOfPoints() == meant.GetNumberOfPoints() > 1000
assert made.GetNumberOfCells() == 0
ours, theirs = (np.sort(vtk_to_numpy(data.GetPoints().GetData()).round(3), axis=0) for data in (made, meant))
assert np.abs(ours - theirs).max() < 2e-3
assert values_of(made, "radius").min() > 0

view = scene.view(300, 300, 75)
view.CameraPosition = [180, 120, 150]
display = simple.Show(points, view)
assert display.Representation == "Point Surface", display.Representation
display.ColorArrayName = ["POINTS", ""]
display.DiffuseColor = [0.9, 0.7, 0.4]
levels = scene.picture(view, "isosurface-points")
simple.Hide(points, view)
display = scene.show(mesh, view)
truth = scene.picture(view, "isosurface-mesh")
simple.Hide(mesh, view)
scene.assert_like(levels, truth, "isosurface", difference=6)
scene.assert_baseline(levels, "isosurface-points")

# radii: those that a grid of known spacing must have
plane = simple.Plane(XResolution=100, YResolution=100)  # spacing 0.01
spacing = simple.PointSpacing(plane, Scale=2.0, RadiusArrayName="size")
sizes = values_of(simple.servermanager.Fetch(spacing), "size")
print("radii, median and largest:", np.median(sizes), sizes.max())
assert abs(np.median(sizes) / 0.02 - 1) < 0.15
display = simple.Show(spacing, view)
assert display.Representation == "Point Surface"
assert "size" in display.GetProperty("PointSurfaceRadiusArray").Available
simple.Hide(spacing, view)

# splats: fewer than points, near to the sphere, drawn as such
sphere = scene.sphere_points()
splats = simple.AlgebraicSplats(sphere)
few = simple.servermanager.Fetch(splats)
print(few.GetNumberOfPoints(), "splats of 20000 points")
assert 100 < few.GetNumberOfPoints() < 10000
for name in ("SplatCoefficients", "SplatAxes", "SplatOrder", "radius"):
    assert few.GetPointData().HasArray(name), name
assert values_of(few, "Residual").max() < 1e-3
splats.Selection = "Fixed Count"
splats.NumberOfSplats = 500
splats.ComputeErrors = 1
splats.UpdatePipeline()
assert simple.servermanager.Fetch(splats).GetNumberOfPoints() == 500
second = splats[1].GetDataInformation()
assert second.GetNumberOfPoints() == 20000
assert "ApproximationError" in splats[1].PointData.keys()
assert simple.Show(splats, view).Representation == "Point Surface"
