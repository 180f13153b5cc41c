#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Speed against error, by `pointsurface bench`, with the EWA splats of Testing/Reference as the yardstick of errors.

    python3 Testing/Benchmarks/bench.py [OPTIONS OF pointsurface bench]

PYTHONPATH must lead to the package pointsurface.
"""

import os
import sys

REFERENCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Reference")
paths = [REFERENCE, *filter(None, [os.environ.get("PYTHONPATH")])]
os.environ["PYTHONPATH"] = os.pathsep.join(paths)  # of the processes that measure, too
os.execv(sys.executable, [sys.executable, "-m", "pointsurface", "bench", *sys.argv[1:]])
