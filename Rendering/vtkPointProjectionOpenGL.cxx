// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointProjectionOpenGL.h"

#include "vtkDrawablePoints.h"
#include "vtkPointProjectionOptions.h"
#include "vtkPointSurfaceCompat.h"
#include "vtkPointSurfaceView.h"
#include "vtkScreenPass.h"
#include "vtkSurfaceTarget.h"

#include "vtkFloatArray.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointAttributes.h"
#include "vtkPointAverageFS.h"
#include "vtkPointProjectionFS.h"
#include "vtkPointProjectionVS.h"
#include "vtkPointSumFS.h"
#include "vtkPolyData.h"
#include "vtkShaderProgram.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace
{
const char* const ColorSources[] = { "scalarColor", "colorTCoord", "tcoord" };

/// As the shader's colorSource: one more than the first of the attributes that the points have.
int GetColorSource(vtkOpenGLVertexBufferObjectGroup* buffers)
{
  for (int i = 0; i < 3; ++i)
  {
    if (buffers->GetNumberOfComponents(ColorSources[i]) > 0)
    {
      return i + 1;
    }
  }
  return 0;
}
}

bool vtkPointProjectionOpenGL::HasColors(vtkOpenGLVertexBufferObjectGroup* buffers)
{
  return GetColorSource(buffers) > 0;
}

vtkPointProjectionOpenGL::vtkPointProjectionOpenGL() = default;
vtkPointProjectionOpenGL::~vtkPointProjectionOpenGL() = default;

size_t vtkPointProjectionOpenGL::UploadIds(const std::vector<unsigned int>& ids, vtkMTimeType time)
{
  if (this->IdsTime == time)
  {
    return 0;
  }
  this->IdsTime = time;
  this->Ids->Upload(ids, vtkOpenGLBufferObject::ArrayBuffer);
  return ids.size() * sizeof(unsigned int);
}

void vtkPointProjectionOpenGL::SetPoints(
  const vtkDrawablePoints* points, vtkDataArray* colors, const vtkThinnedPoints::Frame& frame)
{
  this->Points = points;
  this->Colors = colors;
  this->Frame = frame;
  const vtkThinnedPoints::Source source = vtkThinnedPoints::GetSource(*points, colors, frame);
  if (source != this->ThinnedSource)
  {
    this->ThinnedSource = source;
    this->Thinned.clear();
    this->PointsTime.Modified();
  }
}

size_t vtkPointProjectionOpenGL::UploadThinned(int size)
{
  if (size == 1 || this->Thinned.count(size) > 0)
  {
    return 0;
  }
  const vtkThinnedPoints thinned(*this->Points, this->Colors, this->Frame, size);
  Uploaded& uploaded = this->Thinned[size];
  uploaded.Firsts = thinned.Firsts;
  size_t bytes = 0;
  const auto upload = [&bytes](vtkOpenGLBufferObject* buffer, const auto* values, size_t count)
  {
    if (count > 0)
    {
      buffer->Upload(values, count, vtkOpenGLBufferObject::ArrayBuffer);
      bytes += count * sizeof(*values);
    }
  };
  upload(uploaded.Ids, thinned.Ids.data(), thinned.Ids.size());
  upload(uploaded.Positions, thinned.Positions.data(), thinned.Positions.size());
  upload(uploaded.Normals, thinned.Normals.data(), thinned.Normals.size());
  upload(uploaded.Radii, thinned.Radii.data(), thinned.Radii.size());
  if (auto* colors = vtkArrayDownCast<vtkUnsignedCharArray>(thinned.Colors))
  {
    upload(uploaded.Colors, colors->GetPointer(0), colors->GetNumberOfValues());
  }
  else if (auto* coordinates = vtkArrayDownCast<vtkFloatArray>(thinned.Colors))
  {
    upload(uploaded.Colors, coordinates->GetPointer(0), coordinates->GetNumberOfValues());
  }
  return bytes;
}

vtkPointProjectionOpenGL::Ranges vtkPointProjectionOpenGL::GetDrawn(
  int size, const Ranges& ranges) const
{
  return size == 1 ? ranges : vtkThinnedPoints::GetGroups(this->Thinned.at(size).Firsts, ranges);
}

