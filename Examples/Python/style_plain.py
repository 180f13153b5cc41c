# SPDX-License-Identifier: BSD-3-Clause
"""A dense cloud as a closed surface: image-space rendering with no lines, the first of its styles.

style_plain.py [PICTURE [FILE [ISOVALUE]]]: FILE holds points, or a volume whose isosurface is drawn; without
it, it is the gyroid of a made-up volume.
"""

import sys

from pointsurface import rendering, scene, styles, subjects, vtkImageSpacePointMapper

picture, *file = sys.argv[1:] or ["style_plain.png"]
subject = subjects.load(file[0], *map(float, file[1:])) if file else subjects.gyroid(300)

mapper = vtkImageSpacePointMapper()
mapper.SetInputData(subject.points)
renderer = scene.make_scene(subject, mapper)
renderer.GetActors().GetLastActor().GetProperty().BackfaceCullingOn()  # normals point outward
renderer.SetBackground(1, 1, 1)
styles.apply(renderer, "plain")

window = rendering.offscreen_window(renderer, (400, 400))
rendering.write_png(picture, rendering.read_color(window))
