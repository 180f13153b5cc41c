#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a dense cloud in the styles of image-space illustration: plain, silhouettes, feature lines, both.

    python3 Examples/Python/styles.py FILE [--isovalue V] [--size WxH] [--output DIR]

writes plain.png, silhouettes.png, feature-lines.png and both.png. FILE holds points, or a volume whose isosurface is
drawn. PYTHONPATH must lead to the package pointsurface.
"""

import argparse
import os

from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from pointsurface import rendering, styles, vtkImageSpacePointMapper, vtkIsosurfacePoints
from pointsurface.readers import read


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file")
    parser.add_argument("--isovalue", type=float, default=0.5, help="of a volume; default: %(default)s")
    parser.add_argument("--size", default="600x600", metavar="WxH")
    parser.add_argument("--output", default=".", metavar="DIR")
    arguments = parser.parse_args()

    data = read(arguments.file)
    mapper = vtkImageSpacePointMapper()
    mapper.ScalarVisibilityOff()
    if isinstance(data, vtkImageData):
        isosurface = vtkIsosurfacePoints()
        isosurface.SetInputData(data)
        isosurface.SetValue(0, arguments.isovalue)
        mapper.SetInputConnection(isosurface.GetOutputPort())
    else:
        mapper.SetInputData(data)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.93, 0.87, 0.75)
    actor.GetProperty().BackfaceCullingOn()  # normals point outward
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    window = rendering.offscreen_window(renderer, tuple(map(int, arguments.size.split("x"))))
    camera = renderer.GetActiveCamera()
    if isinstance(data, vtkImageData):  # of a head: from the front
        camera.SetPosition(0, 1, 0)
        camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    camera.Zoom(1.4)

    os.makedirs(arguments.output, exist_ok=True)
    for style in styles.STYLES:
        styles.apply(renderer, style)
        path = os.path.join(arguments.output, style.replace(" ", "-") + ".png")
        rendering.write_png(path, rendering.read_color(window))
        print(path)


if __name__ == "__main__":
    main()
