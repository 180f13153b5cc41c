#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Scripts/test-paraview.sh [ARGUMENTS OF CTEST]: builds the plugin for ParaView and tests it off-screen, in a folder with a
# Debian 12 of its own, since ParaView's development package takes the place of VTK's. The folder, 4 GB, is made by the
# first run and used again by later ones: $POINTSURFACE_PARAVIEW_ROOT, or pointsurface-paraview in the user's cache. Ends
# with 77 (skipped) where that cannot be: it takes root, for chroot, and a Debian whose apt knows Debian 12.
# shellcheck source=lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

root=${POINTSURFACE_PARAVIEW_ROOT:-${XDG_CACHE_HOME:-$HOME/.cache}/pointsurface-paraview}
shared=$source_dir/../shared

# The second line is what ParaView's own packages forget to ask for.
packages=(paraview-dev python3-paraview cmake g++ iproute2 libgl1-mesa-dri ninja-build xvfb
  libdouble-conversion-dev libegl-dev libeigen3-dev libexpat1-dev libfreetype-dev libgl-dev libglew-dev libglx-dev
  libjpeg-dev libjsoncpp-dev liblz4-dev liblzma-dev libopengl-dev libopenmpi-dev libpng-dev libprotobuf-dev
  libpugixml-dev libqt5svg5-dev libtiff-dev libutfcpp-dev protobuf-compiler python3-dev qtbase5-dev qttools5-dev)

skip() {
  say "skipped: $*"
  exit 77
}

# in_root COMMAND...: runs it in the folder. The source tree and the shared models lie in /src there, read-only; all that
# is mounted for it goes with the command. With alone=yes it has a network of its own, where no other X server is.
in_root() {
  unshare --mount ${alone:+--net} --propagation private bash -euo pipefail -c '
    root=$1 source=$2 shared=$3
    shift 3
    mount -t proc proc "$root/proc"
    mount -t sysfs sysfs "$root/sys"
    mount --rbind /dev "$root/dev"
    mkdir -p "$root/src/pointsurface" "$root/src/shared"
    mount --bind --options ro "$source" "$root/src/pointsurface"
    [[ ! -d $shared ]] || mount --bind --options ro "$shared" "$root/src/shared"
    [[ ! ${alone:-} ]] || chroot "$root" ip link set lo up
    exec chroot "$root" env --ignore-environment PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
      DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} "$@"' \
    bash "$root" "$source_dir" "$shared" "$@"
}

is_debian || skip "this system is not Debian or Ubuntu"
((EUID == 0)) || skip "the plugin is tested in a chroot, which takes root"
unshare --mount true 2>/dev/null || skip "this machine lets nobody mount"
install_packages debootstrap --
eval "$(apt-config shell http_proxy Acquire::http::Proxy)"
export http_proxy=${http_proxy:-}

if [[ ! -f $root/made ]]; then
  mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Codename: bookworm' 'Component: main' |
    head --lines 1)
  [[ $mirror ]] || skip "apt of this machine knows no Debian 12 (bookworm)"
  mkdir -p "$root"
  [[ -z $(ls -A "$root") ]] || stop "$root holds something else, or a beginning; remove it, or name another folder"
  say "making a Debian 12 in $root"
  nice debootstrap --variant=minbase bookworm "$root" "$mirror" >"$root.log" 2>&1 ||
    stop "debootstrap failed; see $root.log"
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io" # a crash costs no more than a new folder
  touch "$root/made"
fi
if [[ $(cat "$root/packages" 2>/dev/null) != "${packages[*]}" ]]; then
  say "installing ParaView there (this takes minutes)"
  cp --dereference /etc/resolv.conf /etc/hosts "$root/etc/"
  for command in update "install --yes --no-install-recommends ${packages[*]}"; do
    # shellcheck disable=SC2086
    in_root nice apt-get --quiet=2 $command >"$root.log" 2>&1 || stop "apt-get failed; see $root.log"
  done
  echo "${packages[*]}" >"$root/packages"
fi

say "building the plugin"
in_root cmake -S /src/pointsurface/Examples/ParaView -B /build -G Ninja >"$root.log" 2>&1 ||
  stop "cmake failed; see $root.log"
in_root nice cmake --build /build
say "testing it; pictures are in $root/build/Testing/Temporary"
alone=yes in_root nice bash -c '
  exec 3< <(exec Xvfb -displayfd 1 -noreset -screen 0 1280x1024x24 2>/dev/null)
  trap "kill $!" EXIT
  read -r display <&3
  DISPLAY=:$display ctest --test-dir /build --output-on-failure "$@"' bash "$@"
