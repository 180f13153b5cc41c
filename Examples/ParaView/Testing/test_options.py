# SPDX-License-Identifier: BSD-3-Clause
"""What the panel offers does what it says: systems, samples, the passes of Image-Space, the tolerance of Direct, back ends,
normals, and colours that are not mapped."""

import numpy as np
from paraview import simple

import scene

view = scene.view()
mesh = scene.sphere_mesh()


def draw(source, name, system=None, **properties):
    display = scene.show(source, view, system, **properties)
    levels = scene.picture(view, "options-" + name)
    simple.Hide(source, view)
    return levels, display


def noisy_points(noise):
    """The points of the sphere, moved along its normals by chance."""
    return simple.ProgrammableFilter(scene.sphere_points(), Script=f"""
import numpy as np
points = inputs[0].PointData["Normals"]
moved = np.random.RandomState(1).uniform(-{noise}, {noise}, (len(points), 1))
output.Points = points * (1 + moved)
output.PointData.append(points + 10 * moved * points[:, [1, 2, 0]], "Rough")
output.PointData.append(points, "Normals")
output.PointData.append(np.uint8(255 * (0.5 + 0.5 * points)), "colors")
""", CopyArrays=1)


truth, _ = draw(mesh, "mesh")
points = scene.sphere_points()

# the drop-down
_, display = draw(points, "systems", "Automatic")
assert list(display.GetProperty("PointSurfaceSystem").Available) == [
    "Automatic", "Pull-Push", "Image-Space", "Direct", "Algebraic Splats", "Surface Splats"]

# samples of a pixel blend outlines
one, _ = draw(points, "samples-1", "Pull-Push", PointSurfaceSupersampling=1)
four, _ = draw(points, "samples-4", "Pull-Push", PointSurfaceSupersampling=4)
outline = scene.covered(one) != scene.covered(four)
print(outline.sum(), "pixels of the outline are blended")
assert outline.sum() > 100 and np.abs(four - truth).mean() < np.abs(one - truth).mean()

# both back ends make one picture
shaders, _ = draw(points, "shaders", "Pull-Push", PointSurfaceSupersampling=1, PointSurfaceBackend="OpenGL")
threads, _ = draw(points, "threads", "Pull-Push", PointSurfaceBackend="CPU")
assert np.abs(shaders - threads).mean() < 0.1, np.abs(shaders - threads).mean()

# the passes of Image-Space: smoothing, and an outline that blends
rough = noisy_points(0.004)
errors = []
for iterations in (0, 1, 5):
    levels, _ = draw(rough, f"smoothed-{iterations}", "Image-Space", PointSurfaceSmoothingIterations=iterations,
                     PointSurfaceAntialiasOutline=0)
    errors.append(scene.compare(levels, truth, f"smoothed {iterations} times")[1])
print("errors by iterations of smoothing:", errors)
assert errors[0] > errors[1] > errors[2]
hard, _ = draw(points, "outline-hard", "Image-Space", PointSurfaceSmoothingIterations=1)
soft, _ = draw(points, "outline-soft", "Image-Space", PointSurfaceAntialiasOutline=1)
changed = (hard != soft).any(axis=-1)
edge = scene.covered(hard)
inside = np.all([np.roll(edge, (i, j), (0, 1)) for i in (-3, 0, 3) for j in (-3, 0, 3)], axis=0)
print(changed.sum(), "pixels change by a blended outline,", (changed & inside).sum(), "of them inside")
assert changed.sum() > 100 and (changed & inside).sum() < 10

# the tolerance of Direct: none takes the noise of the nearest points as it is
far = noisy_points(0.02)
errors = [scene.compare(draw(far, f"tolerance-{tolerance}", "Direct", PointSurfaceDepthTolerance=tolerance)[0], truth,
                        f"tolerance {tolerance}")[1] for tolerance in (0.0, 0.02)]
assert errors[1] < errors[0]

# normals: of the array that is chosen
smooth, display = draw(rough, "normals", "Pull-Push", SelectNormalArray="Normals")
assert "Rough" in display.GetProperty("SelectNormalArray").Available
of_rough, _ = draw(rough, "normals-rough", "Pull-Push", SelectNormalArray="Rough")
errors = [scene.compare(levels, truth, name)[1] for levels, name in ((smooth, "smooth"), (of_rough, "rough"))]
assert errors[0] < errors[1]

# colours that are in the data
display = scene.show(rough, view, "Pull-Push", SelectNormalArray="Normals")
simple.ColorBy(display, ("POINTS", "colors"))
display.MapScalars = 0
levels = scene.picture(view, "options-colors")
top, bottom = levels[45, 150], levels[260, 150]  # blue is the height
assert top[2] > bottom[2] + 50, (top, bottom)
