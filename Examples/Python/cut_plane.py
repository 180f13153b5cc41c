# SPDX-License-Identifier: BSD-3-Clause
"""A cloud cut open by a plane; the inside is lit as the outside."""

import sys

from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkProperty, vtkRenderer

from pointsurface import rendering, vtkPullPushMapper

source = vtkSphereSource()
source.SetThetaResolution(200)
source.SetPhiResolution(120)
plane = vtkPlane()  # what lies on the side that its normal points to is kept
plane.SetNormal(-1, -0.3, -1)

mapper = vtkPullPushMapper()
mapper.SetInputConnection(source.GetOutputPort())
mapper.SetRadius(0.02)
mapper.AddClippingPlane(plane)
actor = vtkActor()
actor.SetMapper(mapper)
inside = vtkProperty()
inside.SetColor(0.9, 0.4, 0.2)
actor.SetBackfaceProperty(inside)

renderer = vtkRenderer()
renderer.AddActor(actor)
window = rendering.offscreen_window(renderer, (600, 600))
rendering.write_png(sys.argv[1] if len(sys.argv) > 1 else "cut_plane.png", rendering.read_color(window))
