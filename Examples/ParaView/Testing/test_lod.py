# SPDX-License-Identifier: BSD-3-Clause
"""While the camera moves fewer points are drawn, with larger radii: a coarser picture of the same surface, without holes,
in the same colours; when it rests all are drawn again."""

import numpy as np
from paraview import simple

import scene

BLOCKS = ["/Root/left", "0", "0", "1"]
view = scene.view()


def drawn():
    """How many points the view last drew."""
    for actor in view.GetClientSideObject().GetRenderer().GetActors():
        mapper = actor.GetMapper()
        if actor.GetVisibility() and mapper and mapper.IsA("vtkPointSurfaceMapper"):
            return mapper.GetInputDataObject(0, 0).GetNumberOfPoints()


view.LODThreshold = 0
for system in ("Pull-Push", "Surface Splats"):
    differences = []
    for resolution in (1.0, 0.5, 0.0):
        view.LODResolution = resolution
        points = scene.sphere_points(200000)  # anew: ParaView keeps what it has thinned
        display = scene.show(points, view, system)
        still = scene.picture(view, f"lod-still-{system}")
        assert drawn() == 200000
        levels = scene.interactive(view, f"lod-{system}-{resolution}")
        assert abs(drawn() * 2 ** (8 * (1 - resolution)) / 200000 - 1) < 0.1, drawn()
        differences.append(np.abs(levels - still).mean())
        print(f"{system}, resolution {resolution}: {differences[-1]:.3f} grey levels")
        scene.assert_like(levels, still, f"{system}, resolution {resolution}", iou=0.95, difference=6)
        assert (scene.picture(view, f"lod-rests-{system}") == still).all()
        simple.Delete(points)
    assert differences[0] < 0.05 < differences[1] < differences[2]

# radii that are given, and blocks
halves = [scene.sphere_points(100000, [0, y, 0]) for y in (-0.6, 0.6)]
sized = [simple.PointSpacing(half) for half in halves]
group = simple.GroupDatasets(Input=sized, OutputType="vtkMultiBlockDataSet", BlockNames=["left", "right"])
display = scene.show(group, view, "Pull-Push")
display.BlockColors = BLOCKS
view.CameraParallelScale = 2
view.LODResolution = 0.5
still = scene.picture(view, "lod-blocks")
scene.assert_like(scene.interactive(view, "lod-blocks-interactive"), still, "blocks", iou=0.96, difference=6)
