// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDirectPointMapper.h"

#include "vtkDirectParameters.h"
#include "vtkDirectReconstructionCPU.h"
#include "vtkDirectReconstructionOpenGL.h"
#include "vtkDrawablePoints.h"
#include "vtkDuplicatePoints.h"
#include "vtkJointSurface.h"
#include "vtkLitSplatsDec.h"
#include "vtkLitSplatsFetch.h"
#include "vtkLitSplatsImpl.h"
#include "vtkPointProjectionOptions.h"
#include "vtkPointSurfaceView.h"
#include "vtkSurfaceBufferShading.h"
#include "vtkSurfaceImage.h"
#include "vtkSurfacePixels.h"
#include "vtkSurfaceTarget.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyData.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkTimerLog.h"

#include <algorithm>

class vtkDirectPointMapper::vtkInternals
{
public:
  vtkSurfaceTarget Nearest;
  vtkSurfaceTarget Farthest;
  vtkSurfaceTarget Splats;
  vtkDirectReconstructionOpenGL Reconstruction;
  vtkSurfaceImage NearestCPU;
  vtkSurfaceImage FarthestCPU;
  vtkDirectReconstructionCPU ReconstructionCPU;
  // of what the image buffer was made for
  vtkPointSurfaceView ImageView;
  double Gamma = 0.0;
  int Size[2] = { 0, 0 };
};

vtkStandardNewMacro(vtkDirectPointMapper);

vtkDirectPointMapper::vtkDirectPointMapper()
  : Internals(new vtkInternals)
{
}

vtkDirectPointMapper::~vtkDirectPointMapper()
{
  this->vtkDirectPointMapper::ReleaseGraphicsResources(nullptr); // see ~vtkPointSurfaceMapper
}

void vtkDirectPointMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Internals->Nearest.ReleaseGraphicsResources(window);
  this->Internals->Farthest.ReleaseGraphicsResources(window);
  this->Internals->Splats.ReleaseGraphicsResources(window);
  this->Internals->Reconstruction.ReleaseGraphicsResources(window);
}

void vtkDirectPointMapper::SetToPublished()
{
  this->SetSamplingQuantile(0.0);
  this->PublishedResolutionOn();
  this->FarthestPointsOn();
  this->WeightedNormalsOff();
  this->PlaneSplatsOff();
  this->DepthTestInSplatsOff();
  this->AdaptiveResolutionOff();
  this->ShadeBeforeSplattingOn();
}

vtkDirectOptions vtkDirectPointMapper::GetOptions() const
{
  vtkDirectOptions options;
  options.PublishedResolution = this->PublishedResolution;
  options.DepthTolerance = this->DepthTolerance;
  options.FarthestPoints = this->FarthestPoints;
  options.WeightedNormals = this->WeightedNormals;
  options.PlaneSplats = this->PlaneSplats;
  options.DepthTestInSplats = this->DepthTestInSplats;
  options.AdaptiveResolution = this->AdaptiveResolution;
  return options;
}

void vtkDirectPointMapper::RememberParameters(const vtkDirectParameters& parameters)
{
  vtkInternals& internals = *this->Internals;
  internals.ImageView = parameters.ImageView;
  internals.Gamma = parameters.Gamma;
  for (int k = 0; k < 2; ++k)
  {
    internals.Size[k] = parameters.Size[k];
    this->LastFrameImageSize[k] = parameters.ImageView.Size[k];
  }
  this->LastFrameLevels = parameters.GetCoarsestLevel();
}

namespace
{
vtkPointProjectionOptions GetProjectionOptions(const vtkDirectParameters& parameters)
{
  vtkPointProjectionOptions options;
  options.SubpixelCenters = true;
  options.CenterDepths = true;
  options.DepthTolerance = parameters.Gamma;
  return options;
}
}

bool vtkDirectPointMapper::IsAlone() const
{
  return this->GetMembers().size() == 1;
}

