#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Scripts/test-wheel.sh: builds the wheel, installs it into a fresh virtual environment beside VTK's, and runs the Python
# tests there. vtk-sdk is taken from ../shared/sdk; ends with 77 (skipped) where that folder is absent.
# shellcheck source=lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

sdk=$source_dir/../shared/sdk
if [[ ! -d $sdk ]]; then
  say "skipped: there is no vtk-sdk in ../shared/sdk to build the wheel with"
  exit 77
fi
# No isolation: pip's folder for it has another name in each run, and all would be built anew.
work=$build_dir/wheel
mapfile -t build_requires < <("$python" -c '
import sys, tomllib
print(*tomllib.load(open(sys.argv[1], "rb"))["build-system"]["requires"], sep="\n")' "$source_dir/pyproject.toml")
[[ -d $work/build-venv ]] || "$python" -m venv "$work/build-venv"
say "building the wheel and the source distribution"
"$work/build-venv/bin/pip" install --quiet --find-links "$sdk" build ninja "cmake>=3.27" "${build_requires[@]}"
rm -rf "$work/dist"
"$work/build-venv/bin/python" -m build --no-isolation --outdir "$work/dist" -C build-dir="$work/build" \
  --wheel "$source_dir"
"$work/build-venv/bin/python" -m build --no-isolation --outdir "$work/dist" --sdist "$source_dir"

say "installing it into a fresh virtual environment"
"$python" -m venv --clear "$work/venv"
"$work/venv/bin/pip" install --quiet pytest pytest-xdist pyvista "$work"/dist/*.whl
packages=$("$work/venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("platlib"))')
[[ -f $packages/pointsurface/vtkPointSurface.pyi ]] || stop "the wheel has no type stubs"
mkdir -p "$work/output"
cd "$work" # not the source tree
PATH="$work/venv/bin:$PATH" DISPLAY='' PYTHONPATH=$packages POINTSURFACE_TEST_OUTPUT=$work/output \
  python -m pytest -q -rs -p no:cacheprovider -n 2 --dist loadfile "$source_dir/Testing/Python"
