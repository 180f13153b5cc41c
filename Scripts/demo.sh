#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Scripts/demo.sh [FILE] [OPTIONS]: installs what is missing, builds, and draws a head (or the file) from points, with
# pictures in build/demo/. Scripts/demo.sh --help tells the options.
# shellcheck source=lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

install_packages "${build_packages[@]}" -- "${optional_packages[@]}" mricron-data
build
PYTHONPATH=$build_dir/lib/python3/dist-packages \
  exec "$python" -m pointsurface demo --output "$build_dir/demo" "$@"
