// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAlgebraicSplatMapper.h"

#include "vtkAlgebraicSplatOptions.h"
#include "vtkAlgebraicSplatTracingCPU.h"
#include "vtkAlgebraicSplatTracingOpenGL.h"
#include "vtkContextNeeds.h"
#include "vtkDrawablePoints.h"
#include "vtkDrawableSplats.h"
#include "vtkJointSurface.h"
#include "vtkPointBlocks.h"
#include "vtkPointSurfaceView.h"
#include "vtkSurfacePixels.h"
#include "vtkSurfaceTarget.h"

#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTimeStamp.h"

#include <array>
#include <vector>

class vtkAlgebraicSplatMapper::vtkInternals
{
public:
  vtkDrawableSplats Splats;
  std::vector<vtkMTimeType> SplatsSource; // times of what they were built from
  double SplatsDiagonal = 0.0;            // of the cloud that they were judged by
  vtkTimeStamp SplatsTime;
  vtkAlgebraicSplatTracingOpenGL Tracing;
  vtkMTimeType UploadedTime = 0;       // of the splats that were uploaded
  vtkMTimeType UploadedColorsTime = 0; // and of their colours
};

vtkStandardNewMacro(vtkAlgebraicSplatMapper);

vtkAlgebraicSplatMapper::vtkAlgebraicSplatMapper()
  : Internals(new vtkInternals)
{
}

vtkAlgebraicSplatMapper::~vtkAlgebraicSplatMapper()
{
  this->vtkAlgebraicSplatMapper::ReleaseGraphicsResources(nullptr); // see ~vtkPointSurfaceMapper
}

void vtkAlgebraicSplatMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Internals->Tracing.ReleaseGraphicsResources(window);
  this->Internals->UploadedTime = 0;
  this->Internals->UploadedColorsTime = 0;
}

void vtkAlgebraicSplatMapper::SetToPublished()
{
  this->SetDepthShift(0.005);
  this->SetWeightFalloff(1.0);
  this->SeparateSidesOff();
}

vtkAlgebraicSplatOptions vtkAlgebraicSplatMapper::GetOptions() const
{
  vtkAlgebraicSplatOptions options;
  options.DepthShift = this->DepthShift;
  options.WeightFalloff = this->WeightFalloff;
  options.SeparateSides = this->SeparateSides;
  return options;
}

//------------------------------------------------------------------------------
void vtkAlgebraicSplatMapper::AddArrayNames(std::vector<std::string>& names)
{
  this->Superclass::AddArrayNames(names);
  names.insert(names.end(), { "SplatCoefficients", "SplatOrder", "SplatAxes", "radius" });
}

void vtkAlgebraicSplatMapper::ComputeBounds()
{
  this->Superclass::ComputeBounds();
  // a patch reaches a little beyond its disc; what it reaches exactly is known when it is drawn
  vtkPolyData* input = this->GetBlocks().GetCloud();
  vtkDataArray* radii = input ? input->GetPointData()->GetArray("radius") : nullptr;
  if (!radii || !vtkMath::AreBoundsInitialized(this->Bounds))
  {
    return;
  }
  double range[2];
  radii->GetFiniteRange(range);
  for (int k = 0; k < 3 && range[1] > 0.0; ++k)
  {
    this->Bounds[2 * k] -= range[1];
    this->Bounds[2 * k + 1] += range[1];
  }
}

void vtkAlgebraicSplatMapper::GetReach(double& mean, double& largest) const
{
  mean = this->Internals->Splats.GetMeanRadius();
  largest = this->Internals->Splats.GetReach();
}

namespace
{
/// When what splats are made of last changed; times are unique.
std::vector<vtkMTimeType> GetTimes(const vtkDrawablePoints& points, vtkDataArray* normals)
{
  vtkPolyData* cloud = points.GetCloud();
  std::vector<vtkMTimeType> times = { cloud->GetPoints()->GetData()->GetMTime(),
    points.GetDrawnIdsTime(), static_cast<vtkMTimeType>(points.GetNumberOfDrawnPoints()),
    normals ? normals->GetMTime() : 0 };
  for (const char* name : { "SplatCoefficients", "SplatOrder", "SplatAxes", "radius" })
  {
    vtkDataArray* array = cloud->GetPointData()->GetArray(name);
    times.push_back(array ? array->GetMTime() : 0);
  }
  return times;
}
}

