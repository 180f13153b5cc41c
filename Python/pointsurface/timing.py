# SPDX-License-Identifier: BSD-3-Clause
"""Milliseconds a frame, so that the figures of two renderers can be held side by side."""

import time
from statistics import median

STAGES = ("Project", "Reconstruct", "Shade")


def time_frames(window, renderer, frames=20, warm_up=3, mapper=None):
    """Median milliseconds of a frame, until OpenGL has finished it, with a camera that moves before every frame.

    mapper: a vtkPointSurfaceMapper, whose stages are then timed in further frames of the same kind, since asking for
    them waits for the graphics.
    Returns a dict: "frame", and with a mapper "project", "reconstruct" and "shade".
    """
    for _ in range(warm_up):
        _draw_next_frame(window, renderer)
    result = {"frame": median(_draw_next_frame(window, renderer) for _ in range(frames))}
    if mapper is not None:
        stages = {stage: [] for stage in STAGES}
        for _ in range(frames):
            _draw_next_frame(window, renderer)
            for stage, milliseconds in stages.items():
                milliseconds.append(getattr(mapper, f"GetLastFrame{stage}Milliseconds")())
        result.update({stage.lower(): median(milliseconds) for stage, milliseconds in stages.items()})
    return result


def _draw_next_frame(window, renderer):
    renderer.GetActiveCamera().Azimuth(1)
    renderer.ResetCameraClippingRange()
    window.WaitForCompletion()
    start = time.perf_counter()
    window.Render()
    window.WaitForCompletion()
    return (time.perf_counter() - start) * 1000
