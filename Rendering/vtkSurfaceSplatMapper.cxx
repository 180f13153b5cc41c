// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceSplatMapper.h"

#include "vtkDrawnClouds.h"
#include "vtkSurfacePixels.h"
#include "vtkSurfaceSplatParameters.h"
#include "vtkSurfaceSplattingCPU.h"
#include "vtkSurfaceSplattingOpenGL.h"
#include "vtkSurfaceTarget.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"

class vtkSurfaceSplatMapper::vtkInternals
{
public:
  vtkSurfaceSplattingOpenGL Splatting;
  vtkSurfaceSplattingCPU SplattingCPU;
};

vtkStandardNewMacro(vtkSurfaceSplatMapper);

vtkSurfaceSplatMapper::vtkSurfaceSplatMapper()
  : Internals(new vtkInternals)
{
}

vtkSurfaceSplatMapper::~vtkSurfaceSplatMapper()
{
  this->vtkSurfaceSplatMapper::ReleaseGraphicsResources(nullptr); // see ~vtkPointSurfaceMapper
}

void vtkSurfaceSplatMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Internals->Splatting.ReleaseGraphicsResources(window);
}

vtkSurfaceSplatOptions vtkSurfaceSplatMapper::GetOptions() const
{
  vtkSurfaceSplatOptions options;
  options.BlendRadius = this->BlendRadius;
  options.DepthTolerance = this->DepthTolerance;
  options.ThinPoints = this->ThinsPoints();
  return options;
}

void vtkSurfaceSplatMapper::MakeSurfaceBuffer(
  vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view, vtkSurfaceTarget& surface)
{
  vtkSurfaceSplattingOpenGL& splatting = this->Internals->Splatting;
  const vtkSurfaceSplatParameters parameters(view, this->GetOptions());
  const auto clouds = this->GetDrawnClouds(view, parameters.Thinning, this->BlendRadius).OpenGL;
  this->BeginProjection();
  splatting.FindDepths(window, parameters, clouds);
  this->EndProjection();
  splatting.BlendSplats(window, parameters, clouds, surface);
  this->LastFramePasses = splatting.GetPasses();
}

void vtkSurfaceSplatMapper::MakeSurfacePixels(
  const vtkPointSurfaceView& view, bool ids, bool colors, vtkSurfacePixels& surface)
{
  vtkInternals& internals = *this->Internals;
  const vtkSurfaceSplatParameters parameters(view, this->GetOptions());
  this->BeginProjection();
  internals.SplattingCPU.MakeSplats(
    parameters, this->GetDrawnClouds(view, parameters.Thinning, this->BlendRadius).CPU, colors);
  this->EndProjection();
  internals.SplattingCPU.DrawSplats(parameters, ids, colors, surface);
  this->LastFramePasses = 2;
}

void vtkSurfaceSplatMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BlendRadius: " << this->BlendRadius << "\n";
  os << indent << "DepthTolerance: " << this->DepthTolerance << "\n";
  os << indent << "ThinPoints: " << this->ThinPoints << "\n";
}
