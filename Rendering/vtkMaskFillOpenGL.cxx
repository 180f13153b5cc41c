// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaskFillOpenGL.h"

#include "vtkMaskFillFS.h"
#include "vtkMaskFillOptions.h"
#include "vtkPointSurfaceCompat.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"

#include <utility>
#include <vector>

vtkMaskFillOpenGL::vtkMaskFillOpenGL()
  : Fill(vtkMaskFillFS)
  , Count(std::string("#define COUNTING\n") + vtkMaskFillFS)
{
}

namespace
{
/// Whether a query of samples can begin: OpenGL has one at a time, and depth peeling has it around
/// all that is drawn.
bool CanCountSamples()
{
  bool can = true;
  std::vector<GLenum> kinds = { GL_SAMPLES_PASSED };
#ifdef GL_ANY_SAMPLES_PASSED
  kinds.push_back(GL_ANY_SAMPLES_PASSED);
#endif
  for (GLenum kind : kinds)
  {
    GLint current = 0;
    glGetQueryiv(kind, GL_CURRENT_QUERY, &current);
    can = can && current == 0;
  }
  return can;
}
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
  auto isDone = [&]()
  {
    state->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glBeginQuery(GL_SAMPLES_PASSED, query);
    this->Count.Run(window, *surface, *spare, rectangle, setUniforms);
    glEndQuery(GL_SAMPLES_PASSED);
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    ++passes;
    GLuint fillable = 0;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &fillable);
    return fillable == 0;
  };
  const bool canCount = CanCountSamples(); // else all iterations are made, though some do nothing
  int iterations = 0;
  while (iterations < options.MaximumIterations && !(canCount && isDone()))
  {
    ++iterations;
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