void vtkDirectPointMapper::MakeSurfaceBuffer(
  vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view, vtkSurfaceTarget& surface)
{
  vtkInternals& internals = *this->Internals;
  const vtkDirectParameters parameters(view, this->GetOptions());
  this->RememberParameters(parameters);
  this->ProjectPoints(window, parameters.ImageView, GetProjectionOptions(parameters), surface,
    internals.Nearest, this->FarthestPoints ? &internals.Farthest : nullptr);
  vtkDuplicatePoints* copies = this->IsAlone() ? this->ActivateDuplicates() : nullptr;
  internals.Reconstruction.Run(window, parameters, internals.Nearest,
    this->FarthestPoints ? internals.Farthest : internals.Nearest, copies,
    this->ShadeBeforeSplatting ? this->GetSplats() : internals.Splats, surface);
  if (copies)
  {
    copies->Deactivate();
  }
  this->LastFramePasses = internals.Reconstruction.GetPasses();
  this->LastFrameNormalsMilliseconds = 0.0;
}

void vtkDirectPointMapper::MakeSurfacePixels(
  const vtkPointSurfaceView& view, bool ids, bool colors, vtkSurfacePixels& surface)
{
  vtkInternals& internals = *this->Internals;
  const vtkDirectParameters parameters(view, this->GetOptions());
  this->RememberParameters(parameters);
  this->ProjectPoints(parameters.ImageView, GetProjectionOptions(parameters), ids, colors,
    internals.NearestCPU, this->FarthestPoints ? &internals.FarthestCPU : nullptr);
  const double start = vtkTimerLog::GetUniversalTime();
  const std::vector<unsigned char> none;
  const auto& copies = this->IsAlone() ? this->GetDrawablePoints().GetDuplicates() : none;
  internals.ReconstructionCPU.FitNormals(parameters, internals.NearestCPU,
    this->FarthestPoints ? internals.FarthestCPU : internals.NearestCPU, copies);
  this->LastFrameNormalsMilliseconds = 1e3 * (vtkTimerLog::GetUniversalTime() - start);
  internals.ReconstructionCPU.DrawSplats(parameters, ids, colors, surface);
  if (this->ShadeBeforeSplatting)
  {
    this->LastFrameSurfaceBytesUploaded += internals.ReconstructionCPU.UploadSplats(
      this->GetLastWindow(), parameters, colors, this->GetSplats());
  }
  this->LastFramePasses = 2 * parameters.GetCoarsestLevel() + 2;
}

//------------------------------------------------------------------------------
void vtkDirectPointMapper::ReplaceShaderValues(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::ReplaceShaderValues(shaders, renderer, actor);
  if (!this->ShadeBeforeSplatting)
  {
    return;
  }
  // VTK's shading becomes a function of a splat, which a new main() calls for all of a pixel; what
  // follows the light, of passes and selection, is done once
  vtkShader* fragment = shaders[vtkShader::Fragment];
  std::string text = fragment->GetSource();
  vtkShaderProgram::Substitute(text, "//PointSurface::Lit::Dec",
    vtkSurfaceTarget::GetInputDeclarations(this->GetSplats().GetLayers(), "in") +
      vtkDirectReconstructionOpenGL::GetSplatDeclarations() + vtkLitSplatsDec);
  vtkShaderProgram::Substitute(text, "//PointSurface::Lit::Impl", vtkLitSplatsFetch);
  vtkShaderProgram::Substitute(text, "gl_FragData[0].a = psCover(",
    "if (psLightsSplat) { return; }\n"
    "  gl_FragData[0] = psWeight > 0.0 ? psLit / psWeight : gl_FragData[0];\n"
    "  gl_FragData[0].a = psCover(");
  vtkSurfaceBufferShading::CallFromMain(text, vtkLitSplatsImpl);
  fragment->SetSource(text);
}

void vtkDirectPointMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(helper, renderer, actor);
  if (this->ShadeBeforeSplatting)
  {
    const vtkPointSurfaceView& view = this->GetShadedView();
    this->GetSplats().SetSamplers(helper.Program, "in");
    vtkDirectReconstructionOpenGL::SetSplatUniforms(
      helper.Program, vtkDirectParameters(view, this->GetOptions()), view.Supersampling);
  }
}

