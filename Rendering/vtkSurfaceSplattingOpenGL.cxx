// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceSplattingOpenGL.h"

#include "vtkPointSurfaceCompat.h"
#include "vtkSurfaceSplatFS.h"
#include "vtkSurfaceSplatGS.h"
#include "vtkSurfaceSplatParameters.h"
#include "vtkSurfaceSplatVS.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"

#include <sstream>

namespace
{
/// Ways to draw splats; see vtkPointProjectionOpenGL::DrawBy().
enum Use
{
  ForDepths,
  ForSums,
  ForIds
};
static_assert(ForIds < vtkPointProjectionOpenGL::NumberOfUses, "each use has a number");

std::string GetConstants()
{
  using Parameters = vtkSurfaceSplatParameters;
  std::ostringstream text;
  text << std::showpoint << "#define LOW_PASS_VARIANCE " << Parameters::LowPassVariance
       << "\n#define CORE_LIMIT " << Parameters::CoreLimit << "\n#define MARGIN_COSINE "
       << Parameters::MarginCosine << "\n#define TOLERANCE_PIXELS " << Parameters::TolerancePixels
       << "\n#define LARGEST_SHARE_OF_DEPTH " << Parameters::LargestShareOfDepth << "\n";
  return text.str();
}

void SetUniforms(vtkShaderProgram* program, const vtkSurfaceSplatParameters& parameters)
{
  program->SetUniformf("pixelSize", parameters.GetPixelSize());
  program->SetUniformf("blendRadius", static_cast<float>(parameters.Options.BlendRadius));
  program->SetUniformf("depthTolerance", static_cast<float>(parameters.Options.DepthTolerance));
}
}

vtkSurfaceSplattingOpenGL::vtkSurfaceSplattingOpenGL() = default;
vtkSurfaceSplattingOpenGL::~vtkSurfaceSplattingOpenGL() = default;

void vtkSurfaceSplattingOpenGL::ReleaseGraphicsResources(vtkWindow* window)
{
  for (vtkSurfaceTarget* target : { &this->Visible, &this->Sums, &this->Ids })
  {
    target->ReleaseGraphicsResources(window);
  }
  this->Mean.ReleaseGraphicsResources();
}

void vtkSurfaceSplattingOpenGL::FindDepths(vtkOpenGLRenderWindow* window,
  const vtkSurfaceSplatParameters& parameters,
  const std::vector<vtkPointProjectionOpenGL::Cloud>& clouds)
{
  this->Passes = 0;
  const auto& size = parameters.View.Size;
  this->Visible.Allocate(window, size[0], size[1], { vtkSurfaceTarget::Nearness });
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFunc(GL_ONE, GL_ONE);
  state->vtkglBlendEquation(GL_MAX);
  this->DrawSplats(window, parameters, clouds, ForDepths, this->Visible);
  state->vtkglBlendEquation(GL_FUNC_ADD);
  state->vtkglDisable(GL_BLEND);
}

void vtkSurfaceSplattingOpenGL::BlendSplats(vtkOpenGLRenderWindow* window,
  const vtkSurfaceSplatParameters& parameters,
  const std::vector<vtkPointProjectionOpenGL::Cloud>& clouds, vtkSurfaceTarget& surface)
{
  const auto& size = parameters.View.Size;
  std::vector<vtkSurfaceTarget::Layer> layers = { vtkSurfaceTarget::Sum, vtkSurfaceTarget::Weight };
  if (surface.Has(vtkSurfaceTarget::Color))
  {
    layers.push_back(vtkSurfaceTarget::Color);
  }
  this->Sums.Allocate(window, size[0], size[1], layers);
  vtkOpenGLState* state = window->GetState();
  this->Visible.Activate();
  {
    vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
    state->vtkglEnable(GL_BLEND);
    state->vtkglBlendFunc(GL_ONE, GL_ONE);
    this->DrawSplats(window, parameters, clouds, ForSums, this->Sums);
    state->vtkglDisable(GL_BLEND);
  }
  if (surface.Has(vtkSurfaceTarget::Id))
  {
    this->Ids.Allocate(window, size[0], size[1], { vtkSurfaceTarget::Id }, true);
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDepthMask(GL_TRUE);
    state->vtkglDepthFunc(GL_LESS); // of splats of the same weight the first one stays
    this->DrawSplats(window, parameters, clouds, ForIds, this->Ids);
    state->vtkglDisable(GL_DEPTH_TEST);
  }
  this->Visible.Deactivate();
  ++this->Passes;
  this->Mean.Run(window, parameters.View.Rectangle, this->Sums, this->Ids, surface);
}

void vtkSurfaceSplattingOpenGL::DrawSplats(vtkOpenGLRenderWindow* window,
  const vtkSurfaceSplatParameters& parameters,
  const std::vector<vtkPointProjectionOpenGL::Cloud>& clouds, int use, vtkSurfaceTarget& target)
{
  ++this->Passes;
  target.BindForWriting(window);
  target.Clear(window, parameters.View.Rectangle);
  const bool readsDepths = use != ForDepths;
  vtkPointProjectionOpenGL::Shaders shaders;
  shaders.Vertex = vtkSurfaceSplatVS;
  shaders.Geometry = vtkSurfaceSplatGS;
  shaders.Geometry.insert(shaders.Geometry.find('\n') + 1, GetConstants());
  shaders.Fragment = "//VTK::System::Dec\n" + GetConstants() +
    (readsDepths ? vtkSurfaceTarget::GetInputDeclarations(this->Visible.GetLayers(), "in") : "") +
    vtkSurfaceTarget::GetOutputDeclarations(target.GetLayers()) + vtkSurfaceSplatFS;
  vtkPointProjectionOpenGL::DrawBy(window, clouds, shaders, use,
    [&](vtkShaderProgram* program)
    {
      SetUniforms(program, parameters);
      if (readsDepths)
      {
        this->Visible.SetSamplers(program, "in");
      }
    });
}
