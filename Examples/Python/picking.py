# SPDX-License-Identifier: BSD-3-Clause
"""What is under the cursor: the actor and the place on the surface; and the points that a rectangle shows."""

import sys

from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkHardwareSelector, vtkPolyDataMapper, vtkPropPicker, vtkRenderer

from pointsurface import rendering, vtkPullPushMapper

source = vtkSphereSource()
source.SetThetaResolution(200)
source.SetPhiResolution(120)
mapper = vtkPullPushMapper()
mapper.SetInputConnection(source.GetOutputPort())
mapper.SetRadius(0.02)
actor = vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderer()
renderer.AddActor(actor)
window = rendering.offscreen_window(renderer, (600, 600))
window.Render()

picker = vtkPropPicker()
picker.Pick(350, 330, 0, renderer)
place = picker.GetPickPosition()
print("picked", "the cloud" if picker.GetViewProp() is actor else "nothing", "at", *(f"{x:.3f}" for x in place))

selector = vtkHardwareSelector()
selector.SetRenderer(renderer)
selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_POINTS)
selector.SetArea(280, 280, 320, 320)
ids = selector.Select().GetNode(0).GetSelectionList()
print("the rectangle shows", ids.GetNumberOfTuples(), "points")

mark = vtkSphereSource()  # a ball where the cursor met the surface
mark.SetCenter(*place)
mark.SetRadius(0.03)
mark_mapper = vtkPolyDataMapper()
mark_mapper.SetInputConnection(mark.GetOutputPort())
mark_actor = vtkActor()
mark_actor.SetMapper(mark_mapper)
mark_actor.GetProperty().SetColor(1, 0, 0)
renderer.AddActor(mark_actor)
rendering.write_png(sys.argv[1] if len(sys.argv) > 1 else "picking.png", rendering.read_color(window))
