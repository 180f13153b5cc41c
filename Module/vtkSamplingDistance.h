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
 * is asked, but for the quantile 0; all points can be neighbours. The sample is chosen by chance,
 * but by positions alone: the order of the points does not matter, nor do the parts that a cloud
 * comes in. Threaded by vtkSMPTools; the same for any number of threads.
 *
 * `ids`: the points that count, all of finite coordinates; empty for all points. `quantile`: 0 to
 * 1. Progress is reported as that of `caller`, which can abort. Returns 0 when that happened or
 * when there are no two positions.
 */
double vtkSamplingDistance(
  vtkPoints* points, const std::vector<unsigned int>& ids, double quantile, vtkAlgorithm* caller);

/**
 * What the sampling distance is taken from: a point that was asked.
 */
struct vtkNeighborDistance
{
  double Lot;      ///< by which the sample is chosen, the lowest first: 0 to 1, by the position
  double Distance; ///< to its nearest neighbour; 0 if it has none
};

///@{
/**
 * The two steps of it, for clouds in parts. Of each part the first step takes the points that the
 * sample of the whole may have: `points`, of finite coordinates, of which the first `own` are asked
 * and all can be neighbours. The second one takes what those of all parts came to, in any order.
 */
std::vector<vtkNeighborDistance> vtkSampleNeighborDistances(
  vtkPoints* points, vtkIdType own, double quantile, vtkAlgorithm* caller);
double vtkSamplingDistance(std::vector<vtkNeighborDistance> distances, double quantile);
///@}

#endif
