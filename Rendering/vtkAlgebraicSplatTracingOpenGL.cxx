// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAlgebraicSplatTracingOpenGL.h"

#include "vtkAlgebraicSplatFS.h"
#include "vtkAlgebraicSplatOptions.h"
#include "vtkAlgebraicSplatTransform.h"
#include "vtkAlgebraicSplatVS.h"
#include "vtkDrawableSplats.h"
#include "vtkFirstRootShader.h"
#include "vtkPointSurfaceCompat.h"
#include "vtkPointSurfaceView.h"

#include "vtkMatrix4x4.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace
{
/// Texels of a splat before its coefficients.
constexpr int FrameTexels = 4;

int GetTexels(int order)
{
  return FrameTexels + (vtkAlgebraicSplat::GetNumberOfCoefficients(order) + 3) / 4;
}

template <size_t Size>
std::array<float, Size> ToFloats(const std::array<double, Size>& values)
{
  std::array<float, Size> floats;
  std::copy(values.begin(), values.end(), floats.begin());
  return floats;
}

void SetView(vtkShaderProgram* program, const vtkPointSurfaceView& view,
  const vtkAlgebraicSplatTransform& transform)
{
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(view.VCDC.data());
  program->SetUniformMatrix("VCDCMatrix", matrix);
  program->SetUniformMatrix3x3("toEye", ToFloats(transform.ToEye).data());
  program->SetUniform3f("origin", ToFloats(transform.Origin).data());
  program->SetUniform4f("eyeRay", ToFloats(transform.Rays.First).data());
  program->SetUniform4f("eyeRayStep", ToFloats(transform.Rays.Step).data());
  program->SetUniformf("shear", static_cast<float>(transform.Rays.Shear));
  const float pixel[2] = { 2.0f / view.Size[0], 2.0f / view.Size[1] };
  program->SetUniform2f("pixel", pixel);
  float planes[8][4] = {};
  for (size_t i = 0; i < transform.Planes.size(); ++i)
  {
    std::copy_n(ToFloats(transform.Planes[i]).data(), 4, planes[i]);
  }
  program->SetUniformi("numberOfPlanes", static_cast<int>(transform.Planes.size()));
  program->SetUniform4fv("planes", 8, planes);
  program->SetUniformi("cull", view.Cull);
}
}

vtkAlgebraicSplatTracingOpenGL::vtkAlgebraicSplatTracingOpenGL() = default;
vtkAlgebraicSplatTracingOpenGL::~vtkAlgebraicSplatTracingOpenGL() = default;

void vtkAlgebraicSplatTracingOpenGL::ReleaseGraphicsResources(vtkWindow* window)
{
  for (Group& group : this->Groups)
  {
    group.Texels->ReleaseGraphicsResources(window);
    group.Buffer->ReleaseGraphicsResources();
    group.Colors->ReleaseGraphicsResources(window);
    group.ColorBuffer->ReleaseGraphicsResources();
  }
  for (vtkSurfaceTarget* target : { &this->Visible, &this->Sums, &this->Ids })
  {
    target->ReleaseGraphicsResources(window);
  }
  this->Mean.ReleaseGraphicsResources();
  this->VertexArray->ReleaseGraphicsResources();
}

//------------------------------------------------------------------------------
vtkIdType vtkAlgebraicSplatTracingOpenGL::GetLargestNumberOfTexels(vtkIdType splats)
{
  return splats * GetTexels(vtkAlgebraicSplat::MaximumOrder);
}

