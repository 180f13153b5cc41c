# SPDX-License-Identifier: BSD-3-Clause
"""The package: what an import gives."""

import os
from pathlib import Path

import pointsurface


def test_package_is_the_one_of_this_build():
    assert Path(os.environ["PYTHONPATH"]) in Path(pointsurface.__file__).parents


def test_wrapped_classes_are_exported():
    from pointsurface import vtkPullPushMapper

    mapper = vtkPullPushMapper()
    assert mapper.IsA("vtkPolyDataMapper")


def test_no_display_in_tests():
    assert not os.environ.get("DISPLAY")
    assert Path(os.environ["POINTSURFACE_TEST_OUTPUT"]).is_dir()
