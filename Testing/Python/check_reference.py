# SPDX-License-Identifier: BSD-3-Clause
"""check_reference.py CMAKE BUILD: makes the reference of the API (the target PointSurfaceReference), and ends with 1 where
Doxygen has a warning, a class has no words, or a public method of an exported class has none: those that override VTK's have
VTK's."""

import glob
import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")

# What all classes of VTK have.
OF_EVERY_CLASS = ("New", "PrintSelf", "IsA", "GetClassName")


def has_words(node):
    return any("".join(node.find(kind).itertext()).strip() for kind in ("briefdescription", "detaileddescription"))


def methods(definition):
    """Public methods that are declared here for the first time, but for what makes, copies and ends objects."""
    name = definition.find("compoundname").text
    for member in definition.iter("memberdef"):
        if member.get("prot") != "public" or member.get("kind") != "function":
            continue
        own, declaration = member.find("name").text, member.find("argsstring").text
        is_new = not declaration.endswith(("override", "=delete", "=default")) and member.find("reimplements") is None
        if is_new and own.lstrip("~") != name and own not in OF_EVERY_CLASS and own != "operator=":
            yield f"{name}::{own}{declaration}", member


def main(cmake, build):
    made = subprocess.run(
        [cmake, "--build", build, "--target", "PointSurfaceReference"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    faults = [line for line in made.stdout.splitlines() if "warning:" in line or "error:" in line]
    if made.returncode != 0:
        faults.append(made.stdout)
    counts = [0, 0]
    for path in glob.glob(os.path.join(build, "Reference", "xml", "classvtk*.xml")):
        definition = ElementTree.parse(path).getroot().find("compounddef")
        file = definition.find("location").get("file")
        if not file.endswith(".h") or "::" in definition.find("compoundname").text:
            continue
        counts[0] += 1
        if not has_words(definition):
            faults.append(f"{file}: the class has no words")
        with open(os.path.join(SOURCE, file), encoding="utf-8") as header:
            is_exported = "_EXPORT " in header.read()
        for name, member in methods(definition) if is_exported else ():
            counts[1] += 1
            if not has_words(member):
                faults.append(f"{file}:{member.find('location').get('line')}: {name} has no words")
    print(f"{counts[0]} classes, {counts[1]} methods")
    print("\n".join(faults))
    return 1 if faults or counts[0] < 20 or counts[1] < 200 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
