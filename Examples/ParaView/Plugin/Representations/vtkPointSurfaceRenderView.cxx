// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSurfaceRenderView.h"

#include "vtkFeatureLinePass.h"
#include "vtkSilhouettePass.h"

#include "vtkObjectFactory.h"
#include "vtkPVSynchronizedRenderer.h"

vtkStandardNewMacro(vtkPointSurfaceRenderView);

vtkPointSurfaceRenderView::vtkPointSurfaceRenderView()
{
  this->SetLines(SILHOUETTES);
  this->SynchronizedRenderers->SetUseDepthBuffer(true); // where several ranks make one picture
}

vtkPointSurfaceRenderView::~vtkPointSurfaceRenderView() = default;

void vtkPointSurfaceRenderView::SetLines(int lines)
{
  this->Lines = lines;
  vtkImageProcessingPass* pass = nullptr;
  if (lines == SILHOUETTES)
  {
    pass = this->Silhouettes;
  }
  else if (lines == FEATURE_LINES)
  {
    pass = this->FeatureLines;
  }
  this->SynchronizedRenderers->SetImageProcessingPass(pass);
}

void vtkPointSurfaceRenderView::SetLineColor(double r, double g, double b)
{
  this->Silhouettes->SetColor(r, g, b);
  this->FeatureLines->SetColor(r, g, b);
}

void vtkPointSurfaceRenderView::SetLineThickness(double thickness)
{
  this->Silhouettes->SetThickness(thickness);
  this->FeatureLines->SetThickness(thickness);
}

void vtkPointSurfaceRenderView::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Lines: " << this->Lines << "\n";
}
