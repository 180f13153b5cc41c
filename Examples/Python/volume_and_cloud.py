# SPDX-License-Identifier: BSD-3-Clause
"""An isosurface as points, without a triangle, amid the volume that it is taken from."""

import sys

from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkColorTransferFunction, vtkRenderer, vtkVolume, vtkVolumeProperty
from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkSmartVolumeMapper

from pointsurface import rendering, vtkIsosurfacePoints, vtkPullPushMapper

wavelet = vtkRTAnalyticSource()
wavelet.SetWholeExtent(-60, 60, -60, 60, -60, 60)

points = vtkIsosurfacePoints()  # positions, normals and radii
points.SetInputConnection(wavelet.GetOutputPort())
points.SetValue(0, 180)
mapper = vtkPullPushMapper()
mapper.SetInputConnection(points.GetOutputPort())
mapper.SetRadiusScale(1.5)  # smoother normals; 1 is as far as is needed to close the surface
mapper.ScalarVisibilityOff()
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetColor(0.9, 0.7, 0.3)

color = vtkColorTransferFunction()
color.AddRGBPoint(60, 0.2, 0.3, 0.9)
color.AddRGBPoint(250, 0.9, 0.9, 1)
opacity = vtkPiecewiseFunction()
opacity.AddPoint(80, 0)
opacity.AddPoint(180, 0.007)
look = vtkVolumeProperty()
look.SetColor(color)
look.SetScalarOpacity(opacity)
look.SetInterpolationTypeToLinear()
volume_mapper = vtkSmartVolumeMapper()
volume_mapper.SetInputConnection(wavelet.GetOutputPort())
volume = vtkVolume()
volume.SetMapper(volume_mapper)
volume.SetProperty(look)

renderer = vtkRenderer()
renderer.AddActor(actor)
renderer.AddVolume(volume)
renderer.GetActiveCamera().SetPosition(2, 1, 3)
renderer.ResetCamera()
window = rendering.offscreen_window(renderer, (600, 600))
rendering.write_png(sys.argv[1] if len(sys.argv) > 1 else "volume_and_cloud.png", rendering.read_color(window))
