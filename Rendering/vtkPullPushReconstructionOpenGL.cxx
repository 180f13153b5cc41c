// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPullPushReconstructionOpenGL.h"

#include "vtkFillFS.h"
#include "vtkOutlineTrimFS.h"
#include "vtkPointSurfaceCompat.h"
#include "vtkPullFS.h"
#include "vtkPullPushCommon.h"
#include "vtkPullPushParameters.h"
#include "vtkPushFS.h"
#include "vtkScreenPass.h"
#include "vtkSurfaceCopyFS.h"
#include "vtkTileVS.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"

#include <algorithm>

namespace
{
void SetBounds(
  vtkShaderProgram* program, const std::string& prefix, const std::array<int, 4>& rectangle)
{
  program->SetUniform2i((prefix + "Begin").c_str(), rectangle.data());
  program->SetUniform2i((prefix + "End").c_str(), rectangle.data() + 2);
}

void SetCommonUniforms(vtkShaderProgram* program, const vtkPullPushParameters& parameters)
{
  program->SetUniform4f("pixelToEye", parameters.PixelToEye.data());
  program->SetUniform4f("eyeRay", parameters.EyeRay.data());
  program->SetUniform4f("eyeRayStep", parameters.EyeRayStep.data());
  program->SetUniformf("shear", parameters.Shear);
}

/// What is the same for all pixels, as GLSL: a rasteriser in software runs both sides of a choice
/// between uniforms.
std::string GetConstants(const vtkPullPushParameters& parameters)
{
  std::string text;
  auto add = [&text](const char* name, bool value)
  { text += std::string("const bool ") + name + (value ? " = true;\n" : " = false;\n"); };
  add("centerDepths", parameters.Options.PerspectiveDiscs);
  add("twoSided", parameters.TwoSided);
  add("distanceWeights", parameters.Options.DistanceWeights);
  add("depthTest", parameters.Options.DepthTestInPush);
  add("hidesBacks", parameters.HidesBacks());
  add("blendsPixels", parameters.BlendsPixels);
  add("trimsOutlines", parameters.Options.TrimOutlines);
  add("clips", parameters.NumberOfClippingPlanes > 0);
  text += parameters.Options.FillPixels ? "#define MARKS_UNFILLED\n" : "";
  return text;
}
}

vtkPullPushReconstructionOpenGL::vtkPullPushReconstructionOpenGL() = default;
vtkPullPushReconstructionOpenGL::~vtkPullPushReconstructionOpenGL() = default;

//------------------------------------------------------------------------------
void vtkPullPushReconstructionOpenGL::Run(vtkOpenGLRenderWindow* window,
  const vtkPullPushParameters& parameters, vtkSurfaceTarget& projected, vtkSurfaceTarget& surface)
{
  this->Passes = 0;
  Layers layers = { vtkSurfaceTarget::Shape, vtkSurfaceTarget::Interval };
  for (vtkSurfaceTarget::Layer layer : { vtkSurfaceTarget::Id, vtkSurfaceTarget::Color })
  {
    if (surface.Has(layer))
    {
      layers.push_back(layer);
    }
  }
  this->AllocatePyramid(window, parameters, layers);

  auto pulled = [&](int level) -> vtkSurfaceTarget&
  { return level == 0 ? projected : *this->Pulled[level - 1]; };
  const int coarsest = parameters.GetCoarsestLevel();
  for (int level = 1; level <= coarsest; ++level)
  {
    this->Pull(window, parameters, pulled(level - 1), level);
  }
  const bool fill = parameters.Options.FillPixels;
  if (fill)
  {
    this->Filled.Allocate(
      window, parameters.Levels[0].Width, parameters.Levels[0].Height, surface.GetLayers(), true);
    surface.ShareDepthBuffer(window, this->Filled);
  }
  for (int level = coarsest - 1; level >= 0; --level)
  {
    this->Push(window, parameters, pulled(level),
      level + 1 == coarsest ? pulled(level + 1) : *this->Pushed[level],
      level == 0 ? surface : *this->Pushed[level - 1], level);
  }
  if (fill)
  {
    this->Fill(window, parameters, surface);
  }
}

void vtkPullPushReconstructionOpenGL::AllocatePyramid(
  vtkOpenGLRenderWindow* window, const vtkPullPushParameters& parameters, const Layers& layers)
{
  const int coarsest = parameters.GetCoarsestLevel();
  while (static_cast<int>(this->Pulled.size()) < coarsest)
  {
    this->Pulled.emplace_back(new vtkSurfaceTarget);
    this->Pushed.emplace_back(new vtkSurfaceTarget);
  }
  for (int level = 1; level <= coarsest; ++level)
  {
    const auto& size = parameters.Levels[level];
    this->Pulled[level - 1]->Allocate(window, size.Width, size.Height, layers);
    if (level < coarsest)
    {
      this->Pushed[level - 1]->Allocate(window, size.Width, size.Height, layers);
    }
  }
}

