// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSurfaceView.h"

#include "vtkMath.h"
#include "vtkMatrix4x4.h"

#include <algorithm>
#include <cmath>

double vtkPointSurfaceView::GetLargestStretch(vtkMatrix4x4* matrix)
{
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double row[3] = { matrix->GetElement(axis, 0), matrix->GetElement(axis, 1),
      matrix->GetElement(axis, 2) };
    largest = std::max(largest, vtkMath::Norm(row));
  }
  return largest;
}

void vtkPointSurfaceView::SetExtent(vtkMatrix4x4* modelToEye, const double bounds[6])
{
  this->Rectangle = { 0, 0, this->Size[0], this->Size[1] };
  double nearest = VTK_DOUBLE_MAX;
  double farthest = -VTK_DOUBLE_MAX;
  double corners[8][3];
  for (int c = 0; c < 8; ++c)
  {
    const double model[4] = { bounds[c & 1], bounds[2 + ((c >> 1) & 1)], bounds[4 + (c >> 2)],
      1.0 };
    for (int k = 0; k < 3; ++k)
    {
      corners[c][k] = 0.0;
      for (int i = 0; i < 4; ++i)
      {
        corners[c][k] += model[i] * modelToEye->GetElement(i, k);
      }
    }
    nearest = std::min(nearest, -corners[c][2]);
    farthest = std::max(farthest, -corners[c][2]);
  }
  double center[3];
  this->Diagonal = 0.0;
  for (int c = 0; c < 4; ++c)
  {
    this->Diagonal = std::max(
      this->Diagonal, std::sqrt(vtkMath::Distance2BetweenPoints(corners[c], corners[7 - c])));
  }
  for (int k = 0; k < 3; ++k)
  {
    center[k] = 0.5 * (corners[0][k] + corners[7][k]);
  }
  this->CenterDistance = vtkMath::Norm(center);
  // the linear depth is a float of this range: keep the ends apart
  const double margin = 1e-4 * std::max(farthest - nearest, this->LargestRadius) + 1e-30;
  this->DepthRange = { nearest - margin, farthest + margin };

  const auto& m = this->VCDC;
  const double middleW = std::max(m[15] - 0.5 * m[11] * (nearest + farthest), 1e-30);
  this->TypicalRadius = 0.5 * this->MeanRadius * this->Size[1] * std::abs(m[5]) / middleW;
  const double nearestW = m[15] - m[11] * nearest;
  if (nearestW <= 1e-6 * (m[15] - m[11] * farthest))
  {
    return; // some of the cloud is beside or behind the eye: the whole viewport
  }
  double lower[2] = { VTK_DOUBLE_MAX, VTK_DOUBLE_MAX };
  double upper[2] = { -VTK_DOUBLE_MAX, -VTK_DOUBLE_MAX };
  for (const auto& corner : corners)
  {
    const double w = m[15] + m[11] * corner[2];
    for (int k = 0; k < 2; ++k)
    {
      const double clip =
        m[k] * corner[0] + m[4 + k] * corner[1] + m[8 + k] * corner[2] + m[12 + k];
      lower[k] = std::min(lower[k], clip / w);
      upper[k] = std::max(upper[k], clip / w);
    }
  }
  for (int k = 0; k < 2; ++k)
  {
    // in pixels, with the largest disc around
    const double radius = std::abs(this->LargestRadius * m[5 * k] / nearestW);
    const double size = this->Size[k];
    const double begin = std::floor(0.5 * size * (lower[k] - radius + 1.0)) - 1.0;
    const double end = std::ceil(0.5 * size * (upper[k] + radius + 1.0)) + 1.0;
    this->Rectangle[k] = static_cast<int>(std::min(std::max(begin, 0.0), size));
    this->Rectangle[2 + k] =
      static_cast<int>(std::min(std::max(end, 0.0), size)) - this->Rectangle[k];
  }
}
