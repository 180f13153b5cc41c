// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPullPushMapper.h"

#include "vtkContextNeeds.h"
#include "vtkOutlineTrimCPU.h"
#include "vtkPointProjectionOptions.h"
#include "vtkPointSurfaceView.h"
#include "vtkPointThinning.h"
#include "vtkPullPushParameters.h"
#include "vtkPullPushReconstructionCPU.h"
#include "vtkPullPushReconstructionOpenGL.h"
#include "vtkSurfaceImage.h"
#include "vtkSurfacePixels.h"
#include "vtkSurfaceTarget.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"

class vtkPullPushMapper::vtkInternals
{
public:
  vtkSurfaceTarget Untrimmed;
  vtkSurfaceTarget Projected;
  vtkPullPushReconstructionOpenGL Reconstruction;
  vtkSurfaceImage ProjectedCPU;
  vtkOutlineTrimCPU TrimCPU;
  vtkPullPushReconstructionCPU ReconstructionCPU;
  vtkPointSurfaceView View; // that the projected buffer was made for
};

vtkStandardNewMacro(vtkPullPushMapper);

vtkPullPushMapper::vtkPullPushMapper()
  : Internals(new vtkInternals)
{
}

vtkPullPushMapper::~vtkPullPushMapper()
{
  this->vtkPullPushMapper::ReleaseGraphicsResources(nullptr); // see ~vtkPointSurfaceMapper
}

void vtkPullPushMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Internals->Untrimmed.ReleaseGraphicsResources(window);
  this->Internals->Projected.ReleaseGraphicsResources(window);
  this->Internals->Reconstruction.ReleaseGraphicsResources(window);
}

void vtkPullPushMapper::SetToPublished()
{
  this->SubpixelCentersOff();
  this->AveragePointsOff();
  this->PerspectiveDiscsOff();
  this->DistanceWeightsOff();
  this->UnionRadiiOff();
  this->FillPixelsOff();
  this->DepthTestInPushOff();
  this->BlendPixelsOff();
  this->TrimOutlinesOff();
  this->ThinPointsOff();
}

vtkPullPushOptions vtkPullPushMapper::GetOptions() const
{
  vtkPullPushOptions options;
  options.SubpixelCenters = this->SubpixelCenters;
  options.AveragePoints = this->AveragePoints;
  options.PerspectiveDiscs = this->PerspectiveDiscs;
  options.DistanceWeights = this->DistanceWeights;
  options.DepthTestInPush = this->DepthTestInPush;
  options.UnionRadii = this->UnionRadii;
  options.FillPixels = this->FillPixels;
  options.BlendPixels = this->BlendPixels;
  options.TrimOutlines = this->TrimOutlines;
  return options;
}

vtkPointProjectionOptions vtkPullPushMapper::GetProjectionOptions(
  const vtkPointSurfaceView& view) const
{
  vtkPointProjectionOptions options;
  options.SubpixelCenters = this->SubpixelCenters;
  options.CenterDepths = this->PerspectiveDiscs;
  options.AveragePoints = this->AveragePoints;
  if (this->ThinsPoints())
  {
    // where densities vary, the sparse parts stay whole; and little is saved of small clouds
    constexpr vtkIdType Fewest = 20000;
    // A pixel shows its own points alone, which tell outlines too: it flickers where these are few.
    constexpr double LargestRadius = 0.8;
    vtkPointSurfaceView sparse = view;
    sparse.GrowRadii(view.LargestRadius / view.MeanRadius);
    options.Thinning = vtkPointThinning::GetGroupSize(sparse, LargestRadius, Fewest);
  }
  vtkPointSurfaceView drawn = view;
  drawn.GrowRadii(vtkPointThinning::GetRadiusFactor(options.Thinning));
  constexpr double LargestReach = 16.0; // where surfaces are seen edge-on
  const double share = vtkPullPushParameters::GetShareOfDense(drawn);
  options.LargestReach = static_cast<float>(1.0 + share * (LargestReach - 1.0));
  return options;
}

