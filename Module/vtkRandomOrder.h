// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRandomOrder_h
#define vtkRandomOrder_h

#include "vtkType.h"

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

/**
 * Brings `count` of the ids, chosen at random, to the front in random order. The same seed gives
 * the same order with every standard library (std::shuffle may differ).
 */
inline void vtkRandomOrder(std::vector<vtkIdType>& ids, vtkIdType count, unsigned int seed)
{
  std::mt19937_64 random(seed);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const auto left = static_cast<std::uint64_t>(ids.size()) - i;
    std::swap(ids[i], ids[i + static_cast<vtkIdType>(random() % left)]);
  }
}

#endif