size_t vtkAlgebraicSplatTracingOpenGL::Upload(
  vtkOpenGLRenderWindow* window, const vtkDrawableSplats& splats)
{
  size_t bytes = 0;
  this->Origin = splats.GetOrigin();
  for (int order = 1; order <= vtkAlgebraicSplat::MaximumOrder; ++order)
  {
    Group& group = this->Groups[order - 1];
    const std::vector<vtkDrawableSplats::Splat>& source = splats.GetSplats(order);
    group.Stride = GetTexels(order);
    group.Texels->ReleaseGraphicsResources(window);
    if (source.empty())
    {
      group.Buffer->ReleaseGraphicsResources();
      continue;
    }
    std::vector<float> texels(source.size() * group.Stride * 4, 0.0f);
    float* to = texels.data();
    for (const vtkDrawableSplats::Splat& splat : source)
    {
      std::copy_n(splat.Center.data(), 3, to);
      to[3] = splat.Radius;
      std::copy_n(splat.Normal.data(), 3, to + 4);
      to[7] = splat.Heights[0];
      std::copy_n(splat.U.data(), 3, to + 8);
      to[11] = splat.Heights[1];
      to[12] = static_cast<float>(splat.Id & 0xffffu);
      to[13] = static_cast<float>(splat.Id >> 16);
      std::copy_n(splat.Coefficients.data(), vtkAlgebraicSplat::GetNumberOfCoefficients(order),
        to + 4 * FrameTexels);
      to += 4 * group.Stride;
    }
    bytes += texels.size() * sizeof(float);
    group.Buffer->Upload(texels, vtkOpenGLBufferObject::TextureBuffer);
    group.Texels->SetContext(window);
    group.Texels->CreateTextureBuffer(
      static_cast<unsigned int>(texels.size() / 4), 4, VTK_FLOAT, group.Buffer);
  }
  return bytes;
}

size_t vtkAlgebraicSplatTracingOpenGL::UploadColors(vtkOpenGLRenderWindow* window,
  const vtkDrawableSplats& splats, const ColorSource& color, bool inBytes)
{
  size_t bytes = 0;
  for (int order = 1; order <= vtkAlgebraicSplat::MaximumOrder; ++order)
  {
    Group& group = this->Groups[order - 1];
    const std::vector<vtkDrawableSplats::Splat>& source = splats.GetSplats(order);
    group.Colors->ReleaseGraphicsResources(window);
    if (source.empty())
    {
      group.ColorBuffer->ReleaseGraphicsResources();
      continue;
    }
    std::vector<float> floats;
    for (const vtkDrawableSplats::Splat& splat : source)
    {
      const std::array<float, 4> rgba = color(splat.Id);
      floats.insert(floats.end(), rgba.begin(), rgba.end());
    }
    if (inBytes)
    {
      std::vector<unsigned char> values(floats.size());
      std::transform(floats.begin(), floats.end(), values.begin(),
        [](float value) { return static_cast<unsigned char>(std::lround(255.0f * value)); });
      group.ColorBuffer->Upload(values, vtkOpenGLBufferObject::TextureBuffer);
    }
    else
    {
      group.ColorBuffer->Upload(floats, vtkOpenGLBufferObject::TextureBuffer);
    }
    bytes += floats.size() * (inBytes ? 1 : sizeof(float));
    group.Colors->SetContext(window);
    group.Colors->CreateTextureBuffer(static_cast<unsigned int>(source.size()), 4,
      inBytes ? VTK_UNSIGNED_CHAR : VTK_FLOAT, group.ColorBuffer);
  }
  return bytes;
}

//------------------------------------------------------------------------------
void vtkAlgebraicSplatTracingOpenGL::Run(vtkOpenGLRenderWindow* window,
  const std::vector<Cloud>& clouds, const vtkPointSurfaceView& view,
  const vtkAlgebraicSplatOptions& options, vtkSurfaceTarget& surface)
{
  vtkOpenGLState* state = window->GetState();
  const int width = view.Size[0];
  const int height = view.Size[1];
  this->Passes = 0;
  this->Visible.Allocate(window, width, height, { vtkSurfaceTarget::Nearness });
  std::vector<vtkSurfaceTarget::Layer> layers = { vtkSurfaceTarget::Sum, vtkSurfaceTarget::Weight };
  if (surface.Has(vtkSurfaceTarget::Color))
  {
    layers.push_back(vtkSurfaceTarget::Color);
  }
  this->Sums.Allocate(window, width, height, layers);
  {
    vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
    state->vtkglEnable(GL_BLEND);
    state->vtkglBlendFunc(GL_ONE, GL_ONE);
    state->vtkglBlendEquation(GL_MAX);
    this->DrawClouds(window, clouds, view, options, nullptr, this->Visible);
    state->vtkglBlendEquation(GL_FUNC_ADD);
    this->DrawClouds(window, clouds, view, options, &this->Visible, this->Sums);
    state->vtkglDisable(GL_BLEND);
  }
  if (surface.Has(vtkSurfaceTarget::Id))
  {
    this->Ids.Allocate(window, width, height, { vtkSurfaceTarget::Id }, true);
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDepthMask(GL_TRUE);
    state->vtkglDepthFunc(GL_LESS);
    this->DrawClouds(window, clouds, view, options, &this->Visible, this->Ids);
    state->vtkglDisable(GL_DEPTH_TEST);
  }
  ++this->Passes;
  this->Mean.Run(window, view.Rectangle, this->Sums, this->Ids, surface);
}

