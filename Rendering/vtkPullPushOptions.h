// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPullPushOptions
 * @brief   how a pull-push reconstruction departs from the paper
 *
 * All off is the algorithm of Marroquim, Kraus, Cavalcanti 2007. vtkPullPushMapper has a property
 * of the same name for each, with what it does and what it gains.
 */
#ifndef vtkPullPushOptions_h
#define vtkPullPushOptions_h

struct vtkPullPushOptions
{
  bool SubpixelCenters = false;
  bool AveragePoints = false;
  bool PerspectiveDiscs = false;
  bool DistanceWeights = false;
  bool DepthTestInPush = false;
  bool UnionRadii = false;
  bool FillPixels = false;
  bool BlendPixels = false;
  bool TrimOutlines = false;
};

#endif
