# SPDX-License-Identifier: BSD-3-Clause
"""A cloud lit as any actor is: a warm and a cold light, a shining material, two samples along a side of a pixel."""

import sys

from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkRenderer

from pointsurface import rendering, vtkPullPushMapper

source = vtkSphereSource()  # its points and normals; the triangles are not drawn
source.SetThetaResolution(200)
source.SetPhiResolution(120)

mapper = vtkPullPushMapper()
mapper.SetInputConnection(source.GetOutputPort())
mapper.SetRadius(0.02)  # in the units of the coordinates: 1.5 to 2 times the distance between points
mapper.SetSupersampling(2)
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetSpecular(0.5)
actor.GetProperty().SetSpecularPower(40)

renderer = vtkRenderer()
renderer.AddActor(actor)
for position, color in (((3, 2, 4), (1.0, 0.8, 0.6)), ((-4, 0, 1), (0.2, 0.4, 0.8))):
    light = vtkLight()
    light.SetPosition(*position)
    light.SetColor(*color)
    renderer.AddLight(light)

window = rendering.offscreen_window(renderer, (600, 600))
rendering.write_png(sys.argv[1] if len(sys.argv) > 1 else "lights.png", rendering.read_color(window))
