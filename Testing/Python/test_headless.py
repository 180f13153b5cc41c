# SPDX-License-Identifier: BSD-3-Clause
"""The default window: with no display, with one, and where OpenGL is not to be had.

What the default is depends on the environment in which the library is loaded, so each case is a process of its own.
"""

import os
import shutil
import subprocess
import sys

import pytest
from vtkmodules.vtkCommonCore import vtkVersion

import pointsurface

if not hasattr(pointsurface, "vtkPointSurfaceEGLRenderWindow"):
    pytest.skip(
        f"VTK {vtkVersion.GetVTKVersion()} chooses its window itself", allow_module_level=True
    )

SCENE = """
source = vtkSphereSource()
mapper = vtkPolyDataMapper()
mapper.SetInputConnection(source.GetOutputPort())
actor = vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderer()
renderer.AddActor(actor)
window = vtkRenderWindow()
window.SetSize(100, 100)
window.AddRenderer(renderer)
"""

LIT_PIXELS = """
from vtkmodules.util.numpy_support import vtk_to_numpy
window.Render()
image = vtkWindowToImageFilter()
image.SetInput(window)
image.ReadFrontBufferOff()
image.Update()
scalars = image.GetOutput().GetPointData().GetScalars()
print(window.GetClassName(), int((vtk_to_numpy(scalars).max(axis=1) > 0).sum()))
"""


def run(script, command=(sys.executable,), **environment):
    """Runs a script in a process of its own; a value of None takes a variable out of the environment."""
    merged = {**os.environ, **environment}
    return subprocess.run(
        [*command, "-c", script],
        env={name: value for name, value in merged.items() if value is not None},
        capture_output=True,
        text=True,
        timeout=120,
    )


@pytest.mark.parametrize(
    "imports, display",
    [
        ("from vtkmodules.all import *; import pointsurface", None),
        ("import pointsurface; from vtkmodules.all import *", ""),
        ("from vtk import *; import pointsurface", ""),
        ("import pointsurface; from vtk import *", None),
    ],
)
def test_plain_script_renders_with_no_display(imports, display):
    result = run(imports + SCENE + LIT_PIXELS, DISPLAY=display)
    assert result.returncode == 0, result.stderr
    name, lit = result.stdout.split()
    assert name == "vtkPointSurfaceEGLRenderWindow"
    # The sphere's outline is a disc of 0.564 of the half of the window (see TestEGLRenderWindow.cxx); VTK's default
    # sphere of eight sides covers a little less.
    assert 2000 < int(lit) < 2500


def test_default_interactor_returns_with_no_display():
    result = run(
        "from vtkmodules.all import *; import pointsurface"
        + SCENE
        + "interactor = vtkRenderWindowInteractor()\n"
        "interactor.SetRenderWindow(window)\n"
        "interactor.Initialize()\n"
        "interactor.Start()\n"
        "print(interactor.GetClassName())"
    )
    assert result.returncode == 0, result.stderr
    assert result.stdout.strip() == "vtkGenericRenderWindowInteractor"


def test_window_still_open_at_exit():
    """Python clears module globals in any order; a reference cycle keeps the window until the very end."""
    result = run(
        "from vtkmodules.all import *; import pointsurface"
        + SCENE
        + "window.Render()\n"
        "window.AddObserver('ModifiedEvent', lambda *_: window)\n"
        "import builtins; builtins.kept = window"
    )
    assert result.returncode == 0, result.stderr
    assert result.stderr == ""


EVERYTHING_WITHOUT_OPENGL = (
    "import pointsurface; from vtkmodules.all import *"
    + SCENE
    + """
window.Render()
window.Render()
print(window.SupportsOpenGL())
print(window.ReportCapabilities())
interactor = vtkRenderWindowInteractor()
interactor.SetRenderWindow(window)
interactor.Initialize()
image = vtkWindowToImageFilter()
image.SetInput(window)
for setting in (image.SetInputBufferTypeToRGB, image.SetInputBufferTypeToRGBA, image.SetInputBufferTypeToZBuffer):
    setting()
    image.Update()
vtkPropPicker().Pick(10, 10, 0, renderer)
vtkWorldPointPicker().Pick(10, 10, 0, renderer)
selector = vtkHardwareSelector()
selector.SetRenderer(renderer)
selector.SetArea(0, 0, 10, 10)
selector.Select()
window.SetSize(50, 50)
window.Finalize()
print("the end")
"""
)


@pytest.mark.parametrize(
    "environment, words",
    [
        ({"__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent"}, ["EGL finds no device", "libegl1"]),
        ({"MESA_GL_VERSION_OVERRIDE": "2.1"}, ["version 3.2 or later", "libgl1-mesa-dri"]),
    ],
    ids=["no EGL", "OpenGL 2.1"],
)
def test_without_opengl_one_clear_error_and_no_crash(environment, words):
    result = run(EVERYTHING_WITHOUT_OPENGL, **environment)
    assert result.returncode == 0, result.stderr
    supports_opengl, capabilities, last = result.stdout.splitlines()
    assert supports_opengl == "0"
    assert last == "the end"
    errors = [line for line in result.stderr.splitlines() if "Nothing can be rendered" in line]
    assert len(errors) == 1, result.stderr
    for word in words:
        assert word in errors[0]
        assert word in capabilities


def test_device_that_does_not_exist_gives_a_warning_and_another_device():
    result = run(
        "from vtkmodules.all import *; import pointsurface" + SCENE + LIT_PIXELS,
        VTK_DEFAULT_EGL_DEVICE_INDEX="77",
    )
    assert result.returncode == 0, result.stderr
    assert "EGL device 77" in result.stderr and "VTK_DEFAULT_EGL_DEVICE_INDEX" in result.stderr
    assert int(result.stdout.split()[1]) > 2000


needs_xvfb = pytest.mark.skipif(
    not (shutil.which("xvfb-run") and shutil.which("xauth")), reason="needs the packages xvfb and xauth"
)


@needs_xvfb
def test_with_a_display_vtk_s_own_window_stays():
    result = run(
        "import pointsurface; from vtkmodules.all import *"
        + SCENE
        + LIT_PIXELS
        + "print(vtkRenderWindowInteractor().GetClassName())",
        command=("xvfb-run", "-a", sys.executable),
    )
    assert result.returncode == 0, result.stderr
    name, lit, interactor = result.stdout.split()
    assert name == "vtkXOpenGLRenderWindow"
    assert 2000 < int(lit) < 2500
    assert interactor == "vtkXRenderWindowInteractor"


@needs_xvfb
def test_with_a_display_our_window_can_be_made_by_name():
    scene = SCENE.replace("vtkRenderWindow()", "pointsurface.vtkPointSurfaceEGLRenderWindow()")
    result = run(
        "import pointsurface; from vtkmodules.all import *" + scene + LIT_PIXELS,
        command=("xvfb-run", "-a", sys.executable),
    )
    assert result.returncode == 0, result.stderr
    name, lit = result.stdout.split()
    assert name == "vtkPointSurfaceEGLRenderWindow"
    assert 2000 < int(lit) < 2500
