# SPDX-License-Identifier: BSD-3-Clause
"""The render view with lines: those of a cloud are where those of its mesh are."""

import numpy as np
from paraview import simple

import scene

view = scene.view(kind="PointSurfaceRenderView", LineColor=[1, 0, 0])
view.UseFXAA = 0  # which softens lines: what is counted are those that are not
points, mesh = scene.sphere_points(), scene.sphere_mesh()


def lines(source, name, system=None):
    scene.show(source, view, system)
    levels = scene.picture(view, name)
    simple.Hide(source, view)
    return (levels[..., 0] > 200) & (levels[..., 1] < 60)


silhouettes = lines(points, "silhouettes", "Pull-Push")
of_mesh = lines(mesh, "silhouettes-mesh")
rows, columns = np.nonzero(silhouettes)
radius = np.hypot(rows - 149.5, columns - 149.5)
print(silhouettes.sum(), of_mesh.sum(), "pixels of line, at radii", radius.min(), "to", radius.max())
assert silhouettes.sum() > 670  # a circle of pixels that touch at corners at least has 4 sqrt(2) 120 = 679
assert abs(radius - 120).max() < 4
assert abs(silhouettes.sum() / of_mesh.sum() - 1) < 0.15
view.LineThickness = 6
assert lines(points, "silhouettes-thick", "Pull-Push").sum() > 2 * silhouettes.sum()
view.Lines = "None"
assert lines(points, "no-lines", "Pull-Push").sum() == 0
view.Lines, view.LineThickness = "Feature Lines", 2  # of which a sphere has none
view.UseFXAA = 1  # as ParaView has it by itself
assert lines(points, "no-feature-lines", "Pull-Push").sum() == 0
assert lines(mesh, "no-feature-lines-mesh").sum() == 0
plane = simple.Plane(Origin=[-1, 0, -1], Point1=[1, 0, -1], Point2=[-1, 0, 1])
scene.show(plane, view)
edge = lines(points, "feature-lines", "Pull-Push")  # where the sphere goes through the plane
print(edge.sum(), "pixels of line where a cloud goes through a mesh")
assert 400 < edge.sum() < 1200