void vtkPointProjectionOpenGL::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Ids->ReleaseGraphicsResources();
  this->IdsTime = 0;
  this->Thinned.clear();
  this->PointsTime.Modified();
  auto release = [](Pass& pass)
  {
    pass.VertexArray->ReleaseGraphicsResources();
    pass.BoundProgram = nullptr;
  };
  release(this->FirstPass);
  release(this->SumPass);
  std::for_each(this->OtherPasses.begin(), this->OtherPasses.end(), release);
  this->Sums.ReleaseGraphicsResources(window);
  for (auto& entry : this->AveragePasses)
  {
    entry.second->ReleaseGraphicsResources();
  }
}

//------------------------------------------------------------------------------
void vtkPointProjectionOpenGL::Draw(vtkOpenGLRenderWindow* window, const std::vector<Cloud>& clouds,
  const vtkPointProjectionOptions& options, vtkSurfaceTarget& target, vtkSurfaceTarget* nearest)
{
  this->DrawFirst(window, clouds, options, target, nearest);
  if (options.AveragePoints)
  {
    this->DrawSums(window, clouds, options, target);
    this->Average(window, clouds.front().View.Rectangle, options, target);
  }
}

void vtkPointProjectionOpenGL::DrawFirst(vtkOpenGLRenderWindow* window,
  const std::vector<Cloud>& clouds, const vtkPointProjectionOptions& options,
  vtkSurfaceTarget& target, vtkSurfaceTarget* nearest)
{
  vtkOpenGLState* state = window->GetState();
  target.BindForWriting(window);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  // of points at the same depth the first one stays
  state->vtkglDepthFunc(nearest ? GL_GREATER : GL_LESS);
  target.Clear(window, clouds.front().View.Rectangle, nearest ? 0.0f : 1.0f);
  if (nearest)
  {
    nearest->Activate();
  }
  const std::string shader =
    vtkSurfaceTarget::GetOutputDeclarations(target.GetLayers()) + vtkPointProjectionFS;
  const char* drawn = nearest ? "ONLY_FARTHEST" : "ALL_POINTS";
  for (const Cloud& cloud : clouds)
  {
    Pass& pass = cloud.Projection->FirstPass;
    if (vtkShaderProgram* program = ReadyProgram(window, pass, drawn, shader, cloud, options))
    {
      if (nearest)
      {
        nearest->SetSamplers(program, "nearest");
      }
      DrawRanges(pass, cloud);
    }
  }
  if (nearest)
  {
    nearest->Deactivate();
  }
  state->vtkglDisable(GL_DEPTH_TEST);
}

/// Pixels with sums get the depth 0, so that Average() runs over these alone.
void vtkPointProjectionOpenGL::DrawSums(vtkOpenGLRenderWindow* window,
  const std::vector<Cloud>& clouds, const vtkPointProjectionOptions& options,
  vtkSurfaceTarget& target)
{
  std::vector<vtkSurfaceTarget::Layer> sums = { vtkSurfaceTarget::Sum, vtkSurfaceTarget::Change };
  if (target.Has(vtkSurfaceTarget::Color))
  {
    sums.push_back(vtkSurfaceTarget::Color);
  }
  std::vector<vtkSurfaceTarget::Layer> layers = sums;
  layers.push_back(vtkSurfaceTarget::Surface); // of the nearest point, which is not added up
  const auto surfaceLayer = static_cast<GLuint>(sums.size());
  this->Sums.Allocate(window, target.GetWidth(), target.GetHeight(), layers);
  this->Sums.ShareDepthBuffer(window, target);
  vtkOpenGLState* state = window->GetState();
  state->vtkglDepthMask(GL_FALSE);
  this->Sums.BindForWriting(window, sums);
  this->Sums.Clear(window, clouds.front().View.Rectangle);
  this->Sums.BindForWriting(window);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_ALWAYS);
  vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFunc(GL_ONE, GL_ONE);
  glDisablei(GL_BLEND, surfaceLayer);
  target.Activate();
  const std::string shader = vtkSurfaceTarget::GetOutputDeclarations(layers) + vtkPointSumFS;
  for (const Cloud& cloud : clouds)
  {
    Pass& pass = cloud.Projection->SumPass;
    if (vtkShaderProgram* program =
          ReadyProgram(window, pass, "ONLY_COMPANIONS", shader, cloud, options))
    {
      target.SetSamplers(program, "nearest");
      program->SetUniformi("twoSided", cloud.View.Cull == vtkPointSurfaceView::NoCulling);
      DrawRanges(pass, cloud);
    }
  }
  target.Deactivate();
  state->vtkglDisable(GL_BLEND); // of all layers
  state->vtkglDisable(GL_DEPTH_TEST);
}

