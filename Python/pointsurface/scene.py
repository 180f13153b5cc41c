# SPDX-License-Identifier: BSD-3-Clause
"""The scene that a command draws: the points of a subject, lights, a camera, and the window that they are drawn in."""

import ctypes
import os
import sys
from contextlib import contextmanager
from math import cos, radians, sin

from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkRenderer

from . import passes
from .colors import color_map
from .errors import CannotRender, WrongUse, complaints
from .methods import AUTO, METHODS, chosen, needs_splats, splat_filter
from .progress import announce, followed
from .rendering import offscreen_window
from .subjects import ISOSURFACE_RADIUS_SCALE

# Where the camera stands, from the middle of the points, and what is up in its picture.
VIEWS = {
    "front": ((0, -1, 0), (0, 0, 1)),
    "back": ((0, 1, 0), (0, 0, 1)),
    "left": ((-1, 0, 0), (0, 0, 1)),
    "right": ((1, 0, 0), (0, 0, 1)),
    "top": ((0, 0, 1), (0, 1, 0)),
    "bottom": ((0, 0, -1), (0, 1, 0)),
    "iso": ((1, -1, 1), (0, 0, 1)),
}
KEY_AND_FILL = ((-31, 31, 0.8), (27, -10, 0.3))  # azimuth and elevation in degrees, intensity


def choose_method(subject, method):
    """A key of METHODS: `method`, or what is picked for the subject if that is AUTO. Raises CannotRender."""
    if method == AUTO:
        window_without_screen(vtkRenderer(), (1, 1))  # raises; what the factory asks needs OpenGL
    return chosen(method, subject.points)


def make(subject, arguments):
    """The renderer of a subject as options.add_scene() has it asked for, of a method that is chosen. Raises WrongUse."""
    renderer = make_scene(subject, make_mapper(subject, arguments), arguments.light or KEY_AND_FILL)
    if arguments.color:
        renderer.GetActors().GetLastActor().GetProperty().SetColor(arguments.color)
    if arguments.background:
        renderer.SetBackground(arguments.background)
    if arguments.view:
        look_from(renderer, subject, *VIEWS[arguments.view])
    if arguments.camera:
        place_camera(renderer, arguments.camera)
    passes.apply(renderer, passes.by_names(arguments.passes, renderer))
    return renderer


def make_mapper(subject, arguments):
    """The mapper of a subject as options.add_scene() has it asked for. Raises WrongUse."""
    mapper = METHODS[arguments.method]()
    points = subject.points
    if needs_splats(arguments.method, points):
        splats = splat_filter(points)
        with followed(splats, "fitting splats"):
            splats.Update()
        points = splats.GetOutput()
    mapper.SetInputData(points)
    mapper.SetRadiusScale(radius_scale(subject, arguments))
    mapper.SetRadius(arguments.radius or 0)
    mapper.SetSupersampling(arguments.supersampling)
    _color_by(mapper, points, arguments)
    clip(mapper, subject, arguments.clip)
    return mapper


def radius_scale(subject, arguments):
    return arguments.radius_scale or (ISOSURFACE_RADIUS_SCALE if subject.is_isosurface else 1.0)


def make_scene(subject, mapper, lights=KEY_AND_FILL):
    """A renderer with the subject, drawn by `mapper`, as its actor, with lights and a camera that sees all.

    lights: of each its azimuth and elevation in degrees, as seen from the camera, which they move with, and intensity.
    """
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.93, 0.82, 0.72)
    actor.GetProperty().SetSpecular(0.2)
    actor.GetProperty().SetSpecularPower(30)
    renderer = vtkRenderer()
    renderer.SetBackground(0.15, 0.17, 0.2)
    renderer.AddActor(actor)
    set_lights(renderer, lights)
    camera = renderer.GetActiveCamera()
    # Scanners' volumes have z up and the face towards y, most models y up and the face towards z.
    camera.SetPosition(*((0.5, 1, 0.05) if subject.is_isosurface else (0.4, 0.3, 1)))
    camera.SetViewUp(*((0, 0, 1) if subject.is_isosurface else (0, 1, 0)))
    renderer.ResetCamera(subject.points.GetBounds())
    camera.Zoom(1.4)
    return renderer


def set_lights(renderer, lights):
    renderer.RemoveAllLights()
    for azimuth, elevation, intensity in lights:
        azimuth, elevation = radians(azimuth), radians(elevation)
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(sin(azimuth) * cos(elevation), sin(elevation), cos(azimuth) * cos(elevation))
        light.SetIntensity(intensity)
        renderer.AddLight(light)