//------------------------------------------------------------------------------
void vtkPullPushReconstructionOpenGL::Trim(vtkOpenGLRenderWindow* window,
  const vtkPullPushParameters& parameters, vtkSurfaceTarget& untrimmed, vtkSurfaceTarget& projected)
{
  projected.Allocate(window, untrimmed.GetWidth(), untrimmed.GetHeight(), untrimmed.GetLayers());
  vtkScreenPass& pass =
    this->GetPass(parameters, TrimPass, untrimmed.GetLayers(), projected.GetLayers());
  vtkShaderProgram* program = pass.Ready(window);
  if (!program)
  {
    return;
  }
  untrimmed.Activate();
  untrimmed.SetSamplers(program, "in");
  const int size[2] = { untrimmed.GetWidth(), untrimmed.GetHeight() };
  program->SetUniform2i("size", size);
  program->SetUniform2i("begin", parameters.Levels[0].Rectangle.data());
  program->SetUniform2i("end", parameters.Levels[0].Rectangle.data() + 2);
  program->SetUniformf("largestOffset", parameters.LargestOffset);
  SetCommonUniforms(program, parameters);
  projected.BindForWriting(window);
  this->DrawLevel(window, parameters, pass, 0);
  untrimmed.Deactivate();
}

void vtkPullPushReconstructionOpenGL::Pull(vtkOpenGLRenderWindow* window,
  const vtkPullPushParameters& parameters, vtkSurfaceTarget& fine, int level)
{
  vtkSurfaceTarget& coarse = *this->Pulled[level - 1];
  vtkScreenPass& pass = this->GetPass(parameters, PullPass, coarse.GetLayers(), coarse.GetLayers());
  vtkShaderProgram* program = pass.Ready(window);
  if (!program)
  {
    return;
  }
  fine.Activate();
  fine.SetSamplers(program, "fine");
  SetBounds(program, "fine", parameters.Levels[level - 1].Rectangle);
  program->SetUniformf("fineSize", static_cast<float>(1 << (level - 1)));
  program->SetUniformf("unionShare", parameters.UnionShare);
  SetCommonUniforms(program, parameters);
  coarse.BindForWriting(window);
  this->DrawLevel(window, parameters, pass, level);
  fine.Deactivate();
}

void vtkPullPushReconstructionOpenGL::Push(vtkOpenGLRenderWindow* window,
  const vtkPullPushParameters& parameters, vtkSurfaceTarget& fine, vtkSurfaceTarget& coarse,
  vtkSurfaceTarget& result, int level)
{
  vtkScreenPass& pass = this->GetPass(parameters, PushPass, coarse.GetLayers(), result.GetLayers());
  vtkShaderProgram* program = pass.Ready(window);
  if (!program)
  {
    return;
  }
  fine.Activate();
  fine.SetSamplers(program, "fine");
  coarse.Activate();
  coarse.SetSamplers(program, "coarse");
  SetBounds(program, "coarse", parameters.Levels[level + 1].Rectangle);
  program->SetUniformf("fineSize", static_cast<float>(1 << level));
  SetCommonUniforms(program, parameters);
  program->SetUniformf("outlineSlack", parameters.OutlineSlack);
  program->SetUniformi("numberOfClippingPlanes", parameters.NumberOfClippingPlanes);
  float planes[6][4];
  for (int i = 0; i < 6; ++i)
  {
    std::copy_n(parameters.ClippingPlanes[i].data(), 4, planes[i]);
  }
  program->SetUniform4fv("clippingPlanes", 6, planes);
  result.BindForWriting(window);
  const auto& r = parameters.Levels[level].Rectangle;
  vtkOpenGLState* state = window->GetState();
  const bool marks = level == 0 && parameters.Options.FillPixels;
  state->SetEnumState(GL_DEPTH_TEST, marks);
  state->vtkglDepthMask(marks ? GL_TRUE : GL_FALSE);
  state->vtkglDepthFunc(GL_ALWAYS);
  result.Clear(window, { r[0], r[1], r[2] - r[0], r[3] - r[1] });
  this->DrawTiles(window, parameters, pass, program, coarse, level);
  state->vtkglDisable(GL_DEPTH_TEST);
  coarse.Deactivate();
  fine.Deactivate();
}

