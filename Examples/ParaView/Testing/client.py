# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a cloud that is spread over two ranks where one process alone runs the script: by pvbatch the first of them,
by pvpython the client of their pvserver. It is compared with that of one rank, which has to run first."""

import os

from paraview import simple
from paraview.modules.vtkRemotingCore import vtkProcessModule

SOURCE = f"""
import sys
sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})
import spread
points, arrays = spread.sphere()
output.ShallowCopy(spread.cloud(points, **arrays))
print("rank", spread.rank, "of", spread.ranks, "has", output.GetNumberOfPoints(), "points", flush=True)
"""

in_batch = vtkProcessModule.GetProcessType() == vtkProcessModule.PROCESS_BATCH
if not in_batch:
    simple.Connect("localhost")
import scene  # only now, since it loads the plugin into the server

if not in_batch:
    simple.LoadPlugin(os.environ["POINTSURFACE_PLUGIN"], remote=False, ns=vars(simple))
cloud = simple.ProgrammableSource(OutputDataSetType="vtkPolyData", Script=SOURCE)
view = scene.view(RemoteRenderThreshold=0)
scene.show(cloud, view, "Pull-Push")
name = "batch" if in_batch else "server"
levels = scene.picture(view, f"parallel-2-{name}")
difference, unfilled = scene.compare_with_one_rank(levels, "Pull-Push", 2, label=f"Pull-Push, {name}")
assert cloud.GetDataInformation().GetNumberOfPoints() == 20000
assert in_batch or view.GetClientSideObject().GetUseDistributedRenderingForRender(), "the client draws"
assert difference < 0.01 and unfilled == 0, "differs from the serial picture"
