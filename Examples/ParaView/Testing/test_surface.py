# SPDX-License-Identifier: BSD-3-Clause
"""The representation draws points as ParaView draws the mesh: outline, light, colours, opacity, transforms."""

import numpy as np
from paraview import simple

import scene

points, mesh = scene.sphere_points(), scene.sphere_mesh()
splats = simple.AlgebraicSplats(points, NumberOfNeighbors=32)
view = scene.view()


def draw(source, name, system=None, **properties):
    display = scene.show(source, view, system, **properties)
    levels = scene.picture(view, name)
    simple.Hide(source, view)
    return levels, display


truth, display = draw(mesh, "mesh")
types = list(display.GetProperty("Representation").Available)
assert "Point Surface" in types, types

# each system
pictures = {}
for system in ("Pull-Push", "Image-Space", "Direct", "Surface Splats"):
    pictures[system], _ = draw(points, "system-" + system, system)
    scene.assert_like(pictures[system], truth, system, iou=0.97)  # Direct widens outlines
pictures["Algebraic Splats"], _ = draw(splats, "system-Algebraic-Splats", "Algebraic Splats")
scene.assert_like(pictures["Algebraic Splats"], truth, "Algebraic Splats")
names = list(pictures)
for i, a in enumerate(names):
    for b in names[:i]:
        assert (pictures[a] != pictures[b]).any(), f"{a} and {b} are one"
scene.assert_baseline(pictures["Pull-Push"], "pull-push")

# Automatic is one of them, by the data
levels, _ = draw(points, "automatic-points", "Automatic")
assert (levels == pictures["Pull-Push"]).all()
levels, _ = draw(splats, "automatic-splats", "Automatic")
assert (levels == pictures["Algebraic Splats"]).all()

# as published, and back
levels, _ = draw(points, "published", "Pull-Push", PointSurfacePublished=1)
assert (levels != pictures["Pull-Push"]).any()
levels, _ = draw(points, "not-published", "Pull-Push", PointSurfacePublished=0)
assert (levels == pictures["Pull-Push"]).all()

# radii: a tenth of a good one leaves holes
levels, _ = draw(points, "radius-scale", "Pull-Push", PointSurfaceRadiusScale=0.1)
holes = scene.compare(levels, truth, "small radii")[2]
assert holes > 100
spacing = np.sqrt(4 * np.pi / 20000)
levels, _ = draw(points, "radius", "Pull-Push", PointSurfaceRadiusScale=1, PointSurfaceRadius=1.5 * spacing)
scene.assert_like(levels, truth, "one radius")
draw(points, "radius-estimated", "Pull-Push", PointSurfaceRadius=0)
radii = simple.Calculator(points, ResultArrayName="mine", Function="0.02 + 0.03*(height > 0)")
with_array, _ = draw(radii, "radius-array", "Pull-Push", PointSurfaceRadiusArray="mine",
                     PointSurfaceRadiusScale=1)
scene.assert_like(with_array, truth, "array of radii")
with_another, _ = draw(radii, "radius-array-small", "Pull-Push", PointSurfaceRadiusScale=0.1)
assert scene.compare(with_another, truth, "array of small radii")[2] > 100

# colours: a lookup table over an array, and interpolated scalars
table = simple.GetColorTransferFunction("height")
table.RGBPoints = [-1, 0, 0, 1, 0, 1, 1, 1, 1, 1, 0, 0]


def colored(source, array, name, system=None):
    display = scene.show(source, view, system)
    simple.ColorBy(display, ("POINTS", array))
    display.SetScalarBarVisibility(view, False)
    levels = scene.picture(view, name)
    simple.Hide(source, view)
    return levels


mesh_colors = colored(mesh, "height", "mesh-colors")
for system in ("Pull-Push", "Image-Space", "Direct"):
    levels = colored(points, "height", "colors-" + system, system)
    scene.assert_like(levels, mesh_colors, f"colours by {system}", iou=0.97, difference=5)
levels = colored(points, "height", "colors", "Pull-Push")
low, high = levels[260, 150], levels[45, 150]
assert low[2] > low[0] + 20 and high[0] > high[2] + 20, (low, high)

# opacity, over the background
half, _ = draw(points, "opacity", "Pull-Push", Opacity=0.5)
expected = (pictures["Pull-Push"] + scene.BACKGROUND) / 2
assert np.abs(half - expected).mean() < 1.0, np.abs(half - expected).mean()
draw(points, "opaque", "Pull-Push", Opacity=1)

# material: specular light makes a highlight, as on the mesh
shiny_mesh, _ = draw(mesh, "mesh-specular", Specular=0.8, SpecularPower=20)
shiny, _ = draw(points, "specular", "Pull-Push", Specular=0.8, SpecularPower=20)
scene.assert_like(shiny, shiny_mesh, "specular")
assert shiny.max() > pictures["Pull-Push"].max() + 5
for source, system in ((mesh, None), (points, "Pull-Push")):
    draw(source, "plain", system, Specular=0.0)

# transforms
moved_mesh, _ = draw(mesh, "mesh-moved", Scale=[1, 0.5, 0.7], Orientation=[0, 0, 30], Position=[0.1, 0.2, -0.1])
moved, _ = draw(points, "moved", "Pull-Push", Scale=[1, 0.5, 0.7], Orientation=[0, 0, 30], Position=[0.1, 0.2, -0.1])
scene.assert_like(moved, moved_mesh, "transformed")
for source, system in ((mesh, None), (points, "Pull-Push")):
    draw(source, "back", system, Scale=[1, 1, 1], Orientation=[0, 0, 0], Position=[0, 0, 0])

# an open sphere shows its back, and culled it does not
half_points = scene.sphere_points(top=0.2)
opened, _ = draw(half_points, "open", "Pull-Push")
culled, _ = draw(half_points, "culled", "Pull-Push", BackfaceRepresentation="Cull Backface")
assert scene.covered(culled).sum() < scene.covered(opened).sum() - 1000
blue_back, _ = draw(half_points, "backface", "Pull-Push", BackfaceRepresentation="Surface",
                    BackfaceDiffuseColor=[0, 0, 1], BackfaceAmbientColor=[0, 0, 1])
back = scene.covered(opened) & ~scene.covered(culled)
assert (blue_back[back][:, 2] > blue_back[back][:, 0]).mean() > 0.9

# depth: a plane through the middle hides half
plane = simple.Plane(Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0])
scene.show(plane, view)
through_mesh, _ = draw(mesh, "mesh-plane")
through, _ = draw(points, "plane", "Pull-Push")
assert np.abs(through - through_mesh).mean() < 2, np.abs(through - through_mesh).mean()
