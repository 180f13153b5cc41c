# SPDX-License-Identifier: BSD-3-Clause
"""A noisy scan of positions and nothing else: no normals, no radii, nothing computed beforehand."""

import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from pointsurface import rendering, vtkDirectPointMapper

random = np.random.default_rng(1)
x, y = random.uniform(-1, 1, (2, 300_000))
height = 0.15 * np.sin(6 * x) * np.cos(5 * y) + random.normal(0, 0.002, x.size)
points = vtkPoints()
points.SetData(numpy_to_vtk(np.stack([x, y, height], axis=1), deep=True))
scan = vtkPolyData()
scan.SetPoints(points)

mapper = vtkDirectPointMapper()
mapper.SetInputData(scan)
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetColor(0.75, 0.85, 0.65)
renderer = vtkRenderer()
renderer.AddActor(actor)
window = rendering.offscreen_window(renderer, (600, 600))
renderer.GetActiveCamera().SetPosition(1, -2, 1.6)
renderer.GetActiveCamera().SetViewUp(0, 0, 1)
renderer.ResetCamera()
rendering.write_png(sys.argv[1] if len(sys.argv) > 1 else "raw_scan.png", rendering.read_color(window))
