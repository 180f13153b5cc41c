# SPDX-License-Identifier: BSD-3-Clause
"""check_visualizer.py PROGRAM FOLDER: the example Examples/Cxx/pcl_visualizer draws a sphere, closed and of the right size."""

import os
import subprocess
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

program, folder = sys.argv[1:]
cloud, picture = os.path.join(folder, "visualizer.pcd"), os.path.join(folder, "visualizer.png")

count = 20000
z = 1 - (2 * np.arange(count) + 1) / count
angle = np.arange(count) * np.pi * (3 - 5**0.5)
r = np.sqrt(1 - z**2)
normals = np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=1)
with open(cloud, "wb") as file:
    file.write(
        b"FIELDS x y z normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4\nTYPE F F F F F F\nCOUNT 1 1 1 1 1 1\n"
        b"WIDTH %d\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA binary\n" % (count, count)
    )
    file.write(np.hstack([normals, normals]).astype("<f4").tobytes())

subprocess.run([program, cloud, picture], check=True)
reader = vtkPNGReader()
reader.SetFileName(picture)
reader.Update()
width, height, _ = reader.GetOutput().GetDimensions()
lit = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1)[:, :, 0] > 0

# The camera sees the sphere that bounds the box, whose radius is sqrt(3), under 30 degrees.
distance = np.sqrt(3) / np.sin(np.radians(15))
radius = height / 2 / np.tan(np.radians(15)) * np.tan(np.arcsin(1 / distance))
y, x = np.mgrid[:height, :width]
from_center = np.hypot(x - (width - 1) / 2, y - (height - 1) / 2)
outside = lit & (from_center > radius + 2)
unlit = ~lit & (from_center < radius - 2)
print(f"{width} x {height}: {outside.sum()} lit pixels outside the sphere, {unlit.sum()} unlit ones inside")
sys.exit(not (height == 600 and outside.sum() == 0 and unlit.sum() == 0))
