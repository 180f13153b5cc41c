# SPDX-License-Identifier: BSD-3-Clause
"""The bone of the CT head (isovalue 300) and the dragon, drawn as points, are their meshes' pictures."""

from paraview import simple

import scene

head = scene.load("volumes/ct-head-promed0051.vti")
dragon = scene.load("clouds/dragon.vtp")
dragon_mesh = scene.load("meshes/dragon.vtp")


def look(view, source, position, up):
    """Lets the view show all of the source from a direction."""
    view.CameraParallelProjection = 0
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = position
    view.CameraViewUp = up
    simple.Show(source, view)
    simple.ResetCamera(view)
    simple.Hide(source, view)


def draw(view, source, title, system=None, **properties):
    scene.show(source, view, system, **properties)
    levels = scene.picture(view, title)
    simple.Hide(source, view)
    return levels


pictures = {}

# bone: points and mesh have the same vertices, and what they show is rough
view = scene.view(600, 600)
contour = ["POINTS", "scalars"]
points = simple.IsosurfacePoints(head, ContourBy=contour, Isosurfaces=[300])
mesh = simple.Contour(head, ContourBy=contour, Isosurfaces=[300])
points.UpdatePipeline()
look(view, points, [1, 2.2, 0.6], [0, 0, 1])
count = simple.servermanager.Fetch(points).GetNumberOfPoints()
print(count, "points of bone")
assert 0 <= 332154 - count < 1000  # the vertices of vtkFlyingEdges3D, less those that coincide
truth = draw(view, mesh, "bone-mesh", DiffuseColor=[0.93, 0.89, 0.8])
for system in ("Pull-Push", "Image-Space"):
    levels = draw(view, points, "bone-" + system, system, DiffuseColor=[0.93, 0.89, 0.8])
    iou, difference, _ = scene.compare(levels, truth, "bone, " + system)
    assert iou > 0.98 and difference < 10
    pictures["bone-" + system] = levels

view = scene.view(700, 500)
look(view, dragon_mesh, [0.3, 0.35, 1], [0, 1, 0])
truth = draw(view, dragon_mesh, "dragon-mesh")
levels = draw(view, dragon, "dragon", "Pull-Push")
iou, difference, _ = scene.compare(levels, truth, "dragon")
assert iou > 0.96 and difference < 10
pictures["dragon"] = levels
splats = simple.AlgebraicSplats(dragon)
levels = draw(view, splats, "dragon-splats", "Automatic")
iou, difference, _ = scene.compare(levels, truth, "dragon as splats")
assert iou > 0.96 and difference < 12

for title, levels in pictures.items():
    scene.assert_baseline(levels, title)
