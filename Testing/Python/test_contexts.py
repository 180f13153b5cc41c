# SPDX-License-Identifier: BSD-3-Clause
"""Contexts of OpenGL that lack what a path needs: that is named once, with what to do, and there is a frame all the same.

What a context has is settled when a process makes its first one. So each case is a process of its own, in which Mesa
hides something, or a library loaded before OpenGL's tells of smaller limits. It runs this file: mappers by both back ends,
each beside a mesh of the same surface.
"""

import functools
import json
import os
import subprocess
import sys

import numpy as np
import pytest
from scenes import ACCURACY, BACKENDS, MAPPERS, Scene, difference, torus_cloud, torus_mesh
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import VTK_STRING
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes
from vtkmodules.vtkRenderingCore import vtkActor, vtkHardwareSelector, vtkPolyDataMapper, vtkRenderer
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass

from pointsurface import vtkAlgebraicSplatMapper, vtkPointSurfacePass, vtkPullPushMapper, vtkSurfaceSmoothingPass

LIMITS = os.environ.get("POINTSURFACE_TEST_LIMITS")  # the library; see Testing/Cxx/LowerLimits.c


def hidden(*extensions):
    """VTK asks for OpenGL 3.2, which a context without one of these extensions would not be."""
    return {"MESA_GL_VERSION_OVERRIDE": "3.2", "MESA_EXTENSION_OVERRIDE": " ".join("-GL_" + e for e in extensions)}


def lowered(**limits):
    return {"LD_PRELOAD": LIMITS, **{f"POINTSURFACE_TEST_{name}": str(value) for name, value in limits.items()}}


COPIES = "copies"  # in the place of mappers' names

# What a context lacks: how that is brought about, what is said of it, and of which mappers, if OpenGL was to draw them.
FALLBACKS = {
    "float depths": (hidden("ARB_depth_buffer_float"), "cannot draw to depth textures of 32-bit floats", MAPPERS),
    "texture buffers": (
        hidden("ARB_texture_buffer_object", "ARB_texture_buffer_range"),
        "has texture buffers (GL_MAX_TEXTURE_BUFFER_SIZE) of up to 0, not ",
        [vtkAlgebraicSplatMapper],
    ),
    "large texture buffers": (
        lowered(TEXTURE_BUFFER_SIZE=1000),
        "has texture buffers (GL_MAX_TEXTURE_BUFFER_SIZE) of up to 1000, not ",
        [vtkAlgebraicSplatMapper],
    ),
    "large points": (
        lowered(POINT_SIZE=8),
        "has points (GL_POINT_SIZE_RANGE) of up to 8, not 16 pixels",
        [vtkPullPushMapper],
    ),
}
REFUSALS = {
    "float textures": (hidden("ARB_texture_float"), "has no textures of 32-bit floats (GL_RGBA32F)"),
    "integer textures": (hidden("EXT_texture_integer"), "has no textures of 32-bit integers (GL_R32UI)"),
}
# The least that VTK draws with, and what macOS has.
ENOUGH = {f"OpenGL {version}": {"MESA_GL_VERSION_OVERRIDE": version} for version in ("3.2", "4.1")}


def listen(subject):
    """The texts of a subject's errors and warnings, as they come."""
    said = []
    for event in ("ErrorEvent", "WarningEvent"):

        def hear(_, kind, text):
            said.append(f"{kind}: {text}")

        hear.CallDataType = VTK_STRING
        subject.AddObserver(event, hear)
    return said


def draw(mapper_class, backend):
    """The cloud in the left half of a window, the mesh in its right half, twice; then a selection of the cloud."""
    scene = Scene(mapper_class, torus_cloud(5000), size=(300, 150))
    getattr(scene.mapper, f"SetBackendTo{backend}")()
    said = listen(scene.mapper)
    scene.renderer.SetViewport(0, 0, 0.5, 1)
    mesh = vtkPolyDataMapper()
    mesh.SetInputData(torus_mesh(200, 100))
    actor = vtkActor()
    actor.SetMapper(mesh)
    beside = vtkRenderer()
    beside.SetViewport(0.5, 0, 1, 1)
    beside.SetBackground(scene.renderer.GetBackground())
    beside.SetActiveCamera(scene.camera)
    beside.AddActor(actor)
    scene.window.AddRenderer(beside)
    scene.color()
    picture = scene.color()
    drawn = {
        "said": list(said),
        "backend": BACKENDS[scene.mapper.GetLastFrameBackend() - 1],
        "cloud": int((scene.depth()[:, :150] < 1).sum()),
        "mesh": int((difference_to(picture[:, 150:], scene.renderer.GetBackground()) > 1).sum()),
        "difference": difference(picture[:, :150], picture[:, 150:]),
    }
    if backend == "CPU":  # ids are carried to the same shaders by both, which take long to compile
        selector = vtkHardwareSelector()
        selector.SetRenderer(scene.renderer)
        selector.SetArea(0, 0, 149, 149)
        drawn["selected"] = selector.Select().GetNumberOfNodes()
    return drawn


def difference_to(image, color):
    return 255 * abs(image - color).max(axis=-1)