def look_from(renderer, subject, direction, up):
    """Turns the camera to all of the subject's points, whatever stands for them, from a direction."""
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(direction)
    camera.SetViewUp(up)
    renderer.ResetCamera(subject.points.GetBounds())
    renderer.ResetCameraClippingRange()


def describe_camera(camera):
    """A dict that place_camera() takes: position, focal_point, view_up, and view_angle in degrees or parallel_scale."""
    description = {
        "position": camera.GetPosition(),
        "focal_point": camera.GetFocalPoint(),
        "view_up": camera.GetViewUp(),
    }
    if camera.GetParallelProjection():
        return {**description, "parallel_scale": camera.GetParallelScale()}
    return {**description, "view_angle": camera.GetViewAngle()}


def place_camera(renderer, description):
    camera = renderer.GetActiveCamera()
    camera.SetPosition(description["position"])
    camera.SetFocalPoint(description["focal_point"])
    camera.SetViewUp(description["view_up"])
    camera.SetParallelProjection("parallel_scale" in description)
    if "parallel_scale" in description:
        camera.SetParallelScale(description["parallel_scale"])
    camera.SetViewAngle(description.get("view_angle", 30))
    renderer.ResetCameraClippingRange()


def _color_by(mapper, points, arguments):
    if not arguments.scalars:
        for option in ("cmap", "range"):
            if getattr(arguments, option):
                raise WrongUse(f"--{option} is of an array: it needs --scalars")
        return
    data = points.GetPointData()
    array = data.GetArray(arguments.scalars)
    if array is None:
        names = ", ".join(data.GetArrayName(i) for i in range(data.GetNumberOfArrays())) or "none"
        raise WrongUse(f'{arguments.file} has no point array "{arguments.scalars}"; it has: {names}')
    table = arguments.cmap or color_map("rainbow")
    table.SetVectorModeToMagnitude()
    mapper.SetLookupTable(table)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(arguments.scalars)
    mapper.SetScalarRange(arguments.range or array.GetFiniteRange(-1 if array.GetNumberOfComponents() > 1 else 0))


def clip(mapper, subject, planes):
    """Clips by planes, each a normal and an origin, None being the middle of the subject, and by no others."""
    if len(planes) > 6:
        raise WrongUse(f"{len(planes)} planes to clip by are more than six")
    mapper.RemoveAllClippingPlanes()
    for normal, origin in planes:
        plane = vtkPlane()
        plane.SetNormal(normal)
        plane.SetOrigin(subject.points.GetCenter() if origin is None else origin)
        mapper.AddClippingPlane(plane)


def window_without_screen(renderer, size):
    """As offscreen_window(), but raises CannotRender where there is no OpenGL."""
    check_display(needed=False)
    with complaints() as said:  # VTK tells of each way that it has tried
        window = offscreen_window(renderer, size)
        # From 9.4 on, with no EGL, it takes OSMesa, claims to support OpenGL, and crashes where that is not there.
        if any("libOSMesa not found" in text for text in said("ERROR") + said("Warning")):
            raise CannotRender(
                "there is no OpenGL: EGL finds no device with version 3.2 or later, and there is no libOSMesa either "
                "(Debian's libgl1-mesa-dri and libegl1 draw without a GPU)"
            )
        if not window.SupportsOpenGL():
            reason = " ".join(window.ReportCapabilities().split())
            raise CannotRender(reason or "there is no OpenGL of version 3.2 or later")
    return window


def check_display(needed):
    """Raises CannotRender if there is no display and one is needed, or there is one that cannot be opened: VTK's window
    would end the process."""
    name = os.environ.get("DISPLAY", "")
    if not sys.platform.startswith("linux"):
        return
    if not name:
        if needed:
            raise CannotRender("a display is needed, and DISPLAY is not set; the command render needs none")
        return
    try:
        x11 = ctypes.CDLL("libX11.so.6")
    except OSError:
        return
    x11.XOpenDisplay.restype = ctypes.c_void_p
    display = x11.XOpenDisplay(None)
    if not display:
        raise CannotRender(f"the display {name} (DISPLAY) cannot be opened; the command render needs none: unset DISPLAY")
    x11.XCloseDisplay(ctypes.c_void_p(display))


@contextmanager
def drawing(mapper):
    """While the block draws: shows how far the mapper is with what it estimates, tells its warnings, and raises its first
    error as WrongUse."""
    with complaints() as said, followed(mapper, "preparing the points"):
        yield
    for text in said("Warning"):
        announce(f"warning: {text}")
    if said("ERROR"):
        raise WrongUse(said("ERROR")[0])
