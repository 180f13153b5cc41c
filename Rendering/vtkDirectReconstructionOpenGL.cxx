// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDirectReconstructionOpenGL.h"

#include "vtkDirectCommon.h"
#include "vtkDirectLoadFS.h"
#include "vtkDirectMergeFS.h"
#include "vtkDirectNormalsFS.h"
#include "vtkDirectParameters.h"
#include "vtkDirectSplats.h"
#include "vtkDirectSplatsFS.h"
#include "vtkDuplicatePoints.h"
#include "vtkScreenPass.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <algorithm>

namespace
{
void SetCommonUniforms(vtkShaderProgram* program, const vtkDirectParameters& parameters)
{
  program->SetUniform4f("eyeRay", parameters.EyeRay.data());
  program->SetUniform4f("eyeRayStep", parameters.EyeRayStep.data());
  program->SetUniform4f("cellToEye", parameters.CellToEye.data());
  program->SetUniformf("shear", parameters.Shear);
  program->SetUniformf("gamma", parameters.Gamma);
}

void DrawRectangle(vtkOpenGLRenderWindow* window, vtkScreenPass& pass,
  const std::array<int, 4>& rectangle, const std::array<int, 2>& offset)
{
  pass.Draw(window, rectangle[0] + offset[0], rectangle[1] + offset[1], rectangle[2] - rectangle[0],
    rectangle[3] - rectangle[1]);
}
}

vtkDirectReconstructionOpenGL::vtkDirectReconstructionOpenGL() = default;
vtkDirectReconstructionOpenGL::~vtkDirectReconstructionOpenGL() = default;

//------------------------------------------------------------------------------
void vtkDirectReconstructionOpenGL::Run(vtkOpenGLRenderWindow* window,
  const vtkDirectParameters& parameters, vtkSurfaceTarget& nearest, vtkSurfaceTarget& farthest,
  vtkDuplicatePoints* copies, vtkSurfaceTarget& splats, vtkSurfaceTarget& surface)
{
  this->Passes = 0;
  this->Allocate(window, parameters, nearest.GetLayers());
  const auto& size = parameters.SplatsSize;
  splats.Allocate(window, size[0], size[1], nearest.GetLayers());
  this->Load(window, parameters, nearest, farthest);
  this->FitNormals(window, parameters, 0, copies, splats);
  for (int level = 1; level <= parameters.GetCoarsestLevel(); ++level)
  {
    this->Merge(window, parameters, level, splats);
    this->FitNormals(window, parameters, level, copies, splats);
  }
  this->DrawSplats(window, parameters, splats, surface);
}

void vtkDirectReconstructionOpenGL::Allocate(
  vtkOpenGLRenderWindow* window, const vtkDirectParameters& parameters, const Layers& layers)
{
  for (int level = 0; level <= parameters.GetCoarsestLevel(); ++level)
  {
    const auto& size = parameters.Levels[level];
    if (static_cast<int>(this->Cells.size()) <= level)
    {
      this->Cells.emplace_back(new vtkSurfaceTarget);
    }
    this->Cells[level]->Allocate(window, size.Width, size.Height, layers);
  }
}

//------------------------------------------------------------------------------
void vtkDirectReconstructionOpenGL::Load(vtkOpenGLRenderWindow* window,
  const vtkDirectParameters& parameters, vtkSurfaceTarget& nearest, vtkSurfaceTarget& farthest)
{
  vtkScreenPass& pass = this->GetPass(LoadPass, nearest.GetLayers(), nearest.GetLayers());
  vtkShaderProgram* program = pass.Ready(window);
  if (!program)
  {
    return;
  }
  nearest.Activate();
  nearest.SetSamplers(program, "nearest");
  farthest.Activate();
  farthest.SetSamplers(program, "farthest");
  SetCommonUniforms(program, parameters);
  this->Cells[0]->BindForWriting(window);
  DrawRectangle(window, pass, parameters.Levels[0].Rectangle, { 0, 0 });
  ++this->Passes;
  farthest.Deactivate();
  nearest.Deactivate();
}

