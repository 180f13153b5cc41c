# SPDX-License-Identifier: BSD-3-Clause
"""Render passes over whatever a renderer draws, by the names that a user types."""

from vtkmodules.vtkRenderingOpenGL2 import (
    vtkCameraPass,
    vtkEDLShading,
    vtkLightsPass,
    vtkOpaquePass,
    vtkOpenGLFXAAPass,
    vtkOverlayPass,
    vtkRenderPassCollection,
    vtkSequencePass,
    vtkSSAOPass,
    vtkTranslucentPass,
    vtkVolumetricPass,
)

from . import (
    vtkBackgroundFillPass,
    vtkDepthAntialiasingPass,
    vtkFeatureLinePass,
    vtkImageSpacePass,
    vtkOccludedFillPass,
    vtkSilhouettePass,
    vtkSurfaceSmoothingPass,
)

PASSES = {
    "background-fill": vtkBackgroundFillPass,
    "occluded-fill": vtkOccludedFillPass,
    "smoothing": vtkSurfaceSmoothingPass,
    "antialiasing": vtkDepthAntialiasingPass,
    "silhouettes": vtkSilhouettePass,
    "feature-lines": vtkFeatureLinePass,
    "edl": vtkEDLShading,
    "ssao": vtkSSAOPass,
    "fxaa": vtkOpenGLFXAAPass,
}


def apply(renderer, passes):
    """Lets a vtkRenderer draw through passes from now on: objects, the first one next to what is drawn; none: as usual.

    Points, meshes and volumes go through them, but not what lies on top of the picture, such as text.
    """
    if renderer.GetPass() is not None and renderer.GetRenderWindow() is not None:
        renderer.GetPass().ReleaseGraphicsResources(renderer.GetRenderWindow())
    if not passes:
        renderer.SetPass(None)
        return
    drawn = _sequence(vtkLightsPass(), vtkOpaquePass(), vtkTranslucentPass(), vtkVolumetricPass())
    # VTK's own passes have to have the camera within, ours the overlay without.
    inner = next((i for i, each in enumerate(passes) if not isinstance(each, vtkImageSpacePass)), len(passes))
    drawn = _chain(drawn, passes[:inner])
    camera = vtkCameraPass()
    camera.SetDelegatePass(_sequence(drawn, vtkOverlayPass()))
    renderer.SetPass(_chain(camera, passes[inner:]))


def by_names(names, renderer):
    """The passes of these names, for apply(), with what depends on the scale of the scene."""
    passes = [PASSES[name]() for name in names]
    low, high = (renderer.ComputeVisiblePropBounds()[i::2] for i in (0, 1))
    diagonal = sum((b - a) ** 2 for a, b in zip(low, high)) ** 0.5
    for each in passes:
        if isinstance(each, vtkSSAOPass):
            each.SetRadius(0.05 * diagonal)
            each.SetBias(0.002 * diagonal)
            each.SetKernelSize(128)
            each.BlurOn()
    return passes


def _chain(drawn, passes):
    for each in passes:
        each.SetDelegatePass(drawn)
        drawn = each
    return drawn


def _sequence(*passes):
    collection = vtkRenderPassCollection()
    for render_pass in passes:
        collection.AddItem(render_pass)
    sequence = vtkSequencePass()
    sequence.SetPasses(collection)
    return sequence