void vtkAlgebraicSplatTracingOpenGL::DrawClouds(vtkOpenGLRenderWindow* window,
  const std::vector<Cloud>& clouds, const vtkPointSurfaceView& view,
  const vtkAlgebraicSplatOptions& options, vtkSurfaceTarget* visible, vtkSurfaceTarget& target)
{
  ++this->Passes;
  target.BindForWriting(window);
  target.Clear(window, view.Rectangle);
  if (visible)
  {
    visible->Activate();
  }
  this->VertexArray->Bind();
  for (const Cloud& cloud : clouds)
  {
    DrawSplats(window, cloud, options, visible, target);
  }
  this->VertexArray->Release();
  if (visible)
  {
    visible->Deactivate();
  }
}

void vtkAlgebraicSplatTracingOpenGL::DrawSplats(vtkOpenGLRenderWindow* window, const Cloud& cloud,
  const vtkAlgebraicSplatOptions& options, vtkSurfaceTarget* visible, vtkSurfaceTarget& target)
{
  const vtkAlgebraicSplatTransform transform(cloud.View, cloud.Uploaded->Origin);
  for (int order = 1; order <= vtkAlgebraicSplat::MaximumOrder; ++order)
  {
    Group& group = cloud.Uploaded->Groups[order - 1];
    const auto ranges = cloud.Splats->GetRanges(order, cloud.View.Ranges);
    if (ranges.empty())
    {
      continue;
    }
    const std::string fragmentShader = std::string("//VTK::System::Dec\n") +
      vtkFirstRootShader::GetExtensions() + "#define ORDER " + std::to_string(order) + "\n" +
      (visible ? vtkSurfaceTarget::GetInputDeclarations(visible->GetLayers(), "in") : "") +
      vtkSurfaceTarget::GetOutputDeclarations(target.GetLayers()) + vtkFirstRootShader::GetText() +
      vtkAlgebraicSplatFS;
    vtkShaderProgram* program =
      window->GetShaderCache()->ReadyShaderProgram(vtkAlgebraicSplatVS, fragmentShader.c_str(), "");
    if (!program)
    {
      break;
    }
    SetView(program, cloud.View, transform);
    program->SetUniformf("depthShift", static_cast<float>(options.DepthShift));
    program->SetUniformf("weightFalloff", static_cast<float>(options.WeightFalloff));
    program->SetUniformi("separateSides", options.SeparateSides);
    program->SetUniformi("stride", group.Stride);
    if (visible)
    {
      visible->SetSamplers(program, "in");
    }
    group.Texels->Activate();
    program->SetUniformi("splats", group.Texels->GetTextureUnit());
    if (target.Has(vtkSurfaceTarget::Id))
    {
      program->SetUniformi("firstId", static_cast<int>(cloud.FirstId));
    }
    const bool colored = target.Has(vtkSurfaceTarget::Color) && cloud.HasColors;
    if (target.Has(vtkSurfaceTarget::Color))
    {
      if (colored)
      {
        group.Colors->Activate();
      }
      // what is not looked up has to lead to a buffer all the same
      program->SetUniformi("colors", (colored ? group.Colors : group.Texels)->GetTextureUnit());
      program->SetUniformi("hasColors", colored);
      program->SetUniform4f("color", cloud.Color.data());
    }
    for (const auto& range : ranges)
    {
      program->SetUniformi("first", static_cast<int>(range[0]));
      glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(range[1] - range[0]));
    }
    if (colored)
    {
      group.Colors->Deactivate();
    }
    group.Texels->Deactivate();
  }
}
