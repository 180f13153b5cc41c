# SPDX-License-Identifier: BSD-3-Clause
"""Open3D's offscreen renderer, to be measured beside the mappers of this package; see bench_stage.py.

    python3 open3d_peer.py SCENE.npz RESULT.npz

A program of its own, without VTK: the two bring graphics libraries of their own, and Open3D ends the process where it has
none that it can use (from 0.20 on it needs a driver of Vulkan; Debian's mesa-vulkan-drivers has one in software).

SCENE: "points" (n, 3), "colors" (n, 3) from 0 to 1, drawn as they are; "point_size" in pixels; "size" (width, height);
"background"; "center", "up" and "eyes" (frames, 3) of the camera, its "angle" and clipping "range"; "warm_up" frames, and
"most_seconds", after which there are no more frames than one behind these.
RESULT: "color" (height, width, 3) from 0 to 1 and "depth" (height, width), 0 where nothing is drawn, both of the first eye
and with row 0 at the bottom; "milliseconds" and "processor_milliseconds", medians of so many "frames", each with its reading
back; "first_milliseconds", from the points to the first frame.
"""

import sys

if __name__ == "__main__" and not getattr(sys.flags, "safe_path", False):
    del sys.path[0]  # the folder of the package, whose modules are not to be taken for others of their names

import time
from statistics import median

import numpy as np
import open3d
from open3d.visualization import rendering


def main(scene_path, result_path):
    scene = np.load(scene_path)
    warm_up, most_seconds = int(scene["warm_up"]), float(scene["most_seconds"])
    began = time.perf_counter()
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(scene["points"]))
    cloud.colors = open3d.utility.Vector3dVector(scene["colors"])
    material = rendering.MaterialRecord()
    material.shader = "defaultUnlit"
    material.point_size = float(scene["point_size"])
    renderer = rendering.OffscreenRenderer(*map(int, scene["size"]))
    renderer.scene.view.set_post_processing(False)  # no tone mapping, and values as they are; but the background as sRGB
    renderer.scene.set_background([*3 * [1.055 * float(scene["background"]) ** (1 / 2.4) - 0.055], 1])
    renderer.scene.add_geometry("points", cloud, material)

    def look_from(eye):
        center, up = (scene[name].astype(np.float32) for name in ("center", "up"))
        renderer.setup_camera(float(scene["angle"]), center, eye.astype(np.float32), up, *map(float, scene["range"]))

    look_from(scene["eyes"][0])
    color = np.asarray(renderer.render_to_image())[::-1, :, :3] / 255
    first_milliseconds = 1e3 * (time.perf_counter() - began)
    depth = np.asarray(renderer.render_to_depth_image(z_in_view_space=True))[::-1]
    times, began = [], time.perf_counter()
    for eye in scene["eyes"]:
        if len(times) > warm_up and time.perf_counter() > began + most_seconds:
            break
        look_from(eye)
        start, processor = time.perf_counter(), time.process_time()
        renderer.render_to_image()
        times.append((1e3 * (time.perf_counter() - start), 1e3 * (time.process_time() - processor)))
    milliseconds, processor_milliseconds = (median(column) for column in zip(*times[warm_up:]))
    np.savez(
        result_path,
        color=color,
        depth=np.where(np.isfinite(depth), depth, 0),
        milliseconds=milliseconds,
        processor_milliseconds=processor_milliseconds,
        frames=len(times) - warm_up,
        first_milliseconds=first_milliseconds,
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
