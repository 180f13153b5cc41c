#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Speed against error, by `pointsurface bench`, with the EWA splats of Testing/Reference as the yardstick of errors.

    python3 Testing/Benchmarks/bench.py [OPTIONS OF pointsurface bench]

PYTHONPATH must lead to the package pointsurface. The models that --full measures with, too, lie in ../shared/data beside
the project, or in the folder POINTSURFACE_SHARED_DATA, or where --data says.
"""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
REFERENCE = os.path.join(HERE, "..", "Reference")
DATA = os.path.abspath(os.path.join(HERE, "..", "..", "..", "shared", "data"))

sys.path.insert(0, REFERENCE)
# Of the processes that measure, too.
os.environ["PYTHONPATH"] = os.pathsep.join([REFERENCE, *filter(None, [os.environ.get("PYTHONPATH")])])
if os.path.isdir(DATA):
    os.environ.setdefault("POINTSURFACE_SHARED_DATA", DATA)

from pointsurface import bench  # noqa: E402
from pointsurface.__main__ import main  # noqa: E402

if __name__ == "__main__":
    bench.PROGRAM = "python3 Testing/Benchmarks/bench.py"
    sys.argv.insert(1, "bench")
    sys.exit(main())
