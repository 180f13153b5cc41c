#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the gallery: runs the examples, keeps their pictures in pictures/gallery/, and writes GALLERY.md beside itself.

    python3 Examples/gallery.py
"""

import ast
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPTS = os.path.join(HERE, "Python")
PICTURES = os.path.join(HERE, "pictures", "gallery")


def names():
    return sorted(name[:-3] for name in os.listdir(SCRIPTS) if name.endswith(".py"))


def page():
    """The page, as Markdown: of each example its name, what it says of itself, and its picture."""
    parts = ["# Gallery", "The pictures of the examples, as `Examples/gallery.py` made them."]
    for name in names():
        with open(os.path.join(SCRIPTS, f"{name}.py"), encoding="utf-8") as file:
            what = ast.get_docstring(ast.parse(file.read())).splitlines()[0]
        parts += [f"## [{name}](Python/{name}.py)", what, f"![{what}](pictures/gallery/{name}.png)"]
    return "\n\n".join(parts) + "\n"


def main():
    os.makedirs(PICTURES, exist_ok=True)
    for name in names():
        print(f"{name} ...", file=sys.stderr, flush=True)
        picture = os.path.join(PICTURES, f"{name}.png")
        subprocess.run([sys.executable, os.path.join(SCRIPTS, f"{name}.py"), picture], check=True)
    with open(os.path.join(HERE, "GALLERY.md"), "w", encoding="utf-8") as file:
        file.write(page())


if __name__ == "__main__":
    main()
