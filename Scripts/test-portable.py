#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scripts/test-portable.py [BUILD]: what the compilers of other systems would refuse, as far as that shows here.

Every source is compiled by Clang with LLVM's C++ library, as on macOS; every shader, as VTK hands it to OpenGL, by
Khronos's reference compiler, which goes by the letter. It takes a build (default: build/), the packages clang, libc++-dev
and glslang-tools, and some four minutes. Ends with 1 where one of them has an error.
"""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

SOURCE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
KINDS = {"vertex": "vert", "geometry": "geom", "fragment": "frag"}


def compile_source(entry):
    """The errors of Clang, for an entry of ninja's list of commands."""
    words = shlex.split(entry["command"])
    kept = [word for word in words if word.startswith(("-I", "-D"))]
    for i, word in enumerate(words):
        if word == "-isystem":
            kept += words[i : i + 2]
    command = ["clang++", "-fsyntax-only", "-std=c++17", "-stdlib=libc++", "-Wall", "-Wextra", "-Wno-unused-parameter"]
    result = subprocess.run([*command, *kept, entry["file"]], cwd=entry["directory"], capture_output=True, text=True)
    return result.stderr if result.returncode != 0 or "warning:" in result.stderr else ""


def sources(build):
    listed = subprocess.run(["ninja", "-C", build, "-t", "compdb"], capture_output=True, text=True, check=True).stdout
    own = re.compile(re.escape(SOURCE) + r"/(Module|Rendering)/[^/]*\.cxx")
    return {e["file"]: e for e in json.loads(listed) if own.fullmatch(e["file"]) and " -c " in e["command"]}


def draw():
    """What brings forth the shaders, in a process that Mesa keeps them of."""
    sys.path.insert(0, os.path.join(SOURCE, "Testing", "Python"))
    import numpy as np
    from scenes import MAPPERS, Scene, array, torus_cloud
    from vtkmodules.vtkRenderingCore import vtkHardwareSelector
    from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass

    import pointsurface

    for mapper_class in MAPPERS:
        cloud = torus_cloud(5000)
        cloud.GetPointData().SetScalars(array(np.linspace(0, 1, 5000), "height"))
        scene = Scene(mapper_class, cloud, size=(100, 100))
        scene.mapper.SetBackendToOpenGL()
        scene.window.SetMultiSamples(4)
        changes = ["ScalarVisibilityOff", "SetToPublished", "ShadeBeforeSplattingOn"]
        for change in (lambda: scene.mapper.SetSupersampling(2), *(getattr(scene.mapper, c, None) for c in changes)):
            scene.color()
            if change:
                change()
        selector = vtkHardwareSelector()
        selector.SetRenderer(scene.renderer)
        selector.SetArea(0, 0, 99, 99)
        selector.Select()
    for name in ("BackgroundFill", "OccludedFill", "SurfaceSmoothing", "DepthAntialiasing", "Silhouette", "FeatureLine"):
        scene = Scene(MAPPERS[0], torus_cloud(5000), size=(100, 100))
        steps = vtkRenderStepsPass()
        render_pass = getattr(pointsurface, f"vtk{name}Pass")()
        render_pass.SetDelegatePass(steps.GetOpaquePass())
        steps.SetOpaquePass(render_pass)
        scene.renderer.SetPass(steps)
        scene.color()


def shaders(folder):
    """Kind and text of each shader that Mesa has kept in a folder."""
    for name in os.listdir(folder):
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            for part in re.split(r"^\[", file.read(), flags=re.M):
                found = re.match(r"(vertex|geometry|fragment) shader\]\n(.*)", part, re.S)
                if found:
                    yield found.groups()


def compile_shader(shader):
    kind, text = shader
    with tempfile.NamedTemporaryFile("w", suffix=f".{KINDS[kind]}") as file:
        file.write(text)
        file.flush()
        result = subprocess.run(["glslangValidator", file.name], capture_output=True, text=True)
    return result.stdout if result.returncode != 0 else ""


def main(build):
    missing = [tool for tool in ("clang++", "glslangValidator", "ninja") if not shutil.which(tool)]
    if missing:
        sys.exit(f"these are needed: {' '.join(missing)} (Debian: clang libc++-dev glslang-tools ninja-build)")
    package = os.path.join(build, "lib", "python3", "dist-packages")
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        environment = {**os.environ, "PYTHONPATH": package, "DISPLAY": "", "MESA_SHADER_CAPTURE_PATH": folder}
        subprocess.run([sys.executable, __file__, "--draw"], env=environment, check=True)
        texts = set(shaders(folder))
        entries = sources(build)
        said = [*pool.map(compile_shader, texts), *pool.map(compile_source, entries.values())]
    print("".join(said))
    bad = sum("error:" in text.lower() for text in said)
    print(f"{len(texts)} shaders, {len(entries)} sources, {bad} refused")
    return 1 if bad or not texts or not entries else 0


if __name__ == "__main__":
    sys.exit(draw() if sys.argv[1:] == ["--draw"] else main(os.path.abspath((sys.argv[1:] or ["build"])[0])))
