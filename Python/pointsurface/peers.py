# SPDX-License-Identifier: BSD-3-Clause
"""What others draw points with, set up as fairly as can be, to be measured beside the mappers of this package."""

from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkRenderingCore import vtkPointGaussianMapper, vtkPolyDataMapper
from vtkmodules.vtkRenderingOpenGL2 import vtkCameraPass, vtkPointFillPass, vtkRenderStepsPass

DISC = """//VTK::Color::Impl
if (dot(offsetVCVSOutput, offsetVCVSOutput) > 1.0) discard;
"""


def gaussian_discs(cloud, scale=1):
    """A vtkPointGaussianMapper that draws opaque discs, their radius the array "radius" times `scale`.

    Triangles just around the discs: at its default, three times as large, it is 2 to 5 times slower.
    """
    mapper = vtkPointGaussianMapper()
    mapper.SetInputData(cloud)
    mapper.SetScaleArray("radius")
    mapper.SetScaleFactor(scale)
    mapper.EmissiveOff()
    mapper.SetSplatShaderCode(DISC)
    if hasattr(mapper, "SetBoundScale"):  # from VTK 9.4 on
        mapper.SetBoundScale(1)
    else:
        mapper.SetTriangleScale(1)
    return mapper


def gl_points(cloud):
    """A vtkPolyDataMapper of a vertex for each point, whose size is the actor's."""
    vertices = vtkVertexGlyphFilter()
    vertices.SetInputData(cloud)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(vertices.GetOutputPort())
    return mapper


def fill_points():
    """A pass for a renderer whose vtkPointFillPass fills what is between points of OpenGL, and what they hide.

    It leaves two kinds of depth in the picture, those of what it fills and others.
    """
    fill = vtkPointFillPass()
    fill.SetDelegatePass(vtkRenderStepsPass())
    camera = vtkCameraPass()
    camera.SetDelegatePass(fill)
    return camera
