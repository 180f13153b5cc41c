# SPDX-License-Identifier: BSD-3-Clause
"""Selecting in the view gives points, by their ids, that lie where the surface was selected."""

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import scene

CAMERA = np.array([6.0, 4.0, 5.0])


def leaves(data):
    if data.IsA("vtkDataSet"):
        yield data
        return
    leaf = data.NewIterator()
    while not leaf.IsDoneWithTraversal():
        yield leaf.GetCurrentDataObject()
        leaf.GoToNextItem()


def selected(source):
    """Positions of the selected points, and their ids."""
    extract = simple.ExtractSelection(source)
    extract.UpdatePipeline()
    data = simple.servermanager.Fetch(extract)
    blocks = list(leaves(data))
    positions = [vtk_to_numpy(block.GetPoints().GetData()) for block in blocks if block.GetNumberOfPoints()]
    ids = [vtk_to_numpy(block.GetPointData().GetArray("vtkOriginalPointIds")) for block in blocks
           if block.GetNumberOfPoints()]
    return positions, ids


def on_screen(positions):
    """Pixels, from the centre of the view, to the right and up: 120 a unit."""
    forward = -CAMERA / np.linalg.norm(CAMERA)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    return np.stack([positions @ right, positions @ up], axis=-1) * 120, positions @ -forward


view = scene.view()
points = scene.sphere_points()
scene.show(points, view, "Pull-Push")
simple.SetActiveSource(points)
simple.SelectSurfacePoints(Rectangle=[170, 160, 209, 189], View=view)
positions, ids = selected(points)
assert len(positions) == 1
pixels, height = on_screen(positions[0])
print(len(ids[0]), "points selected, at pixels", pixels.min(axis=0), "to", pixels.max(axis=0))
assert len(ids[0]) > 50
assert height.min() > 0, "points of the back are selected"
assert pixels.min() > 5 and (pixels.max(axis=0) < [65, 45]).all() and (pixels.min(axis=0) > [15, 5]).all()
cloud = vtk_to_numpy(simple.servermanager.Fetch(points).GetPoints().GetData())
assert np.allclose(cloud[ids[0]], positions[0])
before = scene.picture(view, "selection")
simple.ClearSelection()

# of composite data: in each block its own points
simple.Hide(points, view)
halves = [scene.sphere_points(10000, [0, y, 0]) for y in (-0.5, 0.5)]
group = simple.GroupDatasets(Input=halves, OutputType="vtkMultiBlockDataSet", BlockNames=["left", "right"])
group.UpdatePipeline()
scene.show(group, view, "Pull-Push")
simple.SetActiveSource(group)
simple.SelectSurfacePoints(Rectangle=[60, 100, 240, 200], View=view)
positions, ids = selected(group)
assert len(positions) == 2, "of one block none is selected"
for block, (found, numbers) in enumerate(zip(positions, ids)):
    cloud = vtk_to_numpy(simple.servermanager.Fetch(halves[block]).GetPoints().GetData())
    print(len(numbers), "points of block", block, "selected")
    assert len(numbers) > 50 and np.allclose(cloud[numbers], found)
simple.ClearSelection()
