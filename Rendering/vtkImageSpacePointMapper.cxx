// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImageSpacePointMapper.h"

#include "vtkDiscFillCPU.h"
#include "vtkDiscFillOpenGL.h"
#include "vtkDiscFillOptions.h"
#include "vtkLitSmoothingImpl.h"
#include "vtkMaskFillCPU.h"
#include "vtkMaskFillOpenGL.h"
#include "vtkMaskFillOptions.h"
#include "vtkOutlineCoverageCPU.h"
#include "vtkOutlineCoverageOpenGL.h"
#include "vtkPointProjectionOptions.h"
#include "vtkPointSurfaceCompat.h"
#include "vtkPointSurfaceView.h"
#include "vtkSurfaceBufferShading.h"
#include "vtkSurfaceCopyFS.h"
#include "vtkSurfaceImage.h"
#include "vtkSurfacePixels.h"
#include "vtkSurfaceSmoothingCPU.h"
#include "vtkSurfaceSmoothingOpenGL.h"
#include "vtkSurfaceSmoothingOptions.h"
#include "vtkSurfaceStepOpenGL.h"
#include "vtkSurfaceTarget.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLRenderTimer.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

/// What a frame is to do, as both forms of the steps take it.
struct vtkImageSpacePointMapper::Plan
{
  std::array<int, 4> Rectangle{}; ///< x, y, x end, y end
  vtkPointProjectionOptions Projection;
  vtkDiscFillOptions Discs;
  vtkMaskFillOptions Background;
  vtkMaskFillOptions Occluded;
  vtkSurfaceSmoothingOptions Smoothing;
  int SmoothingIterations = 0;
  bool Antialias = false;
};

namespace
{
enum Step
{
  BackgroundFill,
  OccludedFill,
  Smoothing,
  Antialiasing,
  NumberOfSteps
};

/// Distance of the far plane from the eye along the view direction.
double GetFarPlane(const vtkPointSurfaceView& view)
{
  const auto& m = view.VCDC;
  return (m[14] - m[15]) / (m[10] - m[11]);
}
}

class vtkImageSpacePointMapper::vtkInternals
{
public:
  vtkSurfaceTarget Projected;
  vtkSurfaceTarget Targets[2]; // to and fro
  vtkDiscFillOpenGL Discs;
  vtkSurfaceStepOpenGL Copy{ vtkSurfaceCopyFS };
  vtkMaskFillOpenGL Fill;
  vtkSurfaceSmoothingOpenGL SmoothingStep;
  vtkOutlineCoverageOpenGL Coverage;
  vtkSurfaceImage ProjectedCPU;
  vtkMaskFillCPU FillCPU;
  vtkSurfacePixels Pixels;
  vtkPointSurfaceView View; // that the projected buffer was made for

  vtkOpenGLRenderTimer Timers[NumberOfSteps];
  double ClockMilliseconds[NumberOfSteps] = { 0.0, 0.0, 0.0, 0.0 }; // of steps without OpenGL

  /// Runs a step by the processor, with the clock.
  template <typename Function>
  void Time(Step step, Function run)
  {
    const double start = vtkTimerLog::GetUniversalTime();
    run();
    this->ClockMilliseconds[step] = 1e3 * (vtkTimerLog::GetUniversalTime() - start);
  }

  double GetMilliseconds(Step step, vtkOpenGLRenderWindow* window)
  {
    vtkOpenGLRenderTimer& timer = this->Timers[step];
    if (!window || !timer.Stopped())
    {
      return this->ClockMilliseconds[step];
    }
    window->MakeCurrent();
    glFinish();
    while (!timer.Ready())
    {
      std::this_thread::yield();
    }
    return timer.GetElapsedNanoseconds() * 1e-6;
  }
};

vtkStandardNewMacro(vtkImageSpacePointMapper);

vtkImageSpacePointMapper::vtkImageSpacePointMapper()
  : Internals(new vtkInternals)
{
}

vtkImageSpacePointMapper::~vtkImageSpacePointMapper()
{
  this->vtkImageSpacePointMapper::ReleaseGraphicsResources(nullptr); // see ~vtkPointSurfaceMapper
}

void vtkImageSpacePointMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  vtkInternals& internals = *this->Internals;
  for (auto* target : { &internals.Projected, &internals.Targets[0], &internals.Targets[1] })
  {
    target->ReleaseGraphicsResources(window);
  }
  internals.Discs.ReleaseGraphicsResources();
  internals.Copy.ReleaseGraphicsResources();
  internals.Fill.ReleaseGraphicsResources();
  internals.SmoothingStep.ReleaseGraphicsResources();
  internals.Coverage.ReleaseGraphicsResources();
  for (auto& timer : internals.Timers)
  {
    timer.ReleaseGraphicsResources();
  }
}

void vtkImageSpacePointMapper::SetToPublished()
{
  this->FillWithinDiscsOff();
  this->KeepOutlinesOff();
  this->FarPlaneLayerDistanceOn();
  this->SmoothAcrossLayersOn();
  this->SmoothLitColorsOn();
  this->SetSmoothingIterations(1);
  this->SetSmoothingKernel(AlleviatedGaussian);
}

//------------------------------------------------------------------------------
vtkImageSpacePointMapper::Plan vtkImageSpacePointMapper::MakePlan(
  const vtkPointSurfaceView& view) const
{
  Plan plan;
  const auto& r = view.Rectangle;
  plan.Rectangle = { r[0], r[1], r[0] + r[2], r[1] + r[3] };

  // Points that are spread at random leave holes three spacings wide, which is one and a half
  // radii; where they start thin, filling takes twice as many iterations. Discs leave less.
  const double radius = view.TypicalRadius * view.LargestRadius / view.MeanRadius;
  const double widest = this->FillWithinDiscs ? 2.0 * radius + 1.0 : 3.0 * radius;
  const int needed = static_cast<int>(std::ceil(std::min(std::max(widest, 1.0), 1000.0)));
  const double distance = this->FarPlaneLayerDistance ? 1e-4 * GetFarPlane(view)
    : this->LayerDistance > 0.0                       ? this->LayerDistance
                                                      : 4.0 * view.MeanRadius;
  if (this->FillWithinDiscs)
  {
    plan.Projection.SubpixelCenters = true;
    plan.Discs = vtkDiscFillOptions(view, radius, distance);
  }
  plan.Background.MaximumIterations =
    this->MaximumBackgroundFills < 0 ? needed : this->MaximumBackgroundFills;
  plan.Occluded.Occluded = true;
  plan.Occluded.DepthStep.Constant = static_cast<float>(distance);
  plan.Occluded.MaximumIterations =
    this->MaximumOccludedFills < 0 ? needed : this->MaximumOccludedFills;

  for (vtkMaskFillOptions* fill : { &plan.Background, &plan.Occluded })
  {
    fill->Reach = this->KeepOutlines ? (fill->MaximumIterations + 1) / 2 : 0;
  }

  plan.SmoothingIterations = this->SmoothLitColors ? 0 : this->SmoothingIterations;
  plan.Smoothing = vtkSurfaceSmoothingOptions::FromKernel(this->SmoothingKernel);
  plan.Smoothing.TwoSided = view.Cull == vtkPointSurfaceView::NoCulling;
  if (!this->SmoothAcrossLayers)
  {
    plan.Smoothing.DepthStep.Constant = static_cast<float>(distance);
  }
  plan.Antialias = this->AntialiasOutline && view.Supersampling == 1;
  return plan;
}

bool vtkImageSpacePointMapper::MakesCoverage() const
{
  return this->AntialiasOutline;
}

void vtkImageSpacePointMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  this->LastFrameBackgroundFills = 0;
  this->LastFrameOccludedFills = 0;
  for (auto& timer : this->Internals->Timers)
  {
    timer.Reset();
  }
  std::fill_n(this->Internals->ClockMilliseconds, static_cast<int>(NumberOfSteps), 0.0);
  this->Superclass::RenderPieceDraw(renderer, actor);
}

