# SPDX-License-Identifier: BSD-3-Clause
"""Every example runs as it stands, says nothing on standard error, and draws what its page promises."""

import os
import subprocess
import sys

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Examples")
SCRIPTS = sorted(name for name in os.listdir(os.path.join(EXAMPLES, "Python")) if name.endswith(".py"))


def near(picture, color, tolerance=0.12):
    return np.abs(picture - color).max(axis=-1) < tolerance


SKIN = np.array((0.7, 0.62, 0.54))

# shares of the picture that have a colour: at least
EXPECTED = {
    "lights.py": lambda p: {"warm": (near(p, (0.95, 0.78, 0.6)), 0.02), "cold": (p[..., 2] > p[..., 0] + 0.2, 0.02)},
    "color_map.py": lambda p: {"red": (near(p, (1, 0.1, 0), 0.3), 0.003), "green": (near(p, (0, 1, 0), 0.3), 0.03)},
    "cut_plane.py": lambda p: {"inside": (p[..., 0] > 1.5 * p[..., 2] + 0.1, 0.1), "outside": (near(p, 0.6, 0.4), 0.01)},
    "picking.py": lambda p: {"cloud": (near(p, 0.8, 0.2), 0.1), "mark": (p[..., 0] > p[..., 1] + 0.4, 0.0005)},
    "mesh_in_cloud.py": lambda p: {
        "mesh outside": (p[..., 0] > 2 * p[..., 2] + 0.1, 0.01),
        "mesh seen through the cloud": (near(p, (0.7, 0.65, 0.55), 0.15), 0.01),
    },
    "volume_and_cloud.py": lambda p: {
        "points": (p[..., 0] > p[..., 2] + 0.2, 0.1),
        "volume": (p[..., 2] > p[..., 0] + 0.05, 0.05),
    },
    "style_plain.py": lambda p: {"surface": (near(p, SKIN, 0.35), 0.3), "no line": (~near(p, 0, 0.1), 0.99)},
    "style_silhouettes.py": lambda p: {"surface": (near(p, SKIN, 0.35), 0.2), "lines": (near(p, (0.1, 0.1, 0.4), 0.1), 0.03)},
    "style_feature_lines.py": lambda p: {"surface": (near(p, SKIN, 0.35), 0.2), "lines": (near(p, 0, 0.1), 0.01)},
    "style_both.py": lambda p: {"surface": (near(p, SKIN, 0.35), 0.2), "lines": (near(p, 0, 0.1), 0.03)},
    "raw_scan.py": lambda p: {"surface": (near(p, (0.5, 0.57, 0.43), 0.35) & (p[..., 1] > p[..., 2]), 0.2)},
    "few_splats.py": lambda p: {
        "order 4": (p[..., 0] > p[..., 1] + 0.2, 0.02),
        "order 2": (p[..., 1] > p[..., 0] + 0.2, 0.02),
    },
    "time_series.py": lambda p: {"surface": (near(p, 0.7, 0.3), 0.1)},
}


def test_every_example_is_listed_and_checked():
    with open(os.path.join(EXAMPLES, "README.md"), encoding="utf-8") as file:
        page = file.read()
    assert SCRIPTS and set(SCRIPTS) == set(EXPECTED)
    assert [name for name in SCRIPTS if f"`{name}`" not in page] == []


def test_gallery_is_up_to_date(monkeypatch):
    monkeypatch.syspath_prepend(EXAMPLES)
    import gallery

    with open(os.path.join(EXAMPLES, "GALLERY.md"), encoding="utf-8") as file:
        assert file.read() == gallery.page(), "run Examples/gallery.py"
    assert sorted(os.listdir(gallery.PICTURES)) == [f"{name[:-3]}.png" for name in SCRIPTS]


@pytest.mark.parametrize("script", SCRIPTS)
def test_example(script, tmp_path):
    picture = tmp_path / "picture.png"
    result = subprocess.run(
        [sys.executable, os.path.join(EXAMPLES, "Python", script), str(picture)], capture_output=True, text=True
    )
    assert result.returncode == 0 and result.stderr == "", result.stderr
    reader = vtkPNGReader()
    reader.SetFileName(str(picture))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, 3) / 255
    for what, (mask, share) in EXPECTED[script](pixels).items():
        assert mask.mean() > share, f"{what}: {mask.mean():.4f}"
