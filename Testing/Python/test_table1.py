# SPDX-License-Identifier: BSD-3-Clause
"""The table's program on a small case: it must run, not be fast."""

import importlib.util
import os
import re

BENCHMARKS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Benchmarks")


def test_small_table(monkeypatch, tmp_path):
    monkeypatch.setenv("POINTSURFACE_SHARED_DATA", str(tmp_path))  # no models
    monkeypatch.syspath_prepend(BENCHMARKS)
    spec = importlib.util.spec_from_file_location("table1", os.path.join(BENCHMARKS, "table1.py"))
    table1 = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(table1)
    rows = [line for line in table1.make_table(cases=[("bunny", 1000)], sizes=[32]).splitlines() if "32 x 32" in line]
    assert len(rows) == 1
    number = r"(\d+\.\d)"
    ours = rf"{number} \({number}, {number}\)"
    pattern = rf"\| torus \| 1000 \| 32 x 32 \| {ours} \| {ours} \| {number} \| {number} \(\d+\) \|"
    figures = re.fullmatch(pattern, rows[0])
    assert figures, rows[0]
    assert float(figures.group(1)) > 0
