# SPDX-License-Identifier: BSD-3-Clause
"""Shows a file's points in a window: drag to turn, and keys that the window tells."""

import itertools
import json
import os
import signal
import sys
import time
from copy import copy

import vtkmodules.vtkInteractionStyle  # noqa: F401  moves the camera
import vtkmodules.vtkRenderingFreeType  # noqa: F401  draws text
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkHardwareSelector,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkRenderWindowInteractor,
    vtkTextActor,
)

from . import passes, scene
from .errors import CannotRender
from .methods import METHODS
from .options import add_scene, add_subject
from .passes import PASSES
from .progress import announce
from .rendering import read_color, write_png
from .subjects import load
from .timing import stage_milliseconds
from .writers import write_whole

RADIUS_STEP = 1.25
CLIP_STEP = 0.05  # of the cloud's extent
LIGHTS = {
    "key and fill": scene.KEY_AND_FILL,
    "headlight": ((0, 0, 1.0),),
    "left": ((-70, 10, 1.0),),
    "right": ((70, 10, 1.0),),
    "above": ((0, 75, 1.0),),
}
AXES = {"off": None, "x": (-1, 0, 0), "y": (0, -1, 0), "z": (0, 0, -1)}


def add_arguments(parser):
    """The command's part of the command line."""
    add_subject(parser)
    add_scene(parser)


def run(arguments):
    """Shows the window until it is closed. Raises WrongUse, CannotRender or OSError with a line for the user."""
    scene.check_display(needed=True)
    subject = load(arguments.file, arguments.isovalue)
    if subject.remark:
        announce(subject.remark)
    window = vtkRenderWindow()
    if sys.platform.startswith("linux") and not window.IsA("vtkXOpenGLRenderWindow"):
        raise CannotRender(f"VTK would draw into a {window.GetClassName()}, unseen: unset VTK_DEFAULT_OPENGL_WINDOW")
    Viewer(subject, arguments, window, vtkRenderWindowInteractor()).show()


