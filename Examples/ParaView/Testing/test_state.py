# SPDX-License-Identifier: BSD-3-Clause
"""A state saved is a state loaded, and the trace of a session is a script that draws the same."""

import os

from paraview import simple, smstate, smtrace

import scene

PROPERTIES = {
    "PointSurfaceSystem": "Direct",
    "PointSurfaceRadius": 0.05,
    "PointSurfaceRadiusScale": 0.9,
    "PointSurfaceDepthTolerance": 0.01,
    "PointSurfaceSupersampling": 2,
}


class change:
    """Properties of a proxy are set, as the panel does it: that is what a trace records."""

    def __init__(self, proxy, traced):
        self.item = smtrace.PropertiesModified(proxy) if traced else None

    def __enter__(self):
        pass

    def __exit__(self, *_):
        if self.item:
            self.item.finalize()


def session(traced=False):
    """What a user does."""
    view = scene.view()
    points = scene.sphere_points()
    display = simple.Show(points, view)
    with change(display, traced):
        display.Representation = "Point Surface"
        for name, value in PROPERTIES.items():
            setattr(display, name, value)
    simple.ColorBy(display, ("POINTS", "height"))
    simple.Render(view)
    return view


def fresh():
    simple.ResetSession()
    simple._DisableFirstRenderCameraReset()


def check(name, expected):
    """That the session's one view draws it, with the properties as set."""
    (view,) = simple.GetRenderViews()
    (display,) = [d for d in view.Representations if hasattr(d, "PointSurfaceSystem")]
    assert display.Representation == "Point Surface"
    for key, value in PROPERTIES.items():
        assert getattr(display, key) == value, f"{name}: {key} is {getattr(display, key)}"
    difference = abs(scene.picture(view, name) - expected).mean()
    print(f"{name}: difference {difference:.4f} grey levels")
    assert difference < 0.01


expected = scene.picture(session(), "session")
assert scene.covered(expected).mean() > 0.3

# both kinds of state
script = smstate.get_state()
state = os.path.join(scene.OUTPUT, "state.pvsm")
simple.SaveState(state)
fresh()
simple.LoadState(state)
check("state", expected)

fresh()
exec(compile(script, "state.py", "exec"), {})
check("python-state", expected)

# a trace
fresh()
smtrace.start_trace()
session(traced=True)
trace = smtrace.stop_trace()
with open(os.path.join(scene.OUTPUT, "trace.py"), "w") as file:
    file.write(trace)
assert "PointSurfaceSystem = 'Direct'" in trace, trace
fresh()
exec(compile(trace, "trace.py", "exec"), {})
check("trace", expected)
