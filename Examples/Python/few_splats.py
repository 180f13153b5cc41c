# SPDX-License-Identifier: BSD-3-Clause
"""Few polynomial patches in the place of many points, each of the lowest order that will do: blue 1 to red 4."""

import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from pointsurface import rendering, vtkAlgebraicSplatMapper, vtkAlgebraicSplats

i = np.arange(60_000) + 0.5
z, angle = 1 - 2 * i / i.size, np.pi * (1 + 5**0.5) * i
ball = np.stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z], axis=1)
bumps = np.clip(np.sin(7 * ball).prod(axis=1), 0, None)
points = vtkPoints()
points.SetData(numpy_to_vtk(ball * (1 + 0.3 * bumps[:, None]), deep=True))
cloud = vtkPolyData()
cloud.SetPoints(points)

splats = vtkAlgebraicSplats()
splats.SetInputData(cloud)
splats.SetOrder(4)
splats.SetTolerance(4e-4)
splats.Update()
print(cloud.GetNumberOfPoints(), "points,", splats.GetOutput().GetNumberOfPoints(), "splats")

table = vtkLookupTable()
table.SetHueRange(2 / 3, 0)
mapper = vtkAlgebraicSplatMapper()
mapper.SetInputConnection(splats.GetOutputPort())
mapper.SetScalarModeToUsePointFieldData()
mapper.SelectColorArray("SplatOrder")
mapper.SetColorModeToMapScalars()
mapper.SetLookupTable(table)
mapper.SetScalarRange(1, 4)
actor = vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderer()
renderer.AddActor(actor)
window = rendering.offscreen_window(renderer, (600, 600))
renderer.GetActiveCamera().SetPosition(1, 0.6, 1)
renderer.ResetCamera()
renderer.GetActiveCamera().Zoom(1.4)
rendering.write_png(sys.argv[1] if len(sys.argv) > 1 else "few_splats.png", rendering.read_color(window))
