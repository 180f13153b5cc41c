# SPDX-License-Identifier: BSD-3-Clause
"""Composite data: each block has its visibility, colour and opacity, and they stay when the system changes."""

import numpy as np
from paraview import simple

import scene

CENTERS = ([0, -1.2, 0], [0, 1.2, 0])  # in the picture left and right
SIDES = (np.s_[:, :250], np.s_[:, 250:])
view = scene.view(500, 250, 1.3)
view.CameraPosition = [10, 0, 0]


def group(parts, kind):
    result = simple.GroupDatasets(Input=parts, OutputType=kind, BlockNames=["left", "right"])
    result.UpdatePipeline()
    return result


def covered(levels):
    return [scene.covered(levels[side]).sum() for side in SIDES]


points = [scene.sphere_points(8000, center) for center in CENTERS]
meshes = [scene.sphere_mesh(center) for center in CENTERS]
for kind in ("vtkMultiBlockDataSet", "vtkPartitionedDataSetCollection"):
    mesh = group(meshes, kind)
    scene.show(mesh, view)
    truth = scene.picture(view, kind + "-mesh")
    simple.Hide(mesh, view)

    cloud = group(points, kind)
    display = scene.show(cloud, view, "Pull-Push")
    both = scene.picture(view, kind)
    scene.assert_like(both, truth, kind)

    display.BlockSelectors = ["/Root/right"]
    one = scene.picture(view, kind + "-one")
    assert covered(one)[0] == 0 and covered(one)[1] == covered(both)[1], covered(one)
    display.PointSurfaceSystem = "Image-Space"
    assert covered(scene.picture(view, kind + "-one-image-space"))[0] == 0
    display.PointSurfaceSystem = "Pull-Push"
    display.BlockSelectors = ["/Root"]
    assert (scene.picture(view, kind + "-both") == both).all()

    display.BlockColors = ["/Root/left", "0", "0", "1"]
    colors = scene.picture(view, kind + "-colors")
    left, right = (colors[side] for side in SIDES)
    assert left[125, 125, 0] < 20 and left[125, 125, 2] > 150, left[125, 125]
    assert np.abs(right - both[SIDES[1]]).mean() < 1
    display.BlockColors = []

    display.BlockOpacities = ["/Root/left", "0.5"]
    half = scene.picture(view, kind + "-opacity")
    expected = (both[SIDES[0]] + scene.BACKGROUND) / 2
    assert np.abs(half[SIDES[0]] - expected).mean() < 1
    assert np.abs(half[SIDES[1]] - both[SIDES[1]]).mean() < 1
    simple.Hide(cloud, view)