void vtkAlgebraicSplatMapper::BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::BuildBufferObjects(renderer, actor);
  vtkInternals& internals = *this->Internals;
  const vtkDrawablePoints& points = this->GetDrawablePoints();
  // a splat's normal is an axis of its frame: no estimate can stand in for it
  vtkDataArray* normals = this->GetBlocks().GetCloud()->GetPointData()->GetNormals();
  const std::vector<vtkMTimeType> source = GetTimes(points, normals);
  if (internals.SplatsSource == source && internals.SplatsDiagonal == points.GetDiagonal())
  {
    return;
  }
  internals.SplatsSource = source;
  internals.SplatsDiagonal = points.GetDiagonal();
  internals.SplatsTime.Modified();
  if (points.GetNumberOfDrawnPoints() == 0)
  {
    return; // the base class has said why
  }
  for (const std::string& remark : internals.Splats.Build(points.GetCloud(), normals,
         points.GetDrawnIds(), points.GetBounds(), points.GetDiagonal()))
  {
    if (internals.Splats.GetNumberOfSplats() == 0)
    {
      vtkErrorMacro(<< remark);
    }
    else
    {
      vtkWarningMacro(<< remark);
    }
  }
}

//------------------------------------------------------------------------------
std::string vtkAlgebraicSplatMapper::FindLackOfOpenGL()
{
  const std::string lack = this->Superclass::FindLackOfOpenGL();
  return lack.empty() ? vtkContextNeeds::FindLackOfTextureBuffers(
                          vtkAlgebraicSplatTracingOpenGL::GetLargestNumberOfTexels(
                            this->GetBlocks().GetCloud()->GetNumberOfPoints()))
                      : lack;
}

void vtkAlgebraicSplatMapper::UploadSplats(vtkOpenGLRenderWindow* window, bool colors)
{
  vtkInternals& internals = *this->Internals;
  size_t bytes = 0;
  if (internals.UploadedTime != internals.SplatsTime.GetMTime())
  {
    bytes += internals.Tracing.Upload(window, internals.Splats);
    internals.UploadedTime = internals.SplatsTime.GetMTime();
    internals.UploadedColorsTime = 0; // the colours uploaded before are those of the splats before
  }
  if (colors && internals.UploadedColorsTime != this->GetPointColorsTime())
  {
    bytes += internals.Tracing.UploadColors(
      window, internals.Splats, [this](unsigned int id) { return this->GetPointColor(id); },
      this->VBOs->GetNumberOfComponents("scalarColor") > 0);
    internals.UploadedColorsTime = this->GetPointColorsTime();
  }
  this->LastFrameBytesUploaded += static_cast<vtkIdType>(bytes);
}

void vtkAlgebraicSplatMapper::MakeSurfaceBuffer(
  vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view, vtkSurfaceTarget& surface)
{
  std::vector<vtkAlgebraicSplatTracingOpenGL::Cloud> clouds;
  for (const vtkJointSurface::Member& member : this->GetMembers())
  {
    auto* mapper = static_cast<vtkAlgebraicSplatMapper*>(member.Mapper);
    vtkAlgebraicSplatTracingOpenGL::Cloud cloud;
    cloud.Uploaded = &mapper->Internals->Tracing;
    cloud.Splats = &mapper->Internals->Splats;
    cloud.View = member.GetView(view);
    cloud.FirstId = member.FirstId;
    cloud.HasColors = member.HasColors;
    cloud.Color = member.Color;
    mapper->UploadSplats(window, surface.Has(vtkSurfaceTarget::Color) && cloud.HasColors);
    mapper->LastFramePointsDrawn += cloud.View.GetNumberOfPoints();
    clouds.push_back(cloud);
  }
  vtkAlgebraicSplatTracingOpenGL& tracing = this->Internals->Tracing;
  tracing.Run(window, clouds, view, this->GetOptions(), surface);
  this->LastFramePasses = tracing.GetPasses();
}

void vtkAlgebraicSplatMapper::MakeSurfacePixels(
  const vtkPointSurfaceView& view, bool ids, bool colors, vtkSurfacePixels& surface)
{
  std::vector<vtkAlgebraicSplatTracingCPU::Cloud> clouds;
  for (const vtkJointSurface::Member& member : this->GetMembers())
  {
    auto* mapper = static_cast<vtkAlgebraicSplatMapper*>(member.Mapper);
    vtkAlgebraicSplatTracingCPU::Cloud cloud;
    cloud.Splats = &mapper->Internals->Splats;
    cloud.View = member.GetView(view);
    cloud.FirstId = member.FirstId;
    if (member.HasColors)
    {
      cloud.Color = [mapper](unsigned int id) { return mapper->GetPointColor(id); };
    }
    else
    {
      cloud.Color = [color = member.Color](unsigned int) { return color; };
    }
    mapper->LastFramePointsDrawn += cloud.View.GetNumberOfPoints();
    clouds.push_back(cloud);
  }
  vtkAlgebraicSplatTracingCPU::Run(clouds, view, this->GetOptions(), ids, colors, surface);
  this->LastFramePasses = 1;
}

void vtkAlgebraicSplatMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DepthShift: " << this->DepthShift << "\n";
  os << indent << "WeightFalloff: " << this->WeightFalloff << "\n";
  os << indent << "SeparateSides: " << this->SeparateSides << "\n";
}
