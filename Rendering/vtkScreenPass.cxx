// SPDX-License-Identifier: BSD-3-Clause
#include "vtkScreenPass.h"

#include "vtkPointSurfaceCompat.h"
#include "vtkPointSurfaceScreenVS.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkShaderProgram.h"

vtkScreenPass::vtkScreenPass(const std::string& fragmentShader, const std::string& vertexShader)
  : FragmentShader(fragmentShader)
  , VertexShader(vertexShader.empty() ? vtkPointSurfaceScreenVS : vertexShader)
{
}

vtkScreenPass::~vtkScreenPass() = default;

vtkShaderProgram* vtkScreenPass::Ready(vtkOpenGLRenderWindow* window)
{
  return window->GetShaderCache()->ReadyShaderProgram(
    this->VertexShader.c_str(), this->FragmentShader.c_str(), "");
}

void vtkScreenPass::Draw(vtkOpenGLRenderWindow* window, int x, int y, int width, int height)
{
  this->DrawPrimitives(window, x, y, width, height, GL_TRIANGLE_STRIP, 4);
}

void vtkScreenPass::DrawPoints(
  vtkOpenGLRenderWindow* window, int x, int y, int width, int height, int count, float size)
{
  window->GetState()->vtkglPointSize(size);
  this->DrawPrimitives(window, x, y, width, height, GL_POINTS, count);
}

void vtkScreenPass::DrawPrimitives(
  vtkOpenGLRenderWindow* window, int x, int y, int width, int height, unsigned int mode, int count)
{
  vtkOpenGLState* state = window->GetState();
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(x, y, width, height);
  this->VertexArray->Bind();
  glDrawArrays(mode, 0, count);
  this->VertexArray->Release();
}

void vtkScreenPass::ReleaseGraphicsResources()
{
  this->VertexArray->ReleaseGraphicsResources();
}