class Viewer:
    """A window with a subject, drawn as options.add_scene() has it asked for, and the keys that change that.

    window, interactor: of any class; they are set up but not started.
    """

    def __init__(self, subject, arguments, window, interactor):
        self.subject = subject
        self.options = copy(arguments)
        self.options.method = scene.choose_method(subject, arguments.method)
        self.options.radius_scale = scene.radius_scale(subject, arguments)
        self.renderer = scene.make(subject, self.options)
        self.actor = self.renderer.GetActors().GetLastActor()
        self.mappers = {self.options.method: self.actor.GetMapper()}
        self.light = "as asked for" if arguments.light else next(iter(LIGHTS))
        self.view = arguments.view or "own"
        self.clip_axis = "off"
        self.clip_share = 0.5
        self.picked = ""
        self.saved = ""
        self._set_up(window, interactor)

    def _set_up(self, window, interactor):
        self.window = window
        self.window.SetMultiSamples(0)
        self.window.SetSize(*self.options.size)
        self.window.SetWindowName(f"pointsurface: {self.subject.title}")
        self.window.SetNumberOfLayers(2)
        self.window.AddRenderer(self.renderer)
        self._add_texts()
        self.interactor = interactor
        self.interactor.SetRenderWindow(self.window)
        style = vtkInteractorStyleTrackballCamera()
        style.SetDefaultRenderer(self.renderer)
        style.AddObserver("CharEvent", self._press)  # in the place of the style's own keys
        self.interactor.SetInteractorStyle(style)

    def _add_texts(self):
        """In a layer over the scene: what a frame has cost is known before the text of the same frame is drawn."""
        overlay = vtkRenderer()
        overlay.SetLayer(1)
        overlay.InteractiveOff()
        self.window.AddRenderer(overlay)
        self.legend, self.report = _text(overlay, (8, 8)), _text(overlay, (8, 8))
        self.legend.GetTextProperty().SetVerticalJustificationToTop()
        self.legend.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
        self.legend.SetPosition(0.01, 0.99)
        self.renderer.AddObserver("StartEvent", self._begin_frame)
        self.renderer.AddObserver("EndEvent", self._update_texts)

    def show(self):
        """Runs until the window is closed, q or Ctrl-C, which raises KeyboardInterrupt."""
        with scene.drawing(self.actor.GetMapper()):
            self.window.Render()
        interrupted = False

        def interrupt(*_):
            nonlocal interrupted
            interrupted = True
            self.interactor.TerminateApp()

        self.interactor.Initialize()
        # Python learns of a signal when it is called: now and then.
        self.interactor.AddObserver("TimerEvent", lambda *_: None)
        self.interactor.CreateRepeatingTimer(250)
        usual = signal.signal(signal.SIGINT, interrupt)
        try:
            self.interactor.Start()
        finally:
            signal.signal(signal.SIGINT, usual)
        if interrupted:
            raise KeyboardInterrupt

    def _press(self, *_):
        key = self.interactor.GetKeyCode()
        for keys, _, change in self._keys():
            if key in tuple(keys):  # a key alone, such as that of shift, has no character
                change(key)
                if not self.interactor.GetDone():
                    self.window.Render()

    def _keys(self):
        """Of each line of the legend: its keys, what it says, and what they do."""
        options = self.options
        return (
            ("m", f"m     mapper: {options.method}", self._change_method),
            ("+-", f"+ -   radius: {options.radius_scale:.3g} times", self._change_radius),
            ("123456789", f"1..{len(PASSES)}  passes: {', '.join(options.passes) or 'none'}", self._toggle_pass),
            ("l", f"l     light: {self.light}", self._change_light),
            ("c", f"c     clip along: {self.clip_axis}", self._change_clip_axis),
            ("[]", f"[ ]   clip at: {self.clip_share:.0%}", self._move_clip),
            ("v", f"v     view: {self.view}", self._change_view),
            ("p", f"p     pick under the cursor{self.picked}", self._pick),
            ("s", f"s     save picture and camera{self.saved}", self._save),
            ("h", "h     hide this", self._hide),
            ("q", "q     quit; drag turns, shift moves, wheel zooms", self._quit),
        )

    def _begin_frame(self, *_):
        self.frame_start = time.perf_counter()

    def _update_texts(self, *_):
        self.legend.SetInput("\n".join(text for _, text, _ in self._keys()))
        mapper = self.actor.GetMapper()
        milliseconds = stage_milliseconds(mapper)  # waits until OpenGL has finished
        milliseconds["frame"] = 1000 * (time.perf_counter() - self.frame_start)
        figures = "   ".join(f"{name} {value:.1f}" for name, value in milliseconds.items())
        points = self.subject.points.GetNumberOfPoints()
        self.report.SetInput(f"{points} points; milliseconds: {figures}")

    def _change_method(self, _key):
        self.options.method = _after(METHODS, self.options.method)
        if self.options.method not in self.mappers:
            self.mappers[self.options.method] = scene.make_mapper(self.subject, self.options)
        mapper = self.mappers[self.options.method]
        mapper.SetRadiusScale(self.options.radius_scale)
        self.actor.SetMapper(mapper)
        self._clip()

    def _change_radius(self, key):
        self.options.radius_scale *= RADIUS_STEP if key == "+" else 1 / RADIUS_STEP
        self.actor.GetMapper().SetRadiusScale(self.options.radius_scale)

    def _toggle_pass(self, key):
        """The order of the passes is that of their numbers, whichever comes first."""
        names = set(self.options.passes) ^ {list(PASSES)[int(key) - 1]}
        self.options.passes = [name for name in PASSES if name in names]
        passes.apply(self.renderer, passes.by_names(self.options.passes, self.renderer))

    def _change_light(self, _key):
        self.light = _after(LIGHTS, self.light)
        scene.set_lights(self.renderer, LIGHTS[self.light])

    def _change_clip_axis(self, _key):
        self.clip_axis = _after(AXES, self.clip_axis)
        self._clip()

    def _move_clip(self, key):
        self.clip_share += CLIP_STEP if key == "]" else -CLIP_STEP
        self.clip_share = min(max(self.clip_share, 0), 1)
        self._clip()

    def _clip(self):
        planes = list(self.options.clip)
        if self.clip_axis != "off" and len(planes) < 6:
            bounds = self.subject.points.GetBounds()
            origin = [low + self.clip_share * (high - low) for low, high in zip(bounds[::2], bounds[1::2])]
            planes.append((AXES[self.clip_axis], origin))
        scene.clip(self.actor.GetMapper(), self.subject, planes)

    def _change_view(self, _key):
        self.view = _after(scene.VIEWS, self.view)
        scene.look_from(self.renderer, self.subject, *scene.VIEWS[self.view])

    def _pick(self, _key):
        place = self.interactor.GetEventPosition()
        point = self._point_at(place)
        if point is None:
            self.picked = ": nothing"
            return
        coordinates = self.subject.points.GetPoint(point)
        self.picked = f": point {point} at {' '.join(f'{x:.6g}' for x in coordinates)}"
        announce(f"picked{self.picked[1:]}")
        self._mark(coordinates)

    def _point_at(self, place):
        """The id of the file's point whose surface is at a pixel; None for the background."""
        drawn = self.renderer.GetPass()
        self.renderer.SetPass(None)  # passes would filter the ids as if they were colours
        selector = vtkHardwareSelector()
        selector.SetRenderer(self.renderer)
        selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_POINTS)
        selector.SetArea(*place, *place)
        selection = selector.Select()
        self.renderer.SetPass(drawn)
        nodes = (selection.GetNode(i) for i in range(selection.GetNumberOfNodes()))
        ids = [node.GetSelectionList().GetTuple1(0) for node in nodes if node.GetSelectionList().GetNumberOfTuples()]
        if not ids:
            return None
        origins = self.actor.GetMapper().GetInput().GetPointData().GetArray("InputPointIds")  # of splats
        return int(origins.GetTuple1(int(ids[0])) if origins else ids[0])

    def _mark(self, coordinates):
        if not hasattr(self, "mark"):
            self.mark = vtkSphereSource()
            self.mark.SetThetaResolution(16)
            self.mark.SetPhiResolution(12)
            mapper = vtkPolyDataMapper()
            mapper.SetInputConnection(self.mark.GetOutputPort())
            actor = vtkActor()
            actor.SetMapper(mapper)
            actor.PickableOff()
            actor.GetProperty().SetColor(1, 0.1, 0.1)
            self.renderer.AddActor(actor)
        camera = self.renderer.GetActiveCamera()
        self.mark.SetRadius(0.008 * camera.GetDistance())
        self.mark.SetCenter(coordinates)

    def _save(self, _key):
        names = (f"pointsurface-{i:03d}" for i in itertools.count(1))
        name = next(name for name in names if not os.path.exists(f"{name}.png"))
        try:
            write_png(f"{name}.png", read_color(self.window))
            camera = scene.describe_camera(self.renderer.GetActiveCamera())
            write_whole(f"{name}.json", json.dumps(camera).encode())
        except OSError as error:
            self.saved = f": {error.strerror}"
            return
        self.saved = f": {name}.png, .json"
        announce(f"saved {name}.png and {name}.json")

    def _hide(self, _key):
        for text in (self.legend, self.report):
            text.SetVisibility(not text.GetVisibility())

    def _quit(self, _key):
        self.interactor.TerminateApp()


def _text(renderer, position):
    actor = vtkTextActor()
    actor.SetInput(" ")
    actor.SetPosition(*position)
    text = actor.GetTextProperty()
    text.SetFontFamilyToCourier()
    text.SetFontSize(13)
    text.SetColor(1, 1, 1)
    text.SetBackgroundColor(0, 0, 0)
    text.SetBackgroundOpacity(0.5)
    renderer.AddActor(actor)
    return actor


def _after(names, name):
    """The name that comes after another one; the first one after the last, or after one that is none of them."""
    names = list(names)
    return names[(names.index(name) + 1) % len(names)] if name in names else names[0]