void vtkDirectReconstructionOpenGL::Merge(vtkOpenGLRenderWindow* window,
  const vtkDirectParameters& parameters, int level, vtkSurfaceTarget& splats)
{
  vtkSurfaceTarget& fine = *this->Cells[level - 1];
  vtkScreenPass& pass = this->GetPass(MergePass, fine.GetLayers(), fine.GetLayers());
  vtkShaderProgram* program = pass.Ready(window);
  if (!program)
  {
    return;
  }
  fine.Activate();
  fine.SetSamplers(program, "fine");
  splats.Activate();
  splats.SetSamplers(program, "splat");
  SetCommonUniforms(program, parameters);
  const auto& r = parameters.Levels[level - 1].Rectangle;
  program->SetUniform2i("fineBegin", r.data());
  program->SetUniform2i("fineEnd", r.data() + 2);
  program->SetUniform2i("splatOffset", parameters.Levels[level - 1].Offset.data());
  program->SetUniformf("size", static_cast<float>(1 << level));
  this->Cells[level]->BindForWriting(window);
  DrawRectangle(window, pass, parameters.Levels[level].Rectangle, { 0, 0 });
  ++this->Passes;
  splats.Deactivate();
  fine.Deactivate();
}

void vtkDirectReconstructionOpenGL::FitNormals(vtkOpenGLRenderWindow* window,
  const vtkDirectParameters& parameters, int level, vtkDuplicatePoints* copies,
  vtkSurfaceTarget& splats)
{
  vtkSurfaceTarget& cells = *this->Cells[level];
  vtkScreenPass& pass =
    this->GetPass(copies ? PartNormalsPass : NormalsPass, cells.GetLayers(), splats.GetLayers());
  vtkShaderProgram* program = pass.Ready(window);
  if (!program)
  {
    return;
  }
  cells.Activate();
  cells.SetSamplers(program, "in");
  SetCommonUniforms(program, parameters);
  const auto& r = parameters.Levels[level].Rectangle;
  program->SetUniform2i("begin", r.data());
  program->SetUniform2i("end", r.data() + 2);
  program->SetUniform2i("splatOffset", parameters.Levels[level].Offset.data());
  program->SetUniformf("size", static_cast<float>(1 << level));
  program->SetUniformf("splatRadius", vtkDirectParameters::SplatRadius);
  program->SetUniformi("enoughNeighbors", vtkDirectParameters::EnoughNeighbors);
  program->SetUniformf("neighborDepth", vtkDirectParameters::NeighborDepth);
  program->SetUniformi("adaptive", parameters.Options.AdaptiveResolution);
  program->SetUniformi("coarsest", level == parameters.GetCoarsestLevel());
  program->SetUniformi("parallel", parameters.ImageView.IsParallel());
  program->SetUniformi("weighted", parameters.Options.WeightedNormals);
  program->SetUniformi("reach", parameters.GetFitReach());
  program->SetUniformf("fitRadius", vtkDirectParameters::FitRadius);
  const float fitDepths[2] = { vtkDirectParameters::FitDepth, vtkDirectParameters::RefitDepth };
  program->SetUniform2f("fitDepths", fitDepths);
  program->SetUniformf("steepStep", vtkDirectParameters::SteepStep);
  program->SetUniformf("evenSteps", vtkDirectParameters::EvenSteps);
  if (copies)
  {
    copies->SetSampler(program, "copies");
  }
  splats.BindForWriting(window);
  DrawRectangle(window, pass, r, parameters.Levels[level].Offset);
  ++this->Passes;
  cells.Deactivate();
}

