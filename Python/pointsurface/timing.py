# SPDX-License-Identifier: BSD-3-Clause
"""Milliseconds a frame, so that the figures of two renderers can be held side by side."""

import time
from statistics import median

STAGES = ("Project", "Reconstruct", "Shade")


def stage_milliseconds(mapper, stages=STAGES):
    """What each stage of a vtkPointSurfaceMapper's last frame took, by the stage's name in lower case."""
    return {stage.lower(): getattr(mapper, f"GetLastFrame{stage}Milliseconds")() for stage in stages}


def time_frames(window, renderer, frames=20, warm_up=3, mapper=None, stages=STAGES):
    """Median milliseconds of a frame, until OpenGL has finished it, with a camera that moves before every frame.

    mapper: a vtkPointSurfaceMapper, whose stages are asked for after each frame, when nothing is left to wait for.
    stages: of the mapper, by the names in its methods GetLastFrame...Milliseconds.
    Returns a dict: "frame", and with a mapper its stages by their names in lower case.
    """
    for _ in range(warm_up):
        _draw_next_frame(window, renderer)
    samples = {"frame": []}
    for _ in range(frames):
        samples["frame"].append(_draw_next_frame(window, renderer))
        if mapper is not None:
            for stage, milliseconds in stage_milliseconds(mapper, stages).items():
                samples.setdefault(stage, []).append(milliseconds)
    return {name: median(milliseconds) for name, milliseconds in samples.items()}


def _draw_next_frame(window, renderer):
    renderer.GetActiveCamera().Azimuth(1)
    renderer.ResetCameraClippingRange()
    window.WaitForCompletion()
    start = time.perf_counter()
    window.Render()
    window.WaitForCompletion()
    return (time.perf_counter() - start) * 1000
