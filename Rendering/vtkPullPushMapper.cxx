// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPullPushMapper.h"

#include "vtkPointProjectionOptions.h"
#include "vtkPointSurfaceView.h"
#include "vtkPullPushOptions.h"
#include "vtkPullPushReconstructionOpenGL.h"
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
  vtkPointSurfaceView View; // that Projected was made for
};

vtkStandardNewMacro(vtkPullPushMapper);

vtkPullPushMapper::vtkPullPushMapper()
  : Internals(new vtkInternals)
{
}

vtkPullPushMapper::~vtkPullPushMapper() = default;

void vtkPullPushMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Internals->Projected.ReleaseGraphicsResources(window);
  this->Internals->Reconstruction.ReleaseGraphicsResources(window);
}

void vtkPullPushMapper::SetToPublished()
{
  this->SubpixelCentersOff();
  this->PerspectiveDiscsOff();
  this->DistanceWeightsOff();
  this->UnionRadiiOff();
  this->FillPixelsOff();
  this->DepthTestInPushOff();
}

void vtkPullPushMapper::MakeSurfaceBuffer(
  vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view, vtkSurfaceTarget& surface)
{
  vtkInternals& internals = *this->Internals;
  vtkPullPushOptions options;
  options.SubpixelCenters = this->SubpixelCenters;
  options.PerspectiveDiscs = this->PerspectiveDiscs;
  options.DistanceWeights = this->DistanceWeights;
  options.DepthTestInPush = this->DepthTestInPush;
  options.UnionRadii = this->UnionRadii;
  options.FillPixels = this->FillPixels;
  vtkPointProjectionOptions projection;
  projection.SubpixelCenters = options.SubpixelCenters;
  projection.CenterDepths = options.PerspectiveDiscs;
  this->ProjectPoints(window, view, projection, surface, internals.Projected);
  internals.View = view;
  internals.Reconstruction.Run(window, view, options, internals.Projected, surface);
  this->LastFrameLevels = internals.Reconstruction.GetLevels();
  this->LastFramePasses = internals.Reconstruction.GetPasses();
}

//------------------------------------------------------------------------------
bool vtkPullPushMapper::ReadProjectedBuffer(vtkImageData* buffer)
{
  vtkOpenGLRenderWindow* window = this->GetLastWindow();
  vtkSurfaceTarget& projected = this->Internals->Projected;
  if (!window || projected.GetWidth() == 0)
  {
    vtkErrorMacro("There is no projected buffer to read: render a frame with this mapper first.");
    return false;
  }
  window->MakeCurrent();
  buffer->Initialize();
  buffer->SetDimensions(projected.GetWidth(), projected.GetHeight(), 1);
  AddLayer(buffer, window, projected, vtkSurfaceTarget::Shape, "Normals", 0, 3);
  AddLayer(buffer, window, projected, vtkSurfaceTarget::Shape, "Radius", 3, 1);
  AddLayer(buffer, window, projected, vtkSurfaceTarget::Interval, "Depth", 0, 1);
  AddLayer(buffer, window, projected, vtkSurfaceTarget::Interval, "Displacement", 2, 2);
  if (projected.Has(vtkSurfaceTarget::Color))
  {
    AddLayer(buffer, window, projected, vtkSurfaceTarget::Color, "Colors", 0, 4);
  }
  if (projected.Has(vtkSurfaceTarget::Id))
  {
    AddLayer(buffer, window, projected, vtkSurfaceTarget::Id, "PointIds", 0, 1);
  }

  vtkNew<vtkDoubleArray> projection;
  projection->SetName("Projection");
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      projection->InsertNextValue(this->Internals->View.VCDC[4 * column + row]);
    }
  }
  buffer->GetFieldData()->AddArray(projection);
  vtkNew<vtkIntArray> levels;
  levels->SetName("Levels");
  levels->InsertNextValue(this->Internals->Reconstruction.GetLevels());
  buffer->GetFieldData()->AddArray(levels);
  return true;
}

void vtkPullPushMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SubpixelCenters: " << this->SubpixelCenters << "\n";
  os << indent << "PerspectiveDiscs: " << this->PerspectiveDiscs << "\n";
  os << indent << "DistanceWeights: " << this->DistanceWeights << "\n";
  os << indent << "UnionRadii: " << this->UnionRadii << "\n";
  os << indent << "FillPixels: " << this->FillPixels << "\n";
  os << indent << "DepthTestInPush: " << this->DepthTestInPush << "\n";
}
