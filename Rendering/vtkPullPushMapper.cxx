// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPullPushMapper.h"

#include "vtkContextNeeds.h"
#include "vtkPointProjectionOptions.h"
#include "vtkPointSurfaceView.h"
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
  vtkSurfaceTarget Projected;
  vtkPullPushReconstructionOpenGL Reconstruction;
  vtkSurfaceImage ProjectedCPU;
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
}

vtkPullPushOptions vtkPullPushMapper::GetOptions() const
{
  vtkPullPushOptions options;
  options.SubpixelCenters = this->SubpixelCenters;
  options.PerspectiveDiscs = this->PerspectiveDiscs;
  options.DistanceWeights = this->DistanceWeights;
  options.DepthTestInPush = this->DepthTestInPush;
  options.UnionRadii = this->UnionRadii;
  options.FillPixels = this->FillPixels;
  return options;
}

vtkPointProjectionOptions vtkPullPushMapper::GetProjectionOptions() const
{
  vtkPointProjectionOptions options;
  options.SubpixelCenters = this->SubpixelCenters;
  options.CenterDepths = this->PerspectiveDiscs;
  options.AveragePoints = this->AveragePoints;
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
  this->ProjectPoints(window, view, this->GetProjectionOptions(), surface, internals.Projected);
  internals.View = view;
  const vtkPullPushParameters parameters(view, this->GetOptions());
  internals.Reconstruction.Run(window, parameters, internals.Projected, surface);
  this->LastFrameLevels = parameters.GetCoarsestLevel();
  this->LastFramePasses = internals.Reconstruction.GetPasses();
}

void vtkPullPushMapper::MakeSurfacePixels(
  const vtkPointSurfaceView& view, bool ids, bool colors, vtkSurfacePixels& surface)
{
  vtkInternals& internals = *this->Internals;
  this->ProjectPoints(view, this->GetProjectionOptions(), ids, colors, internals.ProjectedCPU);
  internals.View = view;
  const vtkPullPushParameters parameters(view, this->GetOptions());
  internals.ReconstructionCPU.Run(parameters, internals.ProjectedCPU, surface);
  this->LastFrameLevels = parameters.GetCoarsestLevel();
  this->LastFramePasses =
    2 * parameters.GetCoarsestLevel() + (parameters.Options.FillPixels ? 1 : 0);
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
}
