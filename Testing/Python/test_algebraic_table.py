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


def row(what, order, **changes):
    return {"what": what, "order": order, "count": 1234, "bytes": 2048, "fit": 1.26, "frame": 7.0, "error": 1e-4,
            "worst": 2e-3, "unfilled": 3e-5, **changes}


def rows(**changes):
    closed = [row("hole-free, s = 1", order, **(changes if order > 1 else {})) for order in (1, 2, 3, 4)]
    return [*closed, row("planes, s = 0.25", 1, bytes=8192)]


MILLION = {"clock": 5.67, "processors": 10.5, "splats": 65937, "memory": 82.4}


def test_a_run_goes_on_where_it_was_stopped(algebraic, monkeypatch, tmp_path):
    table = "| degree | polynomials | solver | count | missed | separated |\n| 2 | hard | shader | 120000 | 2 | 1 |\n"
    printed = {
        "--measure": "a warning\n" + json.dumps({"rows": rows(), "renderer": "a renderer"}),
        "--million": json.dumps(MILLION),
        "TestPolynomialRoots": "some words\n" + table,
        "TestFirstRootShader": table,
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
    assert sorted(ran) == ["--measure", "--million", "TestFirstRootShader", "TestPolynomialRoots", "TestPolynomialRoots"]
    assert "| sphere | hole-free, s = 1 | 3 | 1234 | 1.2 | 2 | 1.3 | 7 | 0.0100 | 0.200 | 0.003 |" in report
    for line in ("a renderer", "5.7 s by the clock", "| 52 | 1 |", "| 2 | hard | shader | 120000 | 2 | 1 |",
                 "| sphere | 0.003, met | 2: 1.2, met | 25, met, 1.0 | 100, not met, 1.0 |",
                 "separated by more than 1e-4, OpenGL | 1, not met | at most 0 |"):
        assert line in report
    assert "some words" not in report and report.count("| degree | polynomials |") == 1
    assert algebraic.make_report(["sphere"], "tests", 10, str(tmp_path)) == report and len(ran) == 5


@pytest.mark.parametrize("changes, expected", [
    ({"unfilled": 2e-3}, "| m | 0.200, not met | 2: 1.2, met | 25, met, 1.0 | 100, not met, 1.0 |"),
    ({"count": 10_000}, "| m | 0.003, met | 2: 10.0, not met | 25, met, 1.0 | 100, not met, 1.0 |"),
    ({"bytes": 4096}, "| m | 0.003, met | 2: 1.2, met | 50, not met, 1.0 | 200, not met, 1.0 |"),
    ({"bytes": 1000}, "| m | 0.003, met | 2: 1.2, met | 12, met, 1.0 | 49, met, 1.0 |"),
    ({"error": 5e-5}, "| m | 0.003, met | 2: 1.2, met | 25, met, 2.0 | 100, not met, 2.0 |"),
    ({"error": 2e-3}, "| m | 0.003, met | none, not met | | |"),
])
def test_claims_are_judged(algebraic, changes, expected):
    assert algebraic.judge_model("m", rows(**changes)) == expected


def test_the_cheapest_order_within_the_error_is_judged(algebraic):
    every = rows()
    every[1]["error"] = 2e-3  # of quadrics
    assert "| 3: 1.2, met |" in algebraic.judge_model("m", every)
