# SPDX-License-Identifier: BSD-3-Clause
"""A mesh that runs through a translucent cloud: each hides the other where it is nearer."""

import sys

from vtkmodules.vtkFiltersSources import vtkCylinderSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from pointsurface import rendering, vtkPullPushMapper

source = vtkSphereSource()
source.SetThetaResolution(200)
source.SetPhiResolution(120)
mapper = vtkPullPushMapper()
mapper.SetInputConnection(source.GetOutputPort())
mapper.SetRadius(0.02)
cloud = vtkActor()
cloud.SetMapper(mapper)
cloud.GetProperty().SetOpacity(0.6)
cloud.GetProperty().SetColor(0.6, 0.8, 0.9)

cylinder = vtkCylinderSource()
cylinder.SetRadius(0.12)
cylinder.SetHeight(1.4)
cylinder.SetResolution(60)
mesh_mapper = vtkPolyDataMapper()
mesh_mapper.SetInputConnection(cylinder.GetOutputPort())
mesh = vtkActor()
mesh.SetMapper(mesh_mapper)
mesh.RotateX(35)
mesh.RotateZ(30)
mesh.GetProperty().SetColor(0.9, 0.5, 0.1)

renderer = vtkRenderer()
renderer.AddActor(cloud)
renderer.AddActor(mesh)
renderer.UseDepthPeelingOn()  # translucent surfaces in their order
window = rendering.offscreen_window(renderer, (600, 600))
rendering.write_png(sys.argv[1] if len(sys.argv) > 1 else "mesh_in_cloud.png", rendering.read_color(window))
