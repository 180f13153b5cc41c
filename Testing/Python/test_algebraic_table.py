# SPDX-License-Identifier: BSD-3-Clause
"""The program of the algebraic splats' table: what it measured once it does not measure again, and reports whole."""

import importlib.util
import json
import os

import pytest

BENCHMARKS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Benchmarks")


@pytest.fixture(scope="module")
def algebraic():
    spec = importlib.util.spec_from_file_location("algebraic", os.path.join(BENCHMARKS, "algebraic.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_run_goes_on_where_it_was_stopped(algebraic, monkeypatch, tmp_path):
    row = {"what": "hole-free", "order": 3, "count": 1234, "bytes": 2048, "fit": 1.26, "frame": 7.0, "error": 1e-4,
           "worst": 2e-3, "unfilled": 3e-5}
    printed = {
        "--measure": "a warning\n" + json.dumps({"rows": [row], "renderer": "a renderer"}),
        "--million": "A million points",
        "TestPolynomialRoots": "some words\n| degree | missed |\n",
    }
    ran = []

    def run(*command):
        what = next(word for word in command if word in printed)
        if what == "TestPolynomialRoots" and what not in ran:
            ran.append(what)
            raise KeyboardInterrupt
        ran.append(what)
        return printed[what]

    monkeypatch.setattr(algebraic, "run_alone", run)
    monkeypatch.setattr(algebraic, "sphere_at_zoom", lambda: "| 52 | 1 |")
    with pytest.raises(KeyboardInterrupt):
        algebraic.make_report(["sphere"], "tests", 10, str(tmp_path))
    report = algebraic.make_report(["sphere"], "tests", 10, str(tmp_path))
    assert sorted(ran) == ["--measure", "--million", "TestPolynomialRoots", "TestPolynomialRoots"]
    assert "| sphere | hole-free | 3 | 1234 | 1.2 | 2 | 1.3 | 7 | 0.0100 | 0.200 | 0.003 |" in report
    for line in ("a renderer", "A million points", "| 52 | 1 |", "| degree | missed |"):
        assert line in report
    assert "some words" not in report
    assert algebraic.make_report(["sphere"], "tests", 10, str(tmp_path)) == report and len(ran) == 4
