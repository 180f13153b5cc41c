#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Scripts/fuzz-pcd.sh [SECONDS]: vtkPCDReader under libFuzzer and the sanitizers, for 600 seconds by default, in
# build/fuzz; the files that it found interesting stay there for the next run. A file that breaks it is left beside them.
# shellcheck source=lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

install_packages "${build_packages[@]}" libpcl-dev clang --
fuzz=$build_dir/fuzz
cmake -S "$source_dir/Testing/PCL/Fuzz" -B "$fuzz" -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++
cmake --build "$fuzz"

# Files to begin with: one of each encoding, of one point.
mkdir -p "$fuzz/corpus"
header='FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\n'
zeros='\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0'
printf "${header}DATA ascii\n1 -2.5 nan 255\n" >"$fuzz/corpus/ascii"
printf "${header}DATA binary\n$zeros" >"$fuzz/corpus/binary"
printf "${header}DATA binary_compressed\n\x11\0\0\0\x10\0\0\0\x0f$zeros" >"$fuzz/corpus/compressed"
printf '"%s"\n' FIELDS SIZE TYPE COUNT WIDTH HEIGHT VIEWPOINT POINTS DATA ascii binary binary_compressed \
  normal_x normal_y normal_z rgba _ 4294967295 2147483648 65536 nan inf >"$fuzz/words"

cd "$fuzz"
exec ./FuzzPCDReader -max_total_time="${1:-600}" -max_len=4096 -rss_limit_mb=2048 -malloc_limit_mb=512 -dict=words \
  -print_final_stats=1 corpus