//------------------------------------------------------------------------------
bool vtkDirectPointMapper::ReadImageBuffer(vtkImageData* nearest, vtkImageData* farthest)
{
  vtkOpenGLRenderWindow* window = this->GetLastWindow();
  vtkInternals& internals = *this->Internals;
  const vtkPointSurfaceView& view = internals.ImageView;
  if (!window || view.Size[0] == 0)
  {
    vtkErrorMacro("There is no image buffer to read: render a frame with this mapper first.");
    return false;
  }
  window->MakeCurrent();
  const bool byCPU = this->LastFrameBackend == CPU;
  const bool second = this->FarthestPoints;
  for (vtkImageData* buffer : { nearest, farthest })
  {
    const bool isSecond = buffer == farthest && second;
    vtkSurfaceImage& image = isSecond ? internals.FarthestCPU : internals.NearestCPU;
    vtkSurfaceTarget& target = isSecond ? internals.Farthest : internals.Nearest;
    const std::vector<std::array<int, 4>> drawn = { view.Rectangle };
    auto readFloats = [&](vtkSurfaceTarget::Layer layer)
    { return byCPU ? image.ReadFloats(layer) : target.ReadFloats(window, layer, drawn); };
    buffer->Initialize();
    buffer->SetDimensions(view.Size[0], view.Size[1], 1);
    AddLayer(buffer, readFloats(vtkSurfaceTarget::Shape), "Valid", 3, 1);
    const std::vector<float> interval = readFloats(vtkSurfaceTarget::Interval);
    AddLayer(buffer, interval, "Depth", 0, 1);
    AddLayer(buffer, interval, "Displacement", 2, 2);
    if (byCPU ? image.HasColors() : target.Has(vtkSurfaceTarget::Color))
    {
      AddLayer(buffer, readFloats(vtkSurfaceTarget::Color), "Colors", 0, 4);
    }
    if (byCPU ? image.HasIds() : target.Has(vtkSurfaceTarget::Id))
    {
      AddIds(buffer, byCPU ? image.ReadIds() : target.ReadIds(window, drawn));
    }
  }
  vtkNew<vtkDoubleArray> projection;
  projection->SetName("Projection");
  for (int i = 0; i < 16; ++i)
  {
    projection->InsertNextValue(view.VCDC[4 * (i % 4) + i / 4]);
  }
  nearest->GetFieldData()->AddArray(projection);
  vtkNew<vtkDoubleArray> gamma;
  gamma->SetName("Gamma");
  gamma->InsertNextValue(internals.Gamma);
  nearest->GetFieldData()->AddArray(gamma);
  vtkNew<vtkIntArray> size;
  size->SetName("Size");
  size->InsertNextValue(internals.Size[0]);
  size->InsertNextValue(internals.Size[1]);
  nearest->GetFieldData()->AddArray(size);
  return true;
}

void vtkDirectPointMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SamplingQuantile: " << this->SamplingQuantile << "\n";
  os << indent << "PublishedResolution: " << this->PublishedResolution << "\n";
  os << indent << "DepthTolerance: " << this->DepthTolerance << "\n";
  os << indent << "FarthestPoints: " << this->FarthestPoints << "\n";
  os << indent << "WeightedNormals: " << this->WeightedNormals << "\n";
  os << indent << "PlaneSplats: " << this->PlaneSplats << "\n";
  os << indent << "DepthTestInSplats: " << this->DepthTestInSplats << "\n";
  os << indent << "AdaptiveResolution: " << this->AdaptiveResolution << "\n";
  os << indent << "ShadeBeforeSplatting: " << this->ShadeBeforeSplatting << "\n";
  os << indent << "LastFrameImageSize: " << this->LastFrameImageSize[0] << " "
     << this->LastFrameImageSize[1] << "\n";
  os << indent << "LastFrameNormalsMilliseconds: " << this->LastFrameNormalsMilliseconds << "\n";
}
