# SPDX-License-Identifier: BSD-3-Clause
"""The scene that a command draws: the points of a subject, lights and a camera."""

from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkRenderer


def make_scene(subject, mapper):
    """A renderer with the subject, drawn by `mapper`, as its actor, a key light and a fill light, a camera that sees all."""
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.93, 0.82, 0.72)
    actor.GetProperty().SetSpecular(0.2)
    actor.GetProperty().SetSpecularPower(30)
    renderer = vtkRenderer()
    renderer.SetBackground(0.15, 0.17, 0.2)
    renderer.AddActor(actor)
    for position, intensity in (((-0.6, 0.7, 1.0), 0.8), ((0.5, -0.2, 1.0), 0.3)):
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*position)
        light.SetIntensity(intensity)
        renderer.AddLight(light)
    camera = renderer.GetActiveCamera()
    # Scanners' volumes have z up and the face towards y, most models y up and the face towards z.
    camera.SetPosition(*((0.5, 1, 0.05) if subject.is_isosurface else (0.4, 0.3, 1)))
    camera.SetViewUp(*((0, 0, 1) if subject.is_isosurface else (0, 1, 0)))
    renderer.ResetCamera(subject.points.GetBounds())
    camera.Zoom(1.4)
    return renderer
