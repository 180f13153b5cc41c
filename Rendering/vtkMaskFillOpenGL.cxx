// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaskFillOpenGL.h"

#include "vtkMaskFillFS.h"
#include "vtkMaskFillOptions.h"
#include "vtkPointSurfaceCompat.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"

#include <utility>

vtkMaskFillOpenGL::vtkMaskFillOpenGL()
  : Fill(vtkMaskFillFS)
  , Count(std::string("#define COUNTING\n") + vtkMaskFillFS)
{
}

int vtkMaskFillOpenGL::Run(vtkOpenGLRenderWindow* window, const vtkMaskFillOptions& options,
  const std::array<int, 4>& rectangle, vtkSurfaceTarget*& surface, vtkSurfaceTarget*& spare,
  int& passes)
{
  auto setUniforms = [&options](vtkShaderProgram* program)
  {
    program->SetUniformi("occluded", options.Occluded);
    program->SetUniform2f("depthStep", options.DepthStep.GetData());
    program->SetUniformi("reach", options.Reach);
  };
  vtkOpenGLState* state = window->GetState();
  GLuint query = 0;
  glGenQueries(1, &query);
  int iterations = 0;
  for (; iterations < options.MaximumIterations; ++iterations)
  {
    state->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glBeginQuery(GL_SAMPLES_PASSED, query);
    this->Count.Run(window, *surface, *spare, rectangle, setUniforms);
    glEndQuery(GL_SAMPLES_PASSED);
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    ++passes;
    GLuint fillable = 0;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &fillable);
    if (fillable == 0)
    {
      break;
    }
    this->Fill.Run(window, *surface, *spare, rectangle, setUniforms);
    ++passes;
    std::swap(surface, spare);
  }
  glDeleteQueries(1, &query);
  return iterations;
}

void vtkMaskFillOpenGL::ReleaseGraphicsResources()
{
  this->Fill.ReleaseGraphicsResources();
  this->Count.ReleaseGraphicsResources();
}
