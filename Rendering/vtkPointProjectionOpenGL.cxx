// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointProjectionOpenGL.h"

#include "vtkPointProjectionOptions.h"
#include "vtkPointSurfaceCompat.h"
#include "vtkPointSurfaceView.h"
#include "vtkSurfaceTarget.h"

#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointProjectionFS.h"
#include "vtkPointProjectionVS.h"
#include "vtkShaderProgram.h"

namespace
{
/// As the shader's colorSource: the first of the attributes that the points have.
int GetColorSource(vtkOpenGLVertexBufferObjectGroup* buffers)
{
  const char* const sources[] = { "scalarColor", "colorTCoord", "tcoord" };
  for (int i = 0; i < 3; ++i)
  {
    if (buffers->GetNumberOfComponents(sources[i]) > 0)
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
  this->Ids->IndexCount = ids.size();
  if (!ids.empty())
  {
    this->Ids->Upload(ids, vtkOpenGLIndexBufferObject::ElementArrayBuffer);
  }
  return ids.size() * sizeof(unsigned int);
}

void vtkPointProjectionOpenGL::ReleaseGraphicsResources(vtkWindow*)
{
  this->Ids->ReleaseGraphicsResources();
  this->IdsTime = 0;
  this->VertexArray->ReleaseGraphicsResources();
  this->BoundProgram = nullptr;
}

//------------------------------------------------------------------------------
vtkIdType vtkPointProjectionOpenGL::Draw(vtkOpenGLRenderWindow* window, const Points& points,
  const vtkPointSurfaceView& view, const vtkPointProjectionOptions& options,
  vtkSurfaceTarget& target, vtkSurfaceTarget* nearest)
{
  vtkOpenGLState* state = window->GetState();
  target.BindForWriting(window);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(view.Rectangle[0], view.Rectangle[1], view.Rectangle[2], view.Rectangle[3]);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  // of points at the same depth the first one stays
  state->vtkglDepthFunc(nearest ? GL_GREATER : GL_LESS);
  target.Clear(nearest ? 0.0f : 1.0f);

  const std::string fragmentShader = "//VTK::System::Dec\n" +
    vtkSurfaceTarget::GetOutputDeclarations(target.GetLayers()) + vtkPointProjectionFS;
  vtkShaderProgram* program =
    window->GetShaderCache()->ReadyShaderProgram(vtkPointProjectionVS, fragmentShader.c_str(), "");
  if (!program)
  {
    return 0;
  }
  this->BindAttributes(program, points);
  this->SetUniforms(program, points, view, options);
  program->SetUniformi("onlyFarthest", nearest != nullptr);
  if (nearest)
  {
    nearest->Activate();
    nearest->SetSamplers(program, "nearest");
  }

  state->vtkglPointSize(1.0f);
  const vtkIdType drawn = this->DrawRanges(view);
  this->VertexArray->Release();
  if (nearest)
  {
    nearest->Deactivate();
  }
  state->vtkglDisable(GL_DEPTH_TEST);
  return drawn;
}

vtkIdType vtkPointProjectionOpenGL::DrawRanges(const vtkPointSurfaceView& view)
{
  const bool listed = this->Ids->IndexCount > 0;
  vtkIdType drawn = 0;
  if (listed)
  {
    this->Ids->Bind();
  }
  for (const auto& range : view.Ranges)
  {
    const auto count = static_cast<GLsizei>(range[1] - range[0]);
    const size_t offset = static_cast<size_t>(range[0]) * sizeof(GLuint);
    listed
      ? glDrawElements(GL_POINTS, count, GL_UNSIGNED_INT, reinterpret_cast<const GLvoid*>(offset))
      : glDrawArrays(GL_POINTS, static_cast<GLint>(range[0]), count);
    drawn += count;
  }
  if (listed)
  {
    this->Ids->Release();
  }
  return drawn;
}

//------------------------------------------------------------------------------
void vtkPointProjectionOpenGL::BindAttributes(vtkShaderProgram* program, const Points& points)
{
  vtkOpenGLVertexBufferObjectGroup* buffers = points.Buffers;
  this->VertexArray->Bind();
  if (program == this->BoundProgram && buffers->GetMTime() < this->BindTime &&
    program->GetMTime() < this->BindTime)
  {
    return;
  }
  this->VertexArray->ReleaseGraphicsResources();
  this->VertexArray->Bind();
  buffers->AddAllAttributesToVAO(program, this->VertexArray);
  if (!points.HaveNormals)
  {
    this->VertexArray->RemoveAttributeArray("normalMC"); // which then reads as zero
  }
  this->BoundProgram = program;
  this->BindTime.Modified();
}

void vtkPointProjectionOpenGL::SetUniforms(vtkShaderProgram* program, const Points& points,
  const vtkPointSurfaceView& view, const vtkPointProjectionOptions& options)
{
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(view.MCVC.data());
  program->SetUniformMatrix("MCVCMatrix", matrix);
  matrix->DeepCopy(view.VCDC.data());
  program->SetUniformMatrix("VCDCMatrix", matrix);
  vtkNew<vtkMatrix3x3> normal;
  normal->DeepCopy(view.Normal.data());
  program->SetUniformMatrix("normalMatrix", normal);

  program->SetUniformf("uniformRadius", static_cast<float>(points.UniformRadius));
  program->SetUniformf("radiusScale", static_cast<float>(view.RadiusScale));
  program->SetUniformi("colorSource", GetColorSource(points.Buffers));
  program->SetUniformi("cull", view.Cull);
  const float depthRange[2] = { static_cast<float>(view.DepthRange[0]),
    static_cast<float>(view.DepthRange[1]) };
  program->SetUniform2f("depthRange", depthRange);
  const float size[2] = { static_cast<float>(view.Size[0]), static_cast<float>(view.Size[1]) };
  program->SetUniform2f("targetSize", size);
  program->SetUniformi("subpixelCenters", options.SubpixelCenters);
  program->SetUniformi("centerDepths", options.CenterDepths);
  program->SetUniformf("depthTolerance", options.DepthTolerance);

  float planes[6][4];
  for (int i = 0; i < 24; ++i)
  {
    planes[i / 4][i % 4] = static_cast<float>(view.ClippingPlanes[i / 4][i % 4]);
  }
  program->SetUniformi("numberOfClippingPlanes", view.NumberOfClippingPlanes);
  program->SetUniform4fv("clippingPlanes", 6, planes);
}