std::string vtkPullPushMapper::FindLackOfOpenGL()
{
  const std::string lack = this->Superclass::FindLackOfOpenGL();
  return lack.empty()
    ? vtkContextNeeds::FindLackOfPointSize(vtkPullPushReconstructionOpenGL::TileSize)
    : lack;
}

void vtkPullPushMapper::MakeSurfaceBuffer(
  vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view, vtkSurfaceTarget& surface)
{
  vtkInternals& internals = *this->Internals;
  const vtkPointProjectionOptions projection = this->GetProjectionOptions(view);
  internals.View = view;
  internals.View.GrowRadii(vtkPointThinning::GetRadiusFactor(projection.Thinning));
  const vtkPullPushParameters parameters(internals.View, this->GetOptions());
  const bool trims = parameters.TrimsProjected();
  this->ProjectPoints(
    window, view, projection, surface, trims ? internals.Untrimmed : internals.Projected);
  if (trims)
  {
    internals.Reconstruction.Trim(window, parameters, internals.Untrimmed, internals.Projected);
  }
  internals.Reconstruction.Run(window, parameters, internals.Projected, surface);
  this->LastFrameLevels = parameters.GetCoarsestLevel();
  this->LastFramePasses = internals.Reconstruction.GetPasses() + (trims ? 1 : 0);
}

void vtkPullPushMapper::MakeSurfacePixels(
  const vtkPointSurfaceView& view, bool ids, bool colors, vtkSurfacePixels& surface)
{
  vtkInternals& internals = *this->Internals;
  const vtkPointProjectionOptions projection = this->GetProjectionOptions(view);
  this->ProjectPoints(view, projection, ids, colors, internals.ProjectedCPU);
  internals.View = view;
  internals.View.GrowRadii(vtkPointThinning::GetRadiusFactor(projection.Thinning));
  const vtkPullPushParameters parameters(internals.View, this->GetOptions());
  if (parameters.TrimsProjected())
  {
    internals.TrimCPU.Run(parameters, internals.ProjectedCPU);
  }
  internals.ReconstructionCPU.Run(parameters, internals.ProjectedCPU, surface);
  this->LastFrameLevels = parameters.GetCoarsestLevel();
  this->LastFramePasses = 2 * parameters.GetCoarsestLevel() +
    (parameters.Options.FillPixels ? 1 : 0) + (parameters.TrimsProjected() ? 1 : 0);
}

//------------------------------------------------------------------------------
bool vtkPullPushMapper::ReadProjectedBuffer(vtkImageData* buffer)
{
  vtkInternals& internals = *this->Internals;
  const vtkPointSurfaceView& view = internals.View;
  if (!this->ReadProjection(view, internals.Projected, internals.ProjectedCPU, buffer))
  {
    return false;
  }
  vtkNew<vtkDoubleArray> projection;
  projection->SetName("Projection");
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      projection->InsertNextValue(view.VCDC[4 * column + row]);
    }
  }
  buffer->GetFieldData()->AddArray(projection);
  vtkNew<vtkIntArray> levels;
  levels->SetName("Levels");
  levels->InsertNextValue(vtkPullPushParameters(view, this->GetOptions()).GetCoarsestLevel());
  buffer->GetFieldData()->AddArray(levels);
  return true;
}

void vtkPullPushMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SubpixelCenters: " << this->SubpixelCenters << "\n";
  os << indent << "AveragePoints: " << this->AveragePoints << "\n";
  os << indent << "PerspectiveDiscs: " << this->PerspectiveDiscs << "\n";
  os << indent << "DistanceWeights: " << this->DistanceWeights << "\n";
  os << indent << "UnionRadii: " << this->UnionRadii << "\n";
  os << indent << "FillPixels: " << this->FillPixels << "\n";
  os << indent << "DepthTestInPush: " << this->DepthTestInPush << "\n";
  os << indent << "BlendPixels: " << this->BlendPixels << "\n";
  os << indent << "TrimOutlines: " << this->TrimOutlines << "\n";
  os << indent << "ThinPoints: " << this->ThinPoints << "\n";
}
