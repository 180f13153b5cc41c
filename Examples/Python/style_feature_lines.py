# SPDX-License-Identifier: BSD-3-Clause
"""A dense cloud with lines where it bends sharply.

style_feature_lines.py [PICTURE [FILE [ISOVALUE]]]: FILE holds points, or a volume whose isosurface is drawn; without
it, it is the gyroid of a made-up volume.
"""

import sys

from pointsurface import rendering, scene, styles, subjects, vtkImageSpacePointMapper

picture, *file = sys.argv[1:] or ["style_feature_lines.png"]
subject = subjects.load(file[0], *map(float, file[1:])) if file else subjects.gyroid(300)

mapper = vtkImageSpacePointMapper()
mapper.SetInputData(subject.points)
renderer = scene.make_scene(subject, mapper)
renderer.GetActors().GetLastActor().GetProperty().BackfaceCullingOn()  # normals point outward
renderer.SetBackground(1, 1, 1)
for lines in styles.apply(renderer, "feature lines"):
    lines.SetThreshold(0.8)  # a line where normals two pixels apart have a smaller cosine

window = rendering.offscreen_window(renderer, (400, 400))
rendering.write_png(picture, rendering.read_color(window))