void vtkDirectReconstructionOpenGL::SetSplatUniforms(
  vtkShaderProgram* program, const vtkDirectParameters& parameters, int samples)
{
  SetCommonUniforms(program, parameters);
  const int count = parameters.GetCoarsestLevel() + 1;
  program->SetUniformi("levels", count);
  for (int level = 0; level < count; ++level)
  {
    const std::string index = "[" + std::to_string(level) + "]";
    const auto& r = parameters.Levels[level].Rectangle;
    program->SetUniform2i(("levelOffset" + index).c_str(), parameters.Levels[level].Offset.data());
    program->SetUniform2i(("levelBegin" + index).c_str(), r.data());
    program->SetUniform2i(("levelEnd" + index).c_str(), r.data() + 2);
  }
  const float pixelToCell[2] = { samples * parameters.PixelToCell[0],
    samples * parameters.PixelToCell[1] };
  program->SetUniform2f("pixelToCell", pixelToCell);
  program->SetUniformi("planes", parameters.Options.PlaneSplats);
  program->SetUniformf("leastWidth", vtkDirectParameters::LeastWidth);
  program->SetUniformi("depthTest", parameters.Options.DepthTestInSplats);
  const vtkPointSurfaceView& view = parameters.ImageView;
  float clippingPlanes[6][4];
  for (int i = 0; i < 24; ++i)
  {
    clippingPlanes[i / 4][i % 4] = static_cast<float>(view.ClippingPlanes[i / 4][i % 4]);
  }
  program->SetUniformi("numberOfClippingPlanes", view.NumberOfClippingPlanes);
  program->SetUniform4fv("clippingPlanes", 6, clippingPlanes);
}

void vtkDirectReconstructionOpenGL::DrawSplats(vtkOpenGLRenderWindow* window,
  const vtkDirectParameters& parameters, vtkSurfaceTarget& splats, vtkSurfaceTarget& surface)
{
  vtkScreenPass& pass = this->GetPass(SplatsPass, splats.GetLayers(), surface.GetLayers());
  vtkShaderProgram* program = pass.Ready(window);
  if (!program)
  {
    return;
  }
  splats.Activate();
  splats.SetSamplers(program, "in");
  SetSplatUniforms(program, parameters, 1);
  surface.BindForWriting(window);
  DrawRectangle(window, pass, parameters.Rectangle, { 0, 0 });
  ++this->Passes;
  splats.Deactivate();
}

//------------------------------------------------------------------------------
std::string vtkDirectReconstructionOpenGL::GetSplatDeclarations()
{
  return std::string(vtkDirectCommon) + vtkDirectSplats;
}

vtkScreenPass& vtkDirectReconstructionOpenGL::GetPass(
  Kind kind, const Layers& input, const Layers& output)
{
  // the input's layers follow from the output's
  std::unique_ptr<vtkScreenPass>& pass = this->Programs[kind][output];
  if (!pass)
  {
    std::string text = "//VTK::System::Dec\n" + vtkSurfaceTarget::GetOutputDeclarations(output);
    switch (kind)
    {
      case LoadPass:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "nearest");
        text += vtkSurfaceTarget::GetInputDeclarations(input, "farthest");
        text += std::string(vtkDirectCommon) + vtkDirectLoadFS;
        break;
      case MergePass:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "fine");
        text += vtkSurfaceTarget::GetInputDeclarations(input, "splat");
        text += std::string(vtkDirectCommon) + vtkDirectMergeFS;
        break;
      case PartNormalsPass:
        text += "#define HAS_COPIES\n";
        [[fallthrough]];
      case NormalsPass:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "in");
        text += std::string(vtkDirectCommon) + vtkDirectNormalsFS;
        break;
      default:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "in");
        text += GetSplatDeclarations() + vtkDirectSplatsFS;
    }
    pass.reset(new vtkScreenPass(text));
  }
  return *pass;
}

void vtkDirectReconstructionOpenGL::ReleaseGraphicsResources(vtkWindow* window)
{
  for (auto& cells : this->Cells)
  {
    cells->ReleaseGraphicsResources(window);
  }
  for (auto& programs : this->Programs)
  {
    for (auto& entry : programs)
    {
      entry.second->ReleaseGraphicsResources();
    }
  }
}
