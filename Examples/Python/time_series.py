# SPDX-License-Identifier: BSD-3-Clause
"""A cloud that changes from step to step: the same mapper, new points; the last four steps side by side."""

import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from pointsurface import rendering, vtkPullPushMapper

count = 30000
i = np.arange(count) + 0.5  # even points on a sphere
z, angle = 1 - 2 * i / count, i * np.pi * (3 - np.sqrt(5))
sphere = np.stack([np.sqrt(1 - z**2) * np.cos(angle), np.sqrt(1 - z**2) * np.sin(angle), z], axis=1)


def step(time):
    """Waves that run over a ball."""
    waves = 1 + 0.12 * np.sin(6 * sphere[:, 2:] + time) * (1 - sphere[:, 2:] ** 2)
    return np.ascontiguousarray(sphere * waves, np.float32)


cloud = vtkPolyData()
cloud.SetPoints(vtkPoints())
mapper = vtkPullPushMapper()
mapper.SetInputData(cloud)
mapper.SetRadius(0.04)  # normals are estimated from each step's points
actor = vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderer()
renderer.AddActor(actor)
renderer.GetActiveCamera().SetPosition(3, -5, 2)
renderer.GetActiveCamera().SetViewUp(0, 0, 1)
window = rendering.offscreen_window(renderer, (300, 300))

pictures = []
for time in np.linspace(0, 2 * np.pi, 4, endpoint=False):
    cloud.GetPoints().SetData(numpy_to_vtk(step(time), deep=True))
    cloud.Modified()
    if not pictures:
        renderer.ResetCamera()
    pictures.append(rendering.read_color(window))
rendering.write_png(sys.argv[1] if len(sys.argv) > 1 else "time_series.png", np.concatenate(pictures, axis=1))
