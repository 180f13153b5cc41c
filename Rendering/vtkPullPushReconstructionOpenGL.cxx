// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPullPushReconstructionOpenGL.h"

#include "vtkFillFS.h"
#include "vtkPointSurfaceView.h"
#include "vtkPullFS.h"
#include "vtkPullPushCommon.h"
#include "vtkPullPushOptions.h"
#include "vtkPushFS.h"
#include "vtkScreenPass.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <algorithm>

namespace
{
/// Levels above the finest one until the image is one pixel.
int CountLevels(int width, int height)
{
  int levels = 1; // one more than a single pixel needs, so that there is always a push
  for (int size = std::max(width, height); size > 2; size = (size + 1) / 2)
  {
    ++levels;
  }
  return levels;
}

void SetBounds(
  vtkShaderProgram* program, const std::string& prefix, const std::array<int, 4>& rectangle)
{
  program->SetUniform2i((prefix + "Begin").c_str(), rectangle.data());
  program->SetUniform2i((prefix + "End").c_str(), rectangle.data() + 2);
}

void SetCommonUniforms(
  vtkShaderProgram* program, const vtkPointSurfaceView& view, const vtkPullPushOptions& options)
{
  const float pixelToEye[4] = { static_cast<float>(2.0 / (view.Size[0] * view.VCDC[0])),
    static_cast<float>(2.0 / (view.Size[1] * view.VCDC[5])), static_cast<float>(-view.VCDC[11]),
    static_cast<float>(view.VCDC[15]) };
  program->SetUniform4f("pixelToEye", pixelToEye);
  program->SetUniformi("twoSided", view.Cull == vtkPointSurfaceView::NoCulling);
  program->SetUniformi("centerDepths", options.PerspectiveDiscs);
}

/// Rays as linear functions of the pixel: eye xy = origin + depth * direction.
void SetRays(vtkShaderProgram* program, const vtkPointSurfaceView& view)
{
  const auto& m = view.VCDC;
  float ray[4];
  float step[4];
  for (int k = 0; k < 2; ++k)
  {
    const double scale = m[5 * k];
    ray[k] = static_cast<float>((m[11] + m[8 + k]) / scale);
    ray[2 + k] = static_cast<float>((-m[15] - m[12 + k]) / scale);
    step[k] = static_cast<float>(-2.0 * m[11] / (view.Size[k] * scale));
    step[2 + k] = static_cast<float>(2.0 * m[15] / (view.Size[k] * scale));
  }
  program->SetUniform4f("eyeRay", ray);
  program->SetUniform4f("eyeRayStep", step);
}

/// How far radii are those of the union of discs: all the way where they are below 1.5 pixels.
double GetUnionShare(const vtkPointSurfaceView& view)
{
  return std::min(std::max(2.5 - view.TypicalRadius, 0.0), 1.0);
}
}

vtkPullPushReconstructionOpenGL::vtkPullPushReconstructionOpenGL() = default;
vtkPullPushReconstructionOpenGL::~vtkPullPushReconstructionOpenGL() = default;

//------------------------------------------------------------------------------
void vtkPullPushReconstructionOpenGL::Run(vtkOpenGLRenderWindow* window,
  const vtkPointSurfaceView& view, const vtkPullPushOptions& options, vtkSurfaceTarget& projected,
  vtkSurfaceTarget& surface)
{
  this->Levels = CountLevels(view.Size[0], view.Size[1]);
  this->Passes = 0;
  this->AllocatePyramid(window, view, projected.GetLayers());

  auto pulled = [&](int level) -> vtkSurfaceTarget&
  { return level == 0 ? projected : *this->Pulled[level - 1]; };
  for (int level = 1; level <= this->Levels; ++level)
  {
    this->Pull(window, view, options, pulled(level - 1), level);
  }
  const bool fill = options.FillPixels;
  if (fill)
  {
    this->Unfilled.Allocate(window, view.Size[0], view.Size[1], surface.GetLayers());
  }
  vtkSurfaceTarget& pushed = fill ? this->Unfilled : surface;
  for (int level = this->Levels - 1; level >= 0; --level)
  {
    const bool coarsest = level + 1 == this->Levels;
    this->Push(window, view, options, pulled(level),
      coarsest ? pulled(level + 1) : *this->Pushed[level],
      level == 0 ? pushed : *this->Pushed[level - 1], level);
  }
  if (fill)
  {
    this->Fill(window, view, this->Unfilled, surface);
  }
}

void vtkPullPushReconstructionOpenGL::AllocatePyramid(
  vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view, const Layers& layers)
{
  while (static_cast<int>(this->Pulled.size()) < this->Levels)
  {
    this->Pulled.emplace_back(new vtkSurfaceTarget);
    this->Pushed.emplace_back(new vtkSurfaceTarget);
  }
  const auto& r = view.Rectangle;
  this->Rectangles.assign(1, { r[0], r[1], r[0] + r[2], r[1] + r[3] });
  int width = view.Size[0];
  int height = view.Size[1];
  for (int level = 1; level <= this->Levels; ++level)
  {
    width = (width + 1) / 2;
    height = (height + 1) / 2;
    const Rectangle fine = this->Rectangles.back();
    this->Rectangles.push_back({ fine[0] / 2, fine[1] / 2, (fine[2] + 1) / 2, (fine[3] + 1) / 2 });
    this->Pulled[level - 1]->Allocate(window, width, height, layers);
    if (level < this->Levels)
    {
      this->Pushed[level - 1]->Allocate(window, width, height, layers);
    }
  }
}