void vtkPointProjectionOpenGL::Average(vtkOpenGLRenderWindow* window,
  const std::array<int, 4>& rectangle, const vtkPointProjectionOptions& options,
  vtkSurfaceTarget& target)
{
  std::vector<vtkSurfaceTarget::Layer> layers = target.GetLayers();
  layers.pop_back(); // the id stays that of the nearest one
  std::unique_ptr<vtkScreenPass>& pass = this->AveragePasses[layers];
  if (!pass)
  {
    pass.reset(new vtkScreenPass("//VTK::System::Dec\n" +
      vtkSurfaceTarget::GetInputDeclarations(this->Sums.GetLayers(), "sum") +
      vtkSurfaceTarget::GetOutputDeclarations(layers) + vtkPointAverageFS));
  }
  vtkShaderProgram* program = pass->Ready(window);
  if (!program)
  {
    return;
  }
  this->Sums.Activate();
  this->Sums.SetSamplers(program, "sum");
  program->SetUniformi("centerDepths", options.CenterDepths);
  target.BindForWriting(window, layers);
  vtkOpenGLState* state = window->GetState();
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglDepthFunc(GL_EQUAL);
  vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFunc(GL_ONE, GL_ONE);
  pass->Draw(window, rectangle[0], rectangle[1], rectangle[2], rectangle[3]);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  this->Sums.Deactivate();
}

//------------------------------------------------------------------------------
vtkShaderProgram* vtkPointProjectionOpenGL::ReadyProgram(vtkOpenGLRenderWindow* window, Pass& pass,
  const std::string& drawn, const std::string& fragmentShader, const Cloud& cloud,
  const vtkPointProjectionOptions& options)
{
  const Shaders shaders = { "#define " + drawn + "\n" + vtkPointProjectionVS, "",
    "//VTK::System::Dec\n" + fragmentShader };
  vtkShaderProgram* program = ReadyShaders(window, pass, shaders, cloud);
  if (program)
  {
    const vtkPointSurfaceView& view = cloud.View;
    const float depthRange[2] = { static_cast<float>(view.DepthRange[0]),
      static_cast<float>(view.DepthRange[1]) };
    program->SetUniform2f("depthRange", depthRange);
    program->SetUniformi("subpixelCenters", options.SubpixelCenters);
    program->SetUniformi("centerDepths", options.CenterDepths);
    program->SetUniformf("depthTolerance", options.DepthTolerance);
    program->SetUniformf("largestReach", options.LargestReach);
    window->GetState()->vtkglPointSize(1.0f);
  }
  return program;
}

vtkShaderProgram* vtkPointProjectionOpenGL::ReadyShaders(
  vtkOpenGLRenderWindow* window, Pass& pass, const Shaders& shaders, const Cloud& cloud)
{
  vtkShaderProgram* program =
    window->GetShaderCache()->ReadyShaderProgram((vtkPointAttributes + shaders.Vertex).c_str(),
      shaders.Fragment.c_str(), shaders.Geometry.c_str());
  if (program)
  {
    cloud.Projection->BindAttributes(pass, program, cloud);
    SetUniforms(program, cloud);
  }
  return program;
}

void vtkPointProjectionOpenGL::DrawBy(vtkOpenGLRenderWindow* window,
  const std::vector<Cloud>& clouds, const Shaders& shaders, int use,
  const std::function<void(vtkShaderProgram*)>& setUniforms)
{
  for (const Cloud& cloud : clouds)
  {
    Pass& pass = cloud.Projection->OtherPasses[use];
    if (vtkShaderProgram* program = ReadyShaders(window, pass, shaders, cloud))
    {
      setUniforms(program);
      DrawRanges(pass, cloud);
    }
  }
}

void vtkPointProjectionOpenGL::DrawRanges(Pass& pass, const Cloud& cloud)
{
  std::vector<GLint> firsts;
  std::vector<GLsizei> counts;
  for (const auto& range : cloud.View.Ranges)
  {
    firsts.push_back(static_cast<GLint>(range[0]));
    counts.push_back(static_cast<GLsizei>(range[1] - range[0]));
  }
  glMultiDrawArrays(GL_POINTS, firsts.data(), counts.data(), static_cast<GLsizei>(firsts.size()));
  pass.VertexArray->Release();
}

