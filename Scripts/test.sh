#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Scripts/test.sh [ARGUMENTS OF CTEST]: installs what is missing, builds, and runs all tests (-R NAME: some of them).
# shellcheck source=lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

install_packages "${build_packages[@]}" python3-pytest python3-venv libx11-dev -- "${optional_packages[@]}" doxygen xvfb xauth xdotool
build
[[ -d $wheel_sdk ]] || say "there is no vtk-sdk in ../shared/sdk: the wheel is neither built nor tested"
exec ctest --test-dir "$build_dir" -j2 --output-on-failure "$@"
