# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034
# What demo.sh and test.sh have in common: packages of Debian, and the build. Each sources this file.
set -euo pipefail

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build_dir=$source_dir/build
os_release=${POINTSURFACE_OS_RELEASE:-/etc/os-release}

# Where test-wheel.sh takes vtk-sdk from.
wheel_sdk=$source_dir/../shared/sdk

# Another python on PATH has no VTK of Debian's.
python=/usr/bin/python3

# Optional packages that apt-get could not install, so that a later run does not try again.
not_to_be_had=$build_dir/packages-not-to-be-had

# What a build can do without, for .pcd files: 60 MB, a minute or two (it brings VTK's modules for Qt).
optional_packages=(libpcl-dev)

# libgl1-mesa-dri: Mesa's drivers, the software renderer among them.
build_packages=(g++ cmake ninja-build libvtk9-dev libeigen3-dev libegl-dev libgl1-mesa-dri python3-vtk9 python3-numpy)

say() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; }

stop() {
  say "$*"
  exit 2
}

is_debian() { # also what derives from it
  [[ -r $os_release ]] && (
    # shellcheck source=/dev/null
    . "$os_release"
    [[ " ${ID:-} ${ID_LIKE:-} " =~ \ (debian|ubuntu)\  ]]
  )
}

missing_of() { # the names among the arguments that are not installed
  local package
  for package; do
    [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] ||
      echo "$package"
  done
}

as_root() {
  if ((EUID == 0)); then
    "$@"
  else
    sudo "$@"
  fi
}

# install_packages REQUIRED... -- OPTIONAL...: installs what is missing; stops where a required package cannot be had.
install_packages() {
  local required=() optional=()
  while [[ $# -gt 0 && $1 != -- ]]; do
    required+=("$1")
    shift
  done
  optional=("${@:2}")

  is_debian || stop "this system is not Debian or Ubuntu; install by hand what these packages of Debian hold:" \
    "${required[*]} (and, if you can, ${optional[*]}), then run cmake -S . -B build and cmake --build build"

  local missing wanted
  mapfile -t missing < <(missing_of "${required[@]}")
  mapfile -t wanted < <(missing_of "${optional[@]}" | grep --invert-match --line-regexp --fixed-strings \
    --file <(cat "$not_to_be_had" 2>/dev/null))
  ((${#missing[@]} + ${#wanted[@]} == 0)) && return

  if ((EUID != 0)) && ! command -v sudo >/dev/null; then
    ((${#missing[@]} == 0)) && return
    stop "packages are missing, and there is no sudo; run as root: apt-get install ${missing[*]} ${wanted[*]}"
  fi
  say "installing from Debian (this can take minutes):" "${missing[@]}" "${wanted[@]}"
  as_root apt-get update --quiet=2 || say "apt-get update failed; trying with the lists that are there"
  if ((${#missing[@]})); then
    apt_install "${missing[@]}" || stop "apt-get could not install: ${missing[*]}"
  fi
  local package
  for package in "${wanted[@]}"; do
    apt_install "$package" || {
      say "going on without the package $package, which is not to be had"
      mkdir -p "$build_dir"
      echo "$package" >>"$not_to_be_had"
    }
  done
}

apt_install() {
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --quiet=2 --no-install-recommends -o Dpkg::Use-Pty=0 "$@" </dev/null >/dev/null
}

build() {
  if [[ ! -f $build_dir/build.ninja ]]; then
    say "configuring into $build_dir"
    cmake -S "$source_dir" -B "$build_dir" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPython3_EXECUTABLE="$python"
  fi
  say "building"
  cmake --build "$build_dir"
}
