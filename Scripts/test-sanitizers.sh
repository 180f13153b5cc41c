#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Scripts/test-sanitizers.sh [ARGUMENTS OF CTEST]: the filters and their tests under the address, leak and
# undefined-behaviour sanitizers, in build/sanitizers (some five minutes on two cores).
# shellcheck source=lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

install_packages "${build_packages[@]}" --
cmake -S "$source_dir/Testing/Sanitizers" -B "$build_dir/sanitizers" -G Ninja
cmake --build "$build_dir/sanitizers"
exec ctest --test-dir "$build_dir/sanitizers" -j2 --output-on-failure "$@"
