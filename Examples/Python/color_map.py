# SPDX-License-Identifier: BSD-3-Clause
"""A point array through a lookup table, with a colour bar beside it."""

import sys

import vtkmodules.vtkRenderingFreeType  # noqa: F401  draws text
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkFiltersCore import vtkElevationFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from pointsurface import rendering, vtkPullPushMapper

source = vtkSphereSource()
source.SetThetaResolution(200)
source.SetPhiResolution(120)
height = vtkElevationFilter()  # makes the point array "Elevation"
height.SetInputConnection(source.GetOutputPort())
height.SetLowPoint(0, -0.5, 0)
height.SetHighPoint(0, 0.5, 0)

table = vtkLookupTable()
table.SetHueRange(0.65, 0)
mapper = vtkPullPushMapper()
mapper.SetInputConnection(height.GetOutputPort())
mapper.SetRadius(0.02)
mapper.SetScalarModeToUsePointFieldData()
mapper.SelectColorArray("Elevation")
mapper.SetLookupTable(table)
mapper.SetScalarRange(0, 1)
actor = vtkActor()
actor.SetMapper(mapper)
bar = vtkScalarBarActor()
bar.SetLookupTable(table)
bar.SetTitle("Height")
bar.SetNumberOfLabels(5)
bar.SetVerticalTitleSeparation(10)
bar.SetPosition(0.8, 0.1)
bar.SetWidth(0.15)

renderer = vtkRenderer()
renderer.AddActor(actor)
renderer.AddViewProp(bar)
window = rendering.offscreen_window(renderer, (600, 600))
rendering.write_png(sys.argv[1] if len(sys.argv) > 1 else "color_map.png", rendering.read_color(window))