def draw_by_pass(render_pass):
    """A cloud and a floor below it, by a pass in the place of the opaque one."""
    scene = Scene(MAPPERS[0], torus_cloud(5000), size=(150, 150))
    scene.mapper.SetBackendToOpenGL()
    scene.add_floor()
    said = listen(render_pass)
    steps = vtkRenderStepsPass()
    if hasattr(render_pass, "SetDelegatePass"):
        render_pass.SetDelegatePass(steps.GetOpaquePass())
    steps.SetOpaquePass(render_pass)
    scene.renderer.SetPass(steps)
    scene.color()
    picture = scene.color()
    return {"said": said, "covered": int((difference_to(picture, scene.renderer.GetBackground()) > 1).sum())}


def draw_copies():
    """A cloud whose last half are copies of another process' points, by shaders, twice."""
    cloud = torus_cloud(5000)
    copies = np.zeros(cloud.GetNumberOfPoints(), dtype=np.uint8)
    copies[2500:] = vtkDataSetAttributes.DUPLICATEPOINT
    ghosts = numpy_to_vtk(copies, deep=True)
    ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
    cloud.GetPointData().AddArray(ghosts)
    scene = Scene(vtkPullPushMapper, cloud, size=(150, 150))
    said = listen(scene.mapper)
    scene.color()
    scene.color()
    print(json.dumps({"said": said, "cloud": int((scene.depth() < 1).sum())}))


def main(names):
    """What is drawn in the context of this process, as a line of JSON."""
    classes = [m for m in MAPPERS if m.__name__ in names]
    drawn = {f"{m.__name__} {backend}": draw(m, backend) for m in classes for backend in BACKENDS}
    for pass_class in (vtkSurfaceSmoothingPass, vtkPointSurfacePass) if classes == MAPPERS else ():
        drawn[pass_class.__name__] = draw_by_pass(pass_class())
    print(json.dumps(drawn))


@functools.lru_cache(maxsize=None)
def run(names, environment):
    process = subprocess.run(
        [sys.executable, __file__, *names],
        env={**os.environ, **dict(environment)},
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert process.returncode == 0, process.stderr
    return json.loads(process.stdout.splitlines()[-1])


def drawn_in(environment, names=tuple(m.__name__ for m in MAPPERS)):
    if "LD_PRELOAD" in environment and not LIMITS:
        pytest.skip("the library that lowers limits is built with the C++ tests alone")
    return run(tuple(names), tuple(environment.items()))


def cases(table):
    """For pytest: "name, mapper_class, backend"."""
    every = [(name, m, b) for name, row in table.items() for m in (row[2] if len(row) > 2 else MAPPERS) for b in BACKENDS]
    return pytest.mark.parametrize("name, mapper_class, backend", every)


def check_drawn(mapper_class, drawn):
    assert drawn["cloud"] > 3000 and drawn.get("selected", 1) == 1
    assert drawn["difference"] < 4 * ACCURACY[mapper_class].factor  # outlines, too


@cases(ENOUGH)
def test_versions_that_are_enough(name, mapper_class, backend):
    drawn = drawn_in(ENOUGH[name])[f"{mapper_class.__name__} {backend}"]
    assert drawn["said"] == [] and drawn["backend"] == backend
    check_drawn(mapper_class, drawn)


@cases(FALLBACKS)
def test_the_processor_takes_over(name, mapper_class, backend):
    environment, words, classes = FALLBACKS[name]
    drawn = drawn_in(environment, [m.__name__ for m in classes])[f"{mapper_class.__name__} {backend}"]
    check_drawn(mapper_class, drawn)
    assert drawn["backend"] == "CPU"
    if backend == "CPU":
        assert drawn["said"] == []
    else:
        (said,) = drawn["said"]  # once, in two frames
        assert said.startswith("WarningEvent") and words in said and "SetBackendToCPU" in said


@cases(REFUSALS)
def test_without_what_shading_needs(name, mapper_class, backend):
    environment, words = REFUSALS[name]
    drawn = drawn_in(environment)[f"{mapper_class.__name__} {backend}"]
    (said,) = drawn["said"]
    assert said.startswith("ErrorEvent") and words in said and "LIBGL_ALWAYS_SOFTWARE" in said
    assert drawn["cloud"] == 0 and drawn.get("selected", 0) == 0
    assert drawn["mesh"] > 3000  # what lies beside it is drawn


@pytest.mark.parametrize("largest", [1000, 1250])
def test_copies_of_points_need_large_texture_buffers(largest):
    """A texel is of four points."""
    drawn = drawn_in(lowered(TEXTURE_BUFFER_SIZE=largest), [COPIES])
    assert drawn["cloud"] > 3000
    if largest == 1000:
        (said,) = drawn["said"]  # once, in two frames
        assert said.startswith("WarningEvent") and "up to 1000, not 1250 texels" in said and "are drawn alike" in said
    else:
        assert drawn["said"] == []


@pytest.mark.parametrize("name", ["float depths", *REFUSALS])
def test_passes(name):
    """A pass that filters leaves what it was to filter as it is; clouds of one that joins them are each drawn, or not."""
    environment, words = {**FALLBACKS, **REFUSALS}[name][:2]
    drawn = drawn_in(environment)
    (said,) = drawn["vtkSurfaceSmoothingPass"]["said"]
    what = words[words.index("textures of") :]
    assert said.startswith("ErrorEvent") and "cannot draw to" in said and what in said and "is drawn as it is" in said
    for pass_name in ("vtkSurfaceSmoothingPass", "vtkPointSurfacePass"):
        assert drawn[pass_name]["covered"] > 3000  # the floor at least


if __name__ == "__main__":
    if sys.argv[1:] == [COPIES]:
        draw_copies()
    else:
        main(sys.argv[1:])