//------------------------------------------------------------------------------
void vtkImageSpacePointMapper::MakeSurfaceBuffer(
  vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view, vtkSurfaceTarget& surface)
{
  vtkInternals& internals = *this->Internals;
  const Plan plan = this->MakePlan(view);
  this->ProjectPoints(window, view, plan.Projection, surface, internals.Projected);
  internals.View = view;
  for (vtkSurfaceTarget& target : internals.Targets)
  {
    target.Allocate(window, view.Size[0], view.Size[1], surface.GetLayers());
  }
  vtkSurfaceTarget* current = &internals.Targets[0];
  vtkSurfaceTarget* spare = &internals.Targets[1];
  // with nothing to come after it, the last step writes the result
  int last = plan.SmoothingIterations + (plan.Antialias ? 1 : 0);
  auto next = [&]() -> vtkSurfaceTarget& { return --last == 0 ? surface : *spare; };
  auto take = [&](vtkSurfaceTarget& result)
  {
    ++this->LastFramePasses;
    if (&result == spare)
    {
      std::swap(current, spare);
    }
  };

  internals.Timers[BackgroundFill].Start();
  internals.Discs.Run(window, plan.Discs, plan.Rectangle, internals.Projected, *current);
  ++this->LastFramePasses;
  this->LastFrameBackgroundFills += internals.Fill.Run(
    window, plan.Background, plan.Rectangle, current, spare, this->LastFramePasses);
  internals.Timers[BackgroundFill].Stop();

  internals.Timers[OccludedFill].Start();
  this->LastFrameOccludedFills += internals.Fill.Run(
    window, plan.Occluded, plan.Rectangle, current, spare, this->LastFramePasses);
  internals.Timers[OccludedFill].Stop();

  if (last == 0)
  {
    internals.Copy.Run(window, *current, surface, plan.Rectangle, [](vtkShaderProgram*) {});
    ++this->LastFramePasses;
    return;
  }
  internals.Timers[Smoothing].Start();
  for (int i = 0; i < plan.SmoothingIterations; ++i)
  {
    vtkSurfaceTarget& result = next();
    internals.SmoothingStep.Run(window, plan.Smoothing, plan.Rectangle, *current, result);
    take(result);
  }
  internals.Timers[Smoothing].Stop();
  if (plan.Antialias)
  {
    internals.Timers[Antialiasing].Start();
    internals.Coverage.Run(window, plan.Rectangle, *current, surface);
    ++this->LastFramePasses;
    internals.Timers[Antialiasing].Stop();
  }
}

void vtkImageSpacePointMapper::MakeSurfacePixels(
  const vtkPointSurfaceView& view, bool ids, bool colors, vtkSurfacePixels& surface)
{
  vtkInternals& internals = *this->Internals;
  const Plan plan = this->MakePlan(view);
  this->ProjectPoints(view, plan.Projection, ids, colors, internals.ProjectedCPU);
  internals.View = view;
  internals.Time(BackgroundFill,
    [&]
    {
      vtkDiscFillCPU::Run(plan.Discs, internals.ProjectedCPU, surface);
      this->LastFrameBackgroundFills += internals.FillCPU.Run(plan.Background, surface);
    });
  internals.Time(OccludedFill,
    [&] { this->LastFrameOccludedFills += internals.FillCPU.Run(plan.Occluded, surface); });
  internals.Time(Smoothing,
    [&]
    {
      for (int i = 0; i < plan.SmoothingIterations; ++i)
      {
        vtkSurfaceSmoothingCPU::Run(plan.Smoothing, surface, internals.Pixels);
        std::swap(surface, internals.Pixels);
      }
    });
  if (plan.Antialias)
  {
    internals.Time(Antialiasing, [&] { vtkOutlineCoverageCPU::Run(view.Size, surface); });
  }
  this->LastFramePasses = this->LastFrameBackgroundFills + this->LastFrameOccludedFills +
    plan.SmoothingIterations + (plan.Antialias ? 1 : 0);
}

//------------------------------------------------------------------------------
void vtkImageSpacePointMapper::ReplaceShaderValues(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::ReplaceShaderValues(shaders, renderer, actor);
  if (!this->SmoothLitColors || this->SmoothingIterations == 0)
  {
    return;
  }
  // VTK's shading becomes a function of a pixel, which a new main() calls for each of 3x3
  vtkShader* fragment = shaders[vtkShader::Fragment];
  std::string text = fragment->GetSource();
  vtkSurfaceBufferShading::CallFromMain(text, vtkLitSmoothingImpl);
  fragment->SetSource(text);
}

void vtkImageSpacePointMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(helper, renderer, actor);
  if (helper.Program->IsUniformUsed("psWeights"))
  {
    const vtkPointSurfaceView& view = this->GetShadedView();
    const Plan plan = this->MakePlan(view);
    const float weights[3] = { plan.Smoothing.Center, plan.Smoothing.Side, plan.Smoothing.Corner };
    helper.Program->SetUniform3f("psWeights", weights);
    helper.Program->SetUniformf("psDepthStep", plan.Smoothing.DepthStep.Constant);
  }
}

//------------------------------------------------------------------------------
double vtkImageSpacePointMapper::GetLastFrameBackgroundFillMilliseconds()
{
  return this->Internals->GetMilliseconds(BackgroundFill, this->GetLastWindow());
}

double vtkImageSpacePointMapper::GetLastFrameOccludedFillMilliseconds()
{
  return this->Internals->GetMilliseconds(OccludedFill, this->GetLastWindow());
}

double vtkImageSpacePointMapper::GetLastFrameSmoothingMilliseconds()
{
  return this->Internals->GetMilliseconds(Smoothing, this->GetLastWindow());
}

double vtkImageSpacePointMapper::GetLastFrameAntialiasingMilliseconds()
{
  return this->Internals->GetMilliseconds(Antialiasing, this->GetLastWindow());
}

//------------------------------------------------------------------------------
bool vtkImageSpacePointMapper::ReadProjectedBuffer(vtkImageData* buffer)
{
  vtkInternals& internals = *this->Internals;
  const vtkPointSurfaceView& view = internals.View;
  if (!this->ReadProjection(view, internals.Projected, internals.ProjectedCPU, buffer))
  {
    return false;
  }
  const Plan plan = this->MakePlan(view);
  vtkNew<vtkDoubleArray> distance;
  distance->SetName("LayerDistance");
  distance->InsertNextValue(plan.Occluded.DepthStep.Constant);
  buffer->GetFieldData()->AddArray(distance);
  vtkNew<vtkIntArray> fills;
  fills->SetName("MaximumFills");
  fills->InsertNextValue(plan.Background.MaximumIterations);
  fills->InsertNextValue(plan.Occluded.MaximumIterations);
  buffer->GetFieldData()->AddArray(fills);
  vtkNew<vtkIntArray> reach;
  reach->SetName("Reach");
  reach->InsertNextValue(plan.Background.Reach);
  reach->InsertNextValue(plan.Occluded.Reach);
  buffer->GetFieldData()->AddArray(reach);
  vtkNew<vtkIntArray> discReach;
  discReach->SetName("DiscReach");
  discReach->InsertNextValue(plan.Discs.Reach);
  buffer->GetFieldData()->AddArray(discReach);
  return true;
}

void vtkImageSpacePointMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumBackgroundFills: " << this->MaximumBackgroundFills << "\n";
  os << indent << "MaximumOccludedFills: " << this->MaximumOccludedFills << "\n";
  os << indent << "FillWithinDiscs: " << this->FillWithinDiscs << "\n";
  os << indent << "KeepOutlines: " << this->KeepOutlines << "\n";
  os << indent << "LayerDistance: " << this->LayerDistance << "\n";
  os << indent << "FarPlaneLayerDistance: " << this->FarPlaneLayerDistance << "\n";
  os << indent << "SmoothingIterations: " << this->SmoothingIterations << "\n";
  os << indent << "SmoothingKernel: " << this->SmoothingKernel << "\n";
  os << indent << "SmoothAcrossLayers: " << this->SmoothAcrossLayers << "\n";
  os << indent << "SmoothLitColors: " << this->SmoothLitColors << "\n";
  os << indent << "AntialiasOutline: " << this->AntialiasOutline << "\n";
  os << indent << "LastFrameBackgroundFills: " << this->LastFrameBackgroundFills << "\n";
  os << indent << "LastFrameOccludedFills: " << this->LastFrameOccludedFills << "\n";
}
