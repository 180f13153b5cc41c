// SPDX-License-Identifier: BSD-3-Clause
// What makes the loops over pixels and points of the CPU steps run on all lanes of a processor.
// Such a loop stands in a function marked VTK_POINT_SURFACE_CLONES, which is compiled for AVX-512
// (by its masks, on lanes of 256 bits), for AVX2 and for the plain instruction set; the loader
// picks one when the library is loaded. What it calls is VTK_POINT_SURFACE_INLINE, so that it is
// compiled for the same. All forms compute the same bits, as none fuses multiplications with
// additions; -ffp-contract=off, which CMakeLists.txt sets, sees to that. A choice by a truth value
// that the loop does not change keeps GCC from using the lanes: choose by a number (-fopt-info-vec
// tells). Elsewhere than on x86-64 with GNU's C library the macros are empty or the usual, and one
// plain form is compiled.
#ifndef vtkPointSurfaceVectorize_h
#define vtkPointSurfaceVectorize_h

#include <cstddef> // defines __GLIBC__ where that is the C library

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define VTK_POINT_SURFACE_SANITIZED // the loader picks before a sanitizer is ready to watch it
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) ||                         \
  __has_feature(memory_sanitizer)
#define VTK_POINT_SURFACE_SANITIZED
#endif
#endif

#if defined(__x86_64__) && defined(__GLIBC__) && defined(__OPTIMIZE__) && !defined(__AVX2__) &&    \
  !defined(VTK_POINT_SURFACE_SANITIZED) &&                                                         \
  ((defined(__clang__) && __clang_major__ >= 14) || (!defined(__clang__) && __GNUC__ >= 8))
#if !defined(__clang__) && __GNUC__ >= 12
#define VTK_POINT_SURFACE_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define VTK_POINT_SURFACE_CLONES __attribute__((target_clones("avx2", "default")))
#endif
#else
#define VTK_POINT_SURFACE_CLONES
#endif

#if defined(__GNUC__)
#define VTK_POINT_SURFACE_INLINE inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define VTK_POINT_SURFACE_INLINE __forceinline
#else
#define VTK_POINT_SURFACE_INLINE inline
#endif

// Fetches what an address points at into the cache, ahead of its use: to be read, or to be written.
#if defined(__GNUC__)
#define VTK_POINT_SURFACE_FETCH_TO_READ(address) __builtin_prefetch(address)
#define VTK_POINT_SURFACE_FETCH_TO_WRITE(address) __builtin_prefetch(address, 1)
#else
#define VTK_POINT_SURFACE_FETCH_TO_READ(address)
#define VTK_POINT_SURFACE_FETCH_TO_WRITE(address)
#endif

// Before a loop: its turns do not depend on each other; the same of a loop with a turn for each
// lane, which would be written out otherwise; and: it is short, write its turns out.
#if defined(__clang__)
#define VTK_POINT_SURFACE_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#define VTK_POINT_SURFACE_LANES VTK_POINT_SURFACE_INDEPENDENT
#define VTK_POINT_SURFACE_UNROLL _Pragma("clang loop unroll(full)")
#elif defined(__GNUC__)
#define VTK_POINT_SURFACE_INDEPENDENT _Pragma("GCC ivdep")
#define VTK_POINT_SURFACE_LANES _Pragma("GCC ivdep") _Pragma("GCC unroll 1")
#define VTK_POINT_SURFACE_UNROLL _Pragma("GCC unroll 8")
#else
#define VTK_POINT_SURFACE_INDEPENDENT
#define VTK_POINT_SURFACE_LANES
#define VTK_POINT_SURFACE_UNROLL
#endif

#endif
