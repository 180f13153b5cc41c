# SPDX-License-Identifier: BSD-3-Clause
"""Colours and colour maps by their names."""

from vtkmodules.vtkCommonColor import vtkNamedColors
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

# Evenly spaced from low to high.
COLOR_MAPS = {
    "rainbow": ("#0000ff", "#00ffff", "#00ff00", "#ffff00", "#ff0000"),
    "gray": ("#000000", "#ffffff"),
    "cool-warm": ("#3b4cc0", "#dddddd", "#b40426"),
    "viridis": ("#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"),
}
_COLORS = 256


def parse_color(text):
    """Red, green and blue, 0 to 1, of a name of HTML's or #rrggbb. Raises ValueError."""
    red, green, blue, alpha = vtkNamedColors().HTMLColorToRGBA(text)
    if alpha == 0:
        raise ValueError(f"{text} is no colour: a name as in HTML, or #rrggbb, is needed")
    return red / 255, green / 255, blue / 255


def color_map(name):
    """A vtkLookupTable of a map of COLOR_MAPS, or of matplotlib's if that is installed. Raises ValueError."""
    colors = _own_map(name) if name in COLOR_MAPS else _map_of_matplotlib(name)
    table = vtkLookupTable()
    table.SetNumberOfTableValues(_COLORS)
    for i, color in enumerate(colors):
        table.SetTableValue(i, *color[:3], 1.0)
    return table


def _own_map(name):
    function = vtkColorTransferFunction()
    stops = COLOR_MAPS[name]
    for i, stop in enumerate(stops):
        function.AddRGBPoint(i / (len(stops) - 1), *parse_color(stop))
    return [function.GetColor(i / (_COLORS - 1)) for i in range(_COLORS)]


def _map_of_matplotlib(name):
    known = ", ".join(COLOR_MAPS)
    try:
        from matplotlib import colormaps
    except ImportError:
        raise ValueError(f"{name} is no colour map; known are {known}; more with the package matplotlib 3.5") from None
    if name not in colormaps:
        raise ValueError(f"{name} is no colour map: neither one of {known} nor of matplotlib's")
    return [colormaps[name](i / (_COLORS - 1)) for i in range(_COLORS)]
