# SPDX-License-Identifier: BSD-3-Clause
"""The styles of image-space illustration (Rosenthal and Linsen 2008, section 8), for whatever a renderer draws."""

from . import passes, vtkFeatureLinePass, vtkSilhouettePass

STYLES = {
    "plain": (),
    "silhouettes": (vtkSilhouettePass,),
    "feature lines": (vtkFeatureLinePass,),
    "both": (vtkFeatureLinePass, vtkSilhouettePass),
}


def apply(renderer, style, thickness=2.0, color=(0.0, 0.0, 0.0)):
    """Lets a vtkRenderer draw in one of STYLES from now on; points, meshes and volumes alike, but not what lies on top
    of the picture, such as text.

    thickness: of the lines, in pixels. color: of the lines, each component 0 to 1.
    Returns the passes that draw lines, a list in the order in which they draw, whose thresholds can be set. Renderer
    options that VTK does not combine with passes (UseDepthPeeling, ...) have no effect but with "plain".
    Raises ValueError for a style that is none.
    """
    if style not in STYLES:
        raise ValueError(f'there is no style "{style}"; the styles are {", ".join(STYLES)}')
    lines = [make_pass() for make_pass in STYLES[style]]
    for line_pass in lines:
        line_pass.SetThickness(thickness)
        line_pass.SetColor(*color)
    passes.apply(renderer, lines)
    return lines