/// Where the last push has written the depth 0, a pixel may be filled: few are, so that these alone
/// are written to a target of their own, and copied from there.
void vtkPullPushReconstructionOpenGL::Fill(
  vtkOpenGLRenderWindow* window, const vtkPullPushParameters& parameters, vtkSurfaceTarget& surface)
{
  vtkOpenGLState* state = window->GetState();
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglDepthFunc(GL_EQUAL);
  const auto& r = parameters.Levels[0].Rectangle;
  auto draw = [&](Kind kind, vtkSurfaceTarget& from, vtkSurfaceTarget& to)
  {
    vtkScreenPass& pass = this->GetPass(parameters, kind, from.GetLayers(), to.GetLayers());
    if (vtkShaderProgram* program = pass.Ready(window))
    {
      from.Activate();
      from.SetSamplers(program, "in");
      program->SetUniform2i("begin", r.data());
      program->SetUniform2i("end", r.data() + 2);
      program->SetUniformi("openRun", parameters.OpenRun);
      program->SetUniformf("depthStep", parameters.DepthStep);
      SetCommonUniforms(program, parameters);
      to.BindForWriting(window);
      pass.Draw(window, r[0], r[1], r[2] - r[0], r[3] - r[1]);
      from.Deactivate();
    }
  };
  draw(FillPass, surface, this->Filled);
  draw(CopyPass, this->Filled, surface);
  ++this->Passes;
  state->vtkglDisable(GL_DEPTH_TEST);
}

void vtkPullPushReconstructionOpenGL::DrawLevel(vtkOpenGLRenderWindow* window,
  const vtkPullPushParameters& parameters, vtkScreenPass& pass, int level)
{
  const auto& r = parameters.Levels[level].Rectangle;
  pass.Draw(window, r[0], r[1], r[2] - r[0], r[3] - r[1]);
  ++this->Passes;
}

void vtkPullPushReconstructionOpenGL::DrawTiles(vtkOpenGLRenderWindow* window,
  const vtkPullPushParameters& parameters, vtkScreenPass& pass, vtkShaderProgram* program,
  vtkSurfaceTarget& coarse, int level)
{
  const auto& size = parameters.Levels[level];
  const auto& r = size.Rectangle;
  const int first[2] = { r[0] / TileSize, r[1] / TileSize };
  const int columns = (r[2] + TileSize - 1) / TileSize - first[0];
  const int rows = (r[3] + TileSize - 1) / TileSize - first[1];
  const float targetSize[2] = { static_cast<float>(size.Width), static_cast<float>(size.Height) };
  coarse.SetSamplers(program, "cover");
  SetBounds(program, "cover", parameters.Levels[level + 1].Rectangle);
  program->SetUniformi("tileSize", TileSize);
  program->SetUniform2i("firstTile", first);
  program->SetUniformi("tileColumns", columns);
  program->SetUniform2f("targetSize", targetSize);
  pass.DrawPoints(window, r[0], r[1], r[2] - r[0], r[3] - r[1], columns * rows, TileSize);
  ++this->Passes;
}

//------------------------------------------------------------------------------
vtkScreenPass& vtkPullPushReconstructionOpenGL::GetPass(
  const vtkPullPushParameters& parameters, Kind kind, const Layers& input, const Layers& output)
{
  const std::string constants = GetConstants(parameters);
  std::unique_ptr<vtkScreenPass>& pass =
    this->Programs[kind][std::make_tuple(constants, input, output)];
  if (!pass)
  {
    std::string text = "//VTK::System::Dec\n" + vtkSurfaceTarget::GetOutputDeclarations(output) +
      constants + vtkPullPushCommon;
    switch (kind)
    {
      case TrimPass:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "in") + vtkOutlineTrimFS;
        break;
      case PullPass:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "fine") + vtkPullFS;
        break;
      case PushPass:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "fine");
        text += vtkSurfaceTarget::GetInputDeclarations(input, "coarse") + vtkPushFS;
        break;
      case FillPass:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "in") + vtkFillFS;
        break;
      default:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "in") + vtkSurfaceCopyFS;
    }
    pass.reset(new vtkScreenPass(text, kind == PushPass ? vtkTileVS : ""));
  }
  return *pass;
}

void vtkPullPushReconstructionOpenGL::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Filled.ReleaseGraphicsResources(window);
  for (auto* pyramid : { &this->Pulled, &this->Pushed })
  {
    for (auto& level : *pyramid)
    {
      level->ReleaseGraphicsResources(window);
    }
  }
  for (auto& programs : this->Programs)
  {
    for (auto& entry : programs)
    {
      entry.second->ReleaseGraphicsResources();
    }
  }
}
