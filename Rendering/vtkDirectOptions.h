// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDirectOptions
 * @brief   how a direct reconstruction departs from the paper
 *
 * As it is here it is the algorithm of Kawata and Kanai. vtkDirectPointMapper has a property of the
 * same name for each, with what it does and what it gains.
 */
#ifndef vtkDirectOptions_h
#define vtkDirectOptions_h

struct vtkDirectOptions
{
  bool PublishedResolution = true;
  bool FarthestPoints = true;
  bool WeightedNormals = false;
  bool PlaneSplats = false;
  bool DepthTestInSplats = false;
  bool AdaptiveResolution = false;
  double DepthTolerance = 0.0075; ///< gamma, as a fraction of the bounding box's diagonal
};

#endif