//------------------------------------------------------------------------------
void vtkPullPushReconstructionOpenGL::Pull(vtkOpenGLRenderWindow* window,
  const vtkPointSurfaceView& view, const vtkPullPushOptions& options, vtkSurfaceTarget& fine,
  int level)
{
  vtkSurfaceTarget& coarse = *this->Pulled[level - 1];
  vtkScreenPass& pass = this->GetPass(PullPass, fine.GetLayers(), coarse.GetLayers());
  vtkShaderProgram* program = pass.Ready(window);
  if (!program)
  {
    return;
  }
  fine.Activate();
  fine.SetSamplers(program, "fine");
  SetBounds(program, "fine", this->Rectangles[level - 1]);
  program->SetUniformf("fineSize", static_cast<float>(1 << (level - 1)));
  program->SetUniformf(
    "unionShare", options.UnionRadii ? static_cast<float>(GetUnionShare(view)) : 0.0f);
  SetCommonUniforms(program, view, options);
  coarse.BindForWriting(window);
  this->DrawLevel(window, pass, level);
  fine.Deactivate();
}

void vtkPullPushReconstructionOpenGL::Push(vtkOpenGLRenderWindow* window,
  const vtkPointSurfaceView& view, const vtkPullPushOptions& options, vtkSurfaceTarget& fine,
  vtkSurfaceTarget& coarse, vtkSurfaceTarget& result, int level)
{
  vtkScreenPass& pass = this->GetPass(PushPass, fine.GetLayers(), result.GetLayers());
  vtkShaderProgram* program = pass.Ready(window);
  if (!program)
  {
    return;
  }
  fine.Activate();
  fine.SetSamplers(program, "fine");
  coarse.Activate();
  coarse.SetSamplers(program, "coarse");
  SetBounds(program, "coarse", this->Rectangles[level + 1]);
  program->SetUniformf("fineSize", static_cast<float>(1 << level));
  SetCommonUniforms(program, view, options);
  SetRays(program, view);
  program->SetUniformi("distanceWeights", options.DistanceWeights);
  program->SetUniformi("depthTest", options.DepthTestInPush);
  result.BindForWriting(window);
  this->DrawLevel(window, pass, level);
  coarse.Deactivate();
  fine.Deactivate();
}

void vtkPullPushReconstructionOpenGL::Fill(vtkOpenGLRenderWindow* window,
  const vtkPointSurfaceView& view, vtkSurfaceTarget& unfilled, vtkSurfaceTarget& result)
{
  vtkScreenPass& pass = this->GetPass(FillPass, unfilled.GetLayers(), result.GetLayers());
  vtkShaderProgram* program = pass.Ready(window);
  if (!program)
  {
    return;
  }
  unfilled.Activate();
  unfilled.SetSamplers(program, "in");
  program->SetUniform2i("begin", this->Rectangles[0].data());
  program->SetUniform2i("end", this->Rectangles[0].data() + 2);
  program->SetUniformf("depthStep", static_cast<float>(view.MeanRadius));
  program->SetUniformi("twoSided", view.Cull == vtkPointSurfaceView::NoCulling);
  SetRays(program, view);
  result.BindForWriting(window);
  this->DrawLevel(window, pass, 0);
  unfilled.Deactivate();
}

void vtkPullPushReconstructionOpenGL::DrawLevel(
  vtkOpenGLRenderWindow* window, vtkScreenPass& pass, int level)
{
  const Rectangle& r = this->Rectangles[level];
  pass.Draw(window, r[0], r[1], r[2] - r[0], r[3] - r[1]);
  ++this->Passes;
}

//------------------------------------------------------------------------------
vtkScreenPass& vtkPullPushReconstructionOpenGL::GetPass(
  Kind kind, const Layers& input, const Layers& output)
{
  std::unique_ptr<vtkScreenPass>& pass = this->Programs[kind][{ input, output }];
  if (!pass)
  {
    std::string text = "//VTK::System::Dec\n" + vtkSurfaceTarget::GetOutputDeclarations(output);
    switch (kind)
    {
      case PullPass:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "fine");
        text += std::string(vtkPullPushCommon) + vtkPullFS;
        break;
      case PushPass:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "fine");
        text += vtkSurfaceTarget::GetInputDeclarations(input, "coarse");
        text += std::string(vtkPullPushCommon) + vtkPushFS;
        break;
      default:
        text += vtkSurfaceTarget::GetInputDeclarations(input, "in") + vtkFillFS;
    }
    pass.reset(new vtkScreenPass(text));
  }
  return *pass;
}

void vtkPullPushReconstructionOpenGL::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Unfilled.ReleaseGraphicsResources(window);
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
