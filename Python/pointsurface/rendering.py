# SPDX-License-Identifier: BSD-3-Clause
"""Windows without a screen, and pictures from them as numpy arrays. Row 0 is at the bottom, as in VTK."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter

from .writers import write_whole


def offscreen_window(renderer, size):
    """A render window of size (width, height) that is not shown, with one sample a pixel."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(*size)
    window.AddRenderer(renderer)
    return window


def read_color(window, scale=1):
    """Renders the window at `scale` times its size, in tiles, and returns (height, width, 3), 0 to 1."""
    window.Render()  # it resets the camera of a renderer that has none yet; the filter does not
    return grab_color(window, scale)


def grab_color(window, scale=1):
    """As read_color(), of a window that has been rendered."""
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.SetScale(scale)
    grab.SetShouldRerender(scale > 1)
    grab.SetInputBufferTypeToRGB()
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3) / 255.0


def renderer_string(window):
    """The OpenGL renderer that draws the window, for instance "llvmpipe (LLVM 15.0.6, 256 bits)"."""
    for line in window.ReportCapabilities().splitlines():
        if line.startswith("OpenGL renderer string:"):
            return line.split(":", 1)[1].strip()
    return "unknown"


def box_average(image, factor):
    """The mean over blocks of factor by factor pixels."""
    height, width = image.shape[0] // factor, image.shape[1] // factor
    return image.reshape(height, factor, width, factor, *image.shape[2:]).mean(axis=(1, 3))


def write_png(path, color):
    """Writes (height, width, 3), 0 to 1, as a PNG: whole or not at all."""
    height, width, _ = color.shape
    pixels = np.ascontiguousarray(np.rint(np.clip(color, 0, 1) * 255).astype(np.uint8).reshape(-1, 3))
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels))
    writer = vtkPNGWriter()
    writer.WriteToMemoryOn()
    writer.SetInputData(image)
    writer.Write()
    write_whole(path, bytes(vtk_to_numpy(writer.GetResult())))
