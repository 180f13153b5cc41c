# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark of what is claimed: what it calls met, and that its table has what it measured."""

import importlib
import os

import numpy as np
import pytest

BENCHMARKS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Benchmarks")


@pytest.fixture(scope="module")
def claims():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(BENCHMARKS)
        patch.setenv("POINTSURFACE_SHARED_DATA", "")  # no models
        module = importlib.import_module("claims")
        patch.setattr(module, "measure_apart", lambda script, *case: module.measure(*case))  # in this process
        patch.setattr(module, "FRAMES", 1)
        patch.setattr(module, "PROCESSES", 1)
        yield module


def test_what_is_met(claims):
    def at_least_two(value):
        return value >= 2

    assert claims.judge([2, 1, 2], at_least_two) == "yes"
    assert claims.judge([1, 2, 2], at_least_two) == "with 4 samples"
    assert claims.judge([1, 1, 2], at_least_two) == "with FXAA"
    assert claims.judge([1, 1, 1], at_least_two) == "no"
    assert claims.judge([1], at_least_two) == "no"


def test_times_are_medians_of_processes_that_take_turns(claims, monkeypatch):
    drawn, milliseconds = [], iter((9, 1, 5, 2, 7, 30))

    def measure_apart(_script, _what, *case):
        drawn.append(case)
        return {"milliseconds": next(milliseconds), "mapper": case[0]}

    monkeypatch.setattr(claims, "measure_apart", measure_apart)
    monkeypatch.setattr(claims, "PROCESSES", 3)
    auto, mesh = (claims.AUTO, 5, "OpenGL"), (claims.MESH, 5, "CPU")
    measured = claims.measure_times([(5, claims.AUTO, claims.MESH, "OpenGL", 1)])
    assert drawn == [auto, mesh] * 3
    assert {case: result["milliseconds"] for case, result in measured.items()} == {auto: 7, mesh: 2}


def test_table(claims):
    times = [(5000, claims.AUTO, claims.GAUSSIAN, "CPU", 1e9), (5000, claims.PULL_PUSH, claims.AUTO, "CPU", 0)]
    table = claims.make_table(times, {(5000, "whole", 1): 20, (5000, "zoomed", 2): 99}, ("whole",), 5000)
    print(table)
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines() if line.startswith("| ")]
    assert [row[-1] for row in rows if "5000 points, CPU" in row[0]] == ["yes", "no"]
    titles = next(row for row in rows if row[0] == "scene" and "met" in row)
    assert titles == ["scene", "drawn by", *claims.WAYS, "at least", "met"]
    auto = [row for row in rows if len(row) == len(titles) and row[1] == claims.AUTO and row[-2] in ("20", "99")]
    assert [row[-1] for row in auto] == ["yes", "no"]
    assert all(20 < float(cell) < 99 for row in auto for cell in row[2:5])
    assert "vtkSurfaceSplatMapper" in table
    outlines = {row[1]: row for row in rows if "whole" in row[0] and row[-2] not in ("20", "99", "1 below auto")}
    assert list(outlines) == [claims.PUBLISHED, claims.PULL_PUSH, claims.AUTO]
    assert outlines[claims.PUBLISHED][3:] == ["", "", "", ""]
    assert float(outlines[claims.AUTO][4]) > float(outlines[claims.AUTO][2])  # FXAA smooths


def test_what_is_near_an_outline(claims):
    mask = np.zeros((9, 9), bool)
    mask[4, 4] = True
    assert claims.grow(mask).sum() == 13  # by two steps along rows and columns
