// SPDX-License-Identifier: BSD-3-Clause
#include "vtkScreenPass.h"

#include "vtkPointSurfaceCompat.h"
#include "vtkPointSurfaceScreenVS.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkShaderProgram.h"

vtkScreenPass::vtkScreenPass(const std::string& fragmentShader)
  : FragmentShader(fragmentShader)
{
}

vtkScreenPass::~vtkScreenPass() = default;

vtkShaderProgram* vtkScreenPass::Ready(vtkOpenGLRenderWindow* window)
{
  return window->GetShaderCache()->ReadyShaderProgram(
    vtkPointSurfaceScreenVS, this->FragmentShader.c_str(), "");
}

void vtkScreenPass::Draw(vtkOpenGLRenderWindow* window, int x, int y, int width, int height)
{
  vtkOpenGLState* state = window->GetState();
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(x, y, width, height);
  this->VertexArray->Bind();
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  this->VertexArray->Release();
}

void vtkScreenPass::ReleaseGraphicsResources()
{
  this->VertexArray->ReleaseGraphicsResources();
}
