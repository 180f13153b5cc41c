#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Scripts/test-wheel.sh: builds the source distribution, of that the wheel, installs this into a fresh virtual environment
# beside VTK's, and runs the Python tests there. Ends with 77 (skipped) where ../shared/sdk, of which vtk-sdk is taken, or a
# package that pip is to bring, is not to be had.
# shellcheck source=lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
unset PYTHONPATH # where ctest runs this it leads to the package in the build tree

work=$build_dir/wheel

skip() {
  say "skipped: $*"
  exit 77
}

# install VENV PACKAGES...
install() { "$work/$1/bin/pip" install --quiet --find-links "$wheel_sdk" "${@:2}" >&2; }

# package OPTIONS... FOLDER: without isolation, since pip's folder for that has another name in each run.
package() {
  "$work/build-venv/bin/python" -m build --no-isolation --outdir "$work/dist" "$@" >>"$work/build.log" 2>&1 || {
    tail --lines 60 "$work/build.log" >&2
    stop "the build has failed; $work/build.log has all of it"
  }
}

[[ -d $wheel_sdk ]] || skip "there is no vtk-sdk in ../shared/sdk to build the wheel with"
mapfile -t build_requires < <("$python" -c '
import sys, tomllib
print(*tomllib.load(open(sys.argv[1], "rb"))["build-system"]["requires"], sep="\n")' "$source_dir/pyproject.toml")
vtk=$(printf '%s\n' "${build_requires[@]}" | grep '^vtk==')
[[ -d $work/build-venv ]] || "$python" -m venv "$work/build-venv"
install build-venv build ninja "cmake>=3.27" "${build_requires[@]}" || skip "pip cannot get what the build needs"

say "building the source distribution, and the wheel of it"
rm -rf "$work/dist" "$work/source" "$work/build.log"
package --sdist "$source_dir"
mkdir "$work/source"
# Its files have no times of their own: they are as old as now, or ninja would not see what has changed.
tar --extract --touch --strip-components 1 --directory "$work/source" --file "$work"/dist/*.tar.gz
package --wheel -C build-dir="$work/build" "$work/source"

# Library, wrappers, stubs and package, and nothing else.
others=$("$python" -m zipfile --list "$work"/dist/*.whl | tail --lines +2 | cut --delimiter ' ' --fields 1 |
  grep --invert-match --extended-regexp --regexp '^pointsurface/([a-z0-9_]+\.py|py\.typed|(lib)?vtkPointSurface[^/]*\.(so|pyi))$' \
    --regexp '^pointsurface-[^/]+\.dist-info/' || true)
[[ -z $others ]] || stop "the wheel holds what is not ours: $others"

say "installing it into a fresh virtual environment"
"$python" -m venv --clear "$work/venv"
install venv pytest pytest-xdist imageio "laspy[lazrs]" pye57 tqdm "$vtk" "pyvista>=0.48" || skip "pip cannot get what the tests need"
install venv --no-index "$work"/dist/*.whl # what it requires is there, then
packages=$("$work/venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("platlib"))')
[[ -f $packages/pointsurface/vtkPointSurface.pyi ]] || stop "the wheel has no type stubs"

say "running the Python tests"
mkdir -p "$work/output"
cd "$work" # not the source tree
# VTK's wheel asks EGL itself for OpenGL's functions, so that the library of lower limits is not heard.
PATH="$work/venv/bin:$PATH" DISPLAY='' POINTSURFACE_TEST_LIMITS='' PYTHONPATH=$packages POINTSURFACE_TEST_OUTPUT=$work/output \
  python -m pytest -q -rs -p no:cacheprovider -n 2 --dist loadfile "$source_dir/Testing/Python"
