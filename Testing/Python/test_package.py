# SPDX-License-Identifier: BSD-3-Clause
"""The package: what an import gives."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pointsurface
from pointsurface import formats


def test_package_is_the_one_of_this_build():
    assert Path(os.environ["PYTHONPATH"]) in Path(pointsurface.__file__).parents


def test_wrapped_classes_are_exported():
    from pointsurface import vtkPullPushMapper

    mapper = vtkPullPushMapper()
    assert mapper.IsA("vtkPolyDataMapper")


def test_no_display_in_tests():
    assert not os.environ.get("DISPLAY")
    assert Path(os.environ["POINTSURFACE_TEST_OUTPUT"]).is_dir()


def test_a_module_that_is_run_as_a_program_takes_none_beside_it_for_another(tmp_path):
    program = tmp_path / "formats.py"
    shutil.copy(formats.__file__, program)
    (tmp_path / "typing.py").write_text("raise RuntimeError('not the one of Python')")
    run = subprocess.run([sys.executable, program, '["nothing", "vtkNone"]', "no file"], capture_output=True, text=True)
    assert "No module named 'vtkmodules.nothing'" in run.stderr
