# SPDX-License-Identifier: BSD-3-Clause
"""Charts of measurements as pictures, by VTK's own charts."""

import numpy as np
import vtkmodules.vtkRenderingContextOpenGL2  # draws charts, and the next one their text
import vtkmodules.vtkRenderingFreeType  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartXY, vtkPlotPoints
from vtkmodules.vtkCommonDataModel import vtkTable
from vtkmodules.vtkRenderingContext2D import vtkContextActor
from vtkmodules.vtkRenderingCore import vtkRenderer

from .rendering import offscreen_window, read_color, write_png

SIZE = (900, 600)
_COLORS = (
    (31, 119, 180), (255, 127, 14), (44, 160, 44), (214, 39, 40), (148, 103, 189), (140, 86, 75), (227, 119, 194),
    (127, 127, 127), (188, 189, 34), (23, 190, 207), (0, 0, 0),
)  # fmt: skip
_MARKERS = (vtkPlotPoints.CIRCLE, vtkPlotPoints.SQUARE, vtkPlotPoints.DIAMOND, vtkPlotPoints.CROSS)


def write_scatter(path, title, x_title, y_title, series, front=(), logarithmic=False):
    """Writes a chart of points as a PNG.

    series: name to a list of (x, y), which a line joins.
    front: points that a grey line joins.
    logarithmic: both axes, all values being above 0; else the x axis alone.
    """
    chart = vtkChartXY()
    chart.SetTitle(title)
    chart.SetShowLegend(True)
    chart.GetLegend().SetInline(False)  # beside what is shown
    for axis, name in ((vtkAxis.BOTTOM, x_title), (vtkAxis.LEFT, y_title)):
        chart.GetAxis(axis).SetTitle(name)
    bottom = chart.GetAxis(vtkAxis.BOTTOM)
    bottom.SetLogScale(True)
    abscissas = [x for points in series.values() for x, _ in points]
    bottom.SetBehavior(vtkAxis.FIXED)
    bottom.SetUnscaledRange(min(abscissas) / 1.2, max(abscissas) * 1.2)  # whole markers
    chart.GetAxis(vtkAxis.LEFT).SetLogScale(logarithmic)
    tables = []  # VTK does not hold on to them
    if len(front) > 1:
        tables.append(_add(chart, "none better in both", front, (170, 170, 170)))
    for i, (name, points) in enumerate(series.items()):
        tables.append(_add(chart, name, points, _COLORS[i % len(_COLORS)], _MARKERS[i % len(_MARKERS)]))
    actor = vtkContextActor()
    actor.GetScene().AddItem(chart)
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    window = offscreen_window(renderer, SIZE)
    window.Render()  # for the chart to know its size
    write_png(path, read_color(window))


def _add(chart, name, points, color, marker=vtkPlotPoints.NONE):
    """Returns the table that the plot shows."""
    table = vtkTable()
    for column, values in zip(("x", name), np.array(points, float).T):
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(column)
        table.AddColumn(array)
    plot = chart.AddPlot(vtkChart.LINE if len(points) > 1 else vtkChart.POINTS)
    plot.SetInputData(table, 0, 1)
    plot.SetColor(*color, 255)
    plot.SetWidth(1.5)
    plot.SetMarkerStyle(marker)
    plot.SetMarkerSize(10)
    return table