void vtkPointProjectionOpenGL::BindAttributes(
  Pass& pass, vtkShaderProgram* program, const Cloud& cloud)
{
  vtkOpenGLVertexBufferObjectGroup* buffers = cloud.Buffers;
  pass.VertexArray->Bind();
  if (program == pass.BoundProgram && cloud.Thinning == pass.BoundThinning &&
    this->PointsTime < pass.BindTime && buffers->GetMTime() < pass.BindTime &&
    program->GetMTime() < pass.BindTime)
  {
    return;
  }
  pass.VertexArray->ReleaseGraphicsResources();
  pass.VertexArray->Bind();
  if (cloud.Thinning > 1)
  {
    BindThinned(pass, program, cloud);
  }
  else
  {
    buffers->AddAllAttributesToVAO(program, pass.VertexArray);
    BindIds(program, this->Ids);
  }
  if (!cloud.HaveNormals)
  {
    pass.VertexArray->RemoveAttributeArray("normalMC"); // which then reads as zero
  }
  pass.BoundProgram = program;
  pass.BoundThinning = cloud.Thinning;
  pass.BindTime.Modified();
}

void vtkPointProjectionOpenGL::BindThinned(
  Pass& pass, vtkShaderProgram* program, const Cloud& cloud)
{
  Uploaded& thinned = cloud.Projection->Thinned.at(cloud.Thinning);
  const auto bind = [&](vtkOpenGLBufferObject* buffer, const char* name, int type, int components)
  {
    const size_t size = components * (type == VTK_FLOAT ? sizeof(float) : 1);
    if (buffer->GetHandle() != 0 && program->IsAttributeUsed(name))
    {
      pass.VertexArray->AddAttributeArray(
        program, buffer, name, 0, size, type, components, type != VTK_FLOAT);
    }
  };
  bind(thinned.Positions, "vertexMC", VTK_FLOAT, 3);
  bind(thinned.Normals, "normalMC", VTK_FLOAT, 3);
  bind(thinned.Radii, "radiusMC", VTK_FLOAT, 1);
  if (const int source = GetColorSource(cloud.Buffers))
  {
    const char* name = ColorSources[source - 1];
    bind(thinned.Colors, name, source == 1 ? VTK_UNSIGNED_CHAR : VTK_FLOAT,
      cloud.Buffers->GetNumberOfComponents(name));
  }
  BindIds(program, thinned.Ids);
}

/// VTK's vertex arrays have floats alone, in which ids over 2^24 would not be told apart.
void vtkPointProjectionOpenGL::BindIds(vtkShaderProgram* program, vtkOpenGLBufferObject* ids)
{
  const GLint place = glGetAttribLocation(static_cast<GLuint>(program->GetHandle()), "pointId");
  if (place >= 0)
  {
    ids->Bind();
    glEnableVertexAttribArray(static_cast<GLuint>(place));
    glVertexAttribIPointer(static_cast<GLuint>(place), 1, GL_UNSIGNED_INT, 0, nullptr);
    ids->Release();
  }
}

void vtkPointProjectionOpenGL::SetUniforms(vtkShaderProgram* program, const Cloud& cloud)
{
  const vtkPointSurfaceView& view = cloud.View;
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(view.MCVC.data());
  program->SetUniformMatrix("MCVCMatrix", matrix);
  matrix->DeepCopy(view.VCDC.data());
  program->SetUniformMatrix("VCDCMatrix", matrix);
  vtkNew<vtkMatrix3x3> normal;
  normal->DeepCopy(view.Normal.data());
  program->SetUniformMatrix("normalMatrix", normal);

  program->SetUniformf("uniformRadius", static_cast<float>(cloud.UniformRadius));
  program->SetUniformf("radiusScale", static_cast<float>(view.RadiusScale));
  program->SetUniformi("colorSource", GetColorSource(cloud.Buffers));
  program->SetUniform4f("constantColor", cloud.Color.data());
  program->SetUniformi("firstId", static_cast<int>(cloud.FirstId));
  program->SetUniformi("cull", view.Cull);
  const float size[2] = { static_cast<float>(view.Size[0]), static_cast<float>(view.Size[1]) };
  program->SetUniform2f("targetSize", size);
  float planes[6][4];
  for (int i = 0; i < 24; ++i)
  {
    planes[i / 4][i % 4] = static_cast<float>(view.ClippingPlanes[i / 4][i % 4]);
  }
  program->SetUniformi("numberOfClippingPlanes", view.NumberOfClippingPlanes);
  program->SetUniform4fv("clippingPlanes", 6, planes);
}
