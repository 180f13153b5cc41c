// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEyeFrame.h"

#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>

namespace
{
/// Coefficients of x, y and z in a clip coordinate.
void GetColumn(vtkMatrix4x4* matrix, int column, double coefficients[3])
{
  for (int k = 0; k < 3; ++k)
  {
    coefficients[k] = matrix->GetElement(k, column);
  }
}

bool IsParallel(vtkMatrix4x4* viewToClip)
{
  double w[3];
  GetColumn(viewToClip, 3, w);
  return vtkMath::Norm(w) == 0.0;
}

/// Where x, y and w are 0: the centre of projection.
void GetCenter(vtkMatrix4x4* viewToClip, double center[3])
{
  vtkNew<vtkMatrix3x3> equations;
  double right[3];
  const int columns[3] = { 0, 1, 3 };
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      equations->SetElement(i, k, viewToClip->GetElement(k, columns[i]));
    }
    right[i] = -viewToClip->GetElement(3, columns[i]);
  }
  equations->Invert();
  equations->MultiplyPoint(right, center);
}

/// Whether lengths and angles stay what they are.
bool IsRigid(vtkMatrix4x4* motion)
{
  double axes[3][3];
  for (int k = 0; k < 3; ++k)
  {
    GetColumn(motion, k, axes[k]);
  }
  bool rigid = true;
  for (int k = 0; k < 3; ++k)
  {
    rigid = rigid && std::abs(vtkMath::Norm(axes[k]) - 1.0) < 1e-9 &&
      std::abs(vtkMath::Dot(axes[k], axes[(k + 1) % 3])) < 1e-9;
  }
  return rigid;
}

/// The rigid motion to the eye.
void FromProjection(vtkMatrix4x4* viewToClip, vtkMatrix4x4* viewToEye)
{
  viewToEye->Identity();
  const bool parallel = IsParallel(viewToClip);
  auto isZero = [&](int row, int column) { return viewToClip->GetElement(row, column) == 0.0; };
  const int alongDepth = parallel ? 2 : 3;
  const bool looksAlongZ = isZero(0, alongDepth) && isZero(1, alongDepth) && isZero(0, 1) &&
    viewToClip->GetElement(2, alongDepth) < 0.0;
  const bool isAtOrigin = isZero(3, 0) && isZero(3, 1) && isZero(3, 3);
  if (looksAlongZ && (parallel || isAtOrigin))
  {
    return;
  }

  double z[3];
  double center[3] = { 0.0, 0.0, 0.0 };
  GetColumn(viewToClip, parallel ? 2 : 3, z);
  vtkMath::MultiplyScalar(z, -1.0 / vtkMath::Norm(z));
  if (!parallel)
  {
    GetCenter(viewToClip, center);
  }
  double y[3];
  GetColumn(viewToClip, 1, y);
  const double alongZ = vtkMath::Dot(y, z);
  for (int k = 0; k < 3; ++k)
  {
    y[k] -= alongZ * z[k];
  }
  vtkMath::Normalize(y);
  double x[3];
  vtkMath::Cross(y, z, x);
  const double* axes[3] = { x, y, z };
  for (int column = 0; column < 3; ++column)
  {
    for (int k = 0; k < 3; ++k)
    {
      viewToEye->SetElement(k, column, axes[column][k]);
    }
    viewToEye->SetElement(3, column, -vtkMath::Dot(center, axes[column]));
  }
}
}

void vtkEyeFrame::FromCamera(
  vtkMatrix4x4* worldToView, vtkMatrix4x4* viewToClip, vtkMatrix4x4* viewToEye)
{
  if (IsRigid(worldToView))
  {
    FromProjection(viewToClip, viewToEye);
    return;
  }
  vtkNew<vtkMatrix4x4> worldToClip;
  vtkMatrix4x4::Multiply4x4(worldToView, viewToClip, worldToClip);
  vtkNew<vtkMatrix4x4> worldToEye;
  FromProjection(worldToClip, worldToEye);
  vtkMatrix4x4::Invert(worldToView, viewToEye);
  vtkMatrix4x4::Multiply4x4(viewToEye, worldToEye, viewToEye);
}

void vtkEyeFrame::StepBack(vtkMatrix4x4* viewToClip, vtkMatrix4x4* modelToView,
  const double bounds[6], vtkMatrix4x4* viewToEye)
{
  if (!IsParallel(viewToClip))
  {
    return;
  }
  double nearest = VTK_DOUBLE_MAX;
  double farthest = -VTK_DOUBLE_MAX;
  vtkNew<vtkMatrix4x4> modelToEye;
  vtkMatrix4x4::Multiply4x4(modelToView, viewToEye, modelToEye);
  for (int corner = 0; corner < 8; ++corner)
  {
    double depth = -modelToEye->GetElement(3, 2);
    for (int k = 0; k < 3; ++k)
    {
      depth -= bounds[2 * k + ((corner >> k) & 1)] * modelToEye->GetElement(k, 2);
    }
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  if (nearest <= 0.0)
  {
    // far enough for a disc that leans towards the eye: as far as the cloud is deep, or the view
    // high
    double y[3];
    GetColumn(viewToClip, 1, y);
    const double back = std::max(farthest - nearest, 1.0 / vtkMath::Norm(y)) - nearest;
    viewToEye->SetElement(3, 2, viewToEye->GetElement(3, 2) - back);
  }
}
