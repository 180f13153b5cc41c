# SPDX-License-Identifier: BSD-3-Clause
"""A dense cloud in the styles of image-space illustration, side by side: plain, silhouettes, feature lines, both.

styles.py [PICTURE [FILE [ISOVALUE]]]: FILE holds points with outward normals, or a volume whose isosurface is drawn;
without it, it is the gyroid of a made-up volume.
"""

import sys

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from pointsurface import rendering, styles, vtkImageSpacePointMapper, vtkIsosurfacePoints
from pointsurface.readers import read
from pointsurface.volumes import gyroid_ball

data = read(sys.argv[2]) if len(sys.argv) > 2 else gyroid_ball(200)
mapper = vtkImageSpacePointMapper()
mapper.ScalarVisibilityOff()
if isinstance(data, vtkImageData):
    isosurface = vtkIsosurfacePoints()
    isosurface.SetInputData(data)
    isosurface.SetValue(0, float(sys.argv[3]) if len(sys.argv) > 3 else 0)
    mapper.SetInputConnection(isosurface.GetOutputPort())
else:
    mapper.SetInputData(data)
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetColor(0.93, 0.87, 0.75)
actor.GetProperty().BackfaceCullingOn()  # normals point outward

renderer = vtkRenderer()
renderer.SetBackground(1, 1, 1)
renderer.AddActor(actor)
window = rendering.offscreen_window(renderer, (300, 300))
if isinstance(data, vtkImageData):  # of a head: from the front
    renderer.GetActiveCamera().SetPosition(0, 1, 0)
    renderer.GetActiveCamera().SetViewUp(0, 0, 1)
renderer.ResetCamera()
renderer.GetActiveCamera().Zoom(1.4)

pictures = []
for style in styles.STYLES:
    styles.apply(renderer, style)
    pictures.append(rendering.read_color(window))
rendering.write_png(sys.argv[1] if len(sys.argv) > 1 else "styles.png", np.concatenate(pictures, axis=1))
