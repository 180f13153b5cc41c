// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkSamplingDistance_h
#define vtkSamplingDistance_h

#include "vtkType.h"

#include <vector>

class vtkAlgorithm;
class vtkPoints;

/**
 * The distance between neighbouring points of a cloud: a quantile of the distances from points to
 * their nearest neighbours at another position (Kawata and Kanai, section 3.1, take the least one,
 * the quantile 0). Points at one position are no neighbours. Of large clouds a sample of the points
 * is asked, every n-th, but for the quantile 0; all points can be neighbours. Threaded by
 * vtkSMPTools; the same for any number of threads.
 *
 * `ids`: the points that count, all of finite coordinates; empty for all points. `quantile`: 0 to
 * 1. Progress is reported as that of `caller`, which can abort. Returns 0 when that happened or
 * when there are no two positions.
 */
double vtkSamplingDistance(
  vtkPoints* points, const std::vector<unsigned int>& ids, double quantile, vtkAlgorithm* caller);

#endif
