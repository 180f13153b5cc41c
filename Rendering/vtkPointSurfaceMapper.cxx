// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSurfaceMapper.h"

#include "vtkBoundingBox.h"
#include "vtkContextNeeds.h"
#include "vtkDrawablePoints.h"
#include "vtkDrawnClouds.h"
#include "vtkDuplicatePoints.h"
#include "vtkEyeFrame.h"
#include "vtkJointSurface.h"
#include "vtkKeptArray.h"
#include "vtkOutlineCoverageCPU.h"
#include "vtkOutlineCoverageOpenGL.h"
#include "vtkPointBlocks.h"
#include "vtkPointProjectionCPU.h"
#include "vtkPointProjectionOpenGL.h"
#include "vtkPointProjectionOptions.h"
#include "vtkPointSurfaceCompat.h"
#include "vtkPointSurfaceView.h"
#include "vtkPointTexture.h"
#include "vtkPointThinning.h"
#include "vtkResolveCPU.h"
#include "vtkResolveOpenGL.h"
#include "vtkSurfaceBuffer.h"
#include "vtkSurfaceBufferShading.h"
#include "vtkSurfaceImage.h"
#include "vtkSurfacePixels.h"
#include "vtkSurfaceTarget.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLActor.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkOpenGLRenderTimer.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLTexture.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkSurfaceBufferVS.h"
#include "vtkTexture.h"
#include "vtkTextureObject.h"
#include "vtkTimeStamp.h"
#include "vtkTimerLog.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <thread>
#include <vector>

namespace
{
/// Light, eyes and tiles of one frame each have a view; this many are kept at a time.
constexpr size_t MaximumNumberOfSurfaces = 4;

/// Those of a 4k screen at two samples along a side; each takes about 100 bytes.
constexpr int MaximumNumberOfSamples = 1 << 25;

enum Stage
{
  Project,
  Reconstruct,
  Shade,
  NumberOfStages
};
}

class vtkPointSurfaceMapper::vtkInternals
{
public:
  using SurfaceBuffer = vtkSurfaceBuffer;

  vtkDrawablePoints Points;
  vtkMTimeType PointsInputTime = 0;   // of the input that Points was built from
  vtkPolyData* PointsInput = nullptr; // only compared, never followed
  vtkDrawablePoints::RadiusSource PointsRadiusSource;
  vtkTimeStamp PointsTime;

  vtkPointProjectionOpenGL Projection;
  vtkPointProjectionCPU ProjectionCPU;
  vtkSurfacePixels Pixels;       // of the CPU back end's last frame
  vtkSurfacePixels LesserPixels; // see vtkSurfaceBuffer
  vtkSurfacePixels SamplePixels; // and what they were resolved from, as Samples on OpenGL's
  vtkSurfaceTarget Samples;
  vtkResolveOpenGL Resolve;
  vtkOutlineCoverageOpenGL Coverage; // in place of Resolve, where outlines are smoothed
  std::vector<std::unique_ptr<SurfaceBuffer>> Surfaces;
  SurfaceBuffer* Current = nullptr;
  vtkJointSurface* Joint = nullptr;           // that this cloud is a part of, while a pass renders
  std::shared_ptr<SurfaceBuffer> JointBuffer; // of the last frame's joint surface
  std::vector<vtkJointSurface::Member> Projected; // the clouds that the surface is made of
  int PointRange[2] = { 0, VTK_INT_MAX };         // ids that are shaded of the current buffer
  unsigned long UseCount = 0;
  vtkDuplicatePoints Duplicates;
  std::vector<vtkSurfaceTarget::Layer> ShadedLayers; // that the shading program was made for
  bool ShadedDuplicates = false;
  vtkTimeStamp ShadedLayersTime;
  int WarnedViewport[2] = { 0, 0 }; // for which a lower supersampling has been told
  int ViewportOrigin[2] = { 0, 0 };
  vtkNew<vtkMatrix4x4> ViewToEye;          // of the view that is drawn; see vtkEyeFrame
  vtkOpenGLRenderWindow* Window = nullptr; // of the last frame; cleared when it releases us
  vtkTimeStamp FrameTime;                  // the start of the last one
  vtkMTimeType ContextTime = 0;            // of the context that the next two are of
  std::string LackOfTextures;              // without which nothing can be drawn
  std::string LackOfTargets;               // which the OpenGL back end needs
  std::string ToldLack;                    // that has been warned of
  std::string ToldLackOfDuplicates;
  vtkMTimeType ColorTableTime = 0; // of the colour table that was uploaded
  std::map<std::string, vtkKeptArray> StandIns;
  bool TextureAtPoints = false; // the actor's texture is multiplied onto colours of points
  vtkKeptArray TexturedColors;
  vtkOpenGLRenderTimer Timers[NumberOfStages];
  double ClockMilliseconds[NumberOfStages] = { 0.0, 0.0, 0.0 }; // of stages without OpenGL

  bool IsUpToDate(vtkPolyData* input, const vtkDrawablePoints::RadiusSource& source) const
  {
    return this->PointsInput == input && this->PointsInputTime == input->GetMTime() &&
      this->PointsRadiusSource == source;
  }

  SurfaceBuffer* Find(const vtkPointSurfaceView& view)
  {
    for (auto& surface : this->Surfaces)
    {
      if (surface->Valid && surface->View == view)
      {
        return surface.get();
      }
    }
    return nullptr;
  }

  SurfaceBuffer* GetLeastRecentlyUsed()
  {
    if (this->Surfaces.size() < MaximumNumberOfSurfaces)
    {
      this->Surfaces.emplace_back(new SurfaceBuffer);
      return this->Surfaces.back().get();
    }
    return std::min_element(this->Surfaces.begin(), this->Surfaces.end(),
      [](const std::unique_ptr<SurfaceBuffer>& a, const std::unique_ptr<SurfaceBuffer>& b)
      { return a->LastUse < b->LastUse; })
      ->get();
  }

  double GetMilliseconds(Stage stage)
  {
    vtkOpenGLRenderTimer& timer = this->Timers[stage];
    if (!this->Window || !timer.Stopped())
    {
      return this->ClockMilliseconds[stage];
    }
    this->Window->MakeCurrent();
    glFinish();
    while (!timer.Ready())
    {
      std::this_thread::yield();
    }
    return timer.GetElapsedNanoseconds() * 1e-6;
  }
};

//------------------------------------------------------------------------------
vtkPointSurfaceMapper::vtkPointSurfaceMapper()
  : Internals(new vtkInternals)
{
}

vtkPointSurfaceMapper::~vtkPointSurfaceMapper()
{
  // VTK's base class releases too, in the right context, but when our resources are gone
  this->vtkPointSurfaceMapper::ReleaseGraphicsResources(nullptr);
  this->SetRadiusArray(nullptr);
}

void vtkPointSurfaceMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  // VTK makes the right context current, and calls this method again from within; see
  // vtkOpenGLResourceFreeCallback.
  this->Superclass::ReleaseGraphicsResources(window);
  for (auto& surface : this->Internals->Surfaces)
  {
    surface->Target.ReleaseGraphicsResources(window);
    surface->Lesser.ReleaseGraphicsResources(window);
    surface->Splats.ReleaseGraphicsResources(window);
  }
  this->Internals->Surfaces.clear();
  this->Internals->Current = nullptr;
  this->Internals->JointBuffer.reset();
  this->Internals->Projection.ReleaseGraphicsResources(window);
  this->Internals->Samples.ReleaseGraphicsResources(window);
  this->Internals->Resolve.ReleaseGraphicsResources();
  this->Internals->Coverage.ReleaseGraphicsResources();
  this->Internals->Duplicates.ReleaseGraphicsResources(window);
  for (auto& timer : this->Internals->Timers)
  {
    timer.ReleaseGraphicsResources();
  }
  this->Internals->Window = nullptr;
}

//------------------------------------------------------------------------------
void vtkPointSurfaceMapper::AddArrayNames(std::vector<std::string>& names)
{
  if (this->NeedsRadii())
  {
    names.emplace_back("radius");
    names.emplace_back(this->RadiusArray ? this->RadiusArray : "radius");
  }
}

namespace
{
/// Clears OpenGL's errors; returns their names. VTK's macros do so in debug builds alone.
std::string TakeOpenGLErrors()
{
  std::string errors;
  for (int i = 0; i < 16; ++i) // a lost context never runs out of them
  {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR)
    {
      break;
    }
    errors += std::string(errors.empty() ? "" : ", ") + vtkOpenGLStrError(error);
  }
  return errors;
}
}

void vtkPointSurfaceMapper::UpdateCameraShiftScale(vtkRenderer* renderer, vtkActor* actor)
{
  // The first virtual function after the window is registered. When a mapper moves from one window
  // to another it releases in the old one's context, and windows without PopContext leave that
  // context current.
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  window->MakeCurrent();
  if (this->BeginsFrame())
  {
    TakeOpenGLErrors(); // of others
    this->Internals->FrameTime.Modified();
    this->LastFrameBytesUploaded = 0;
    this->LastFrameSurfaceBytesUploaded = 0;
  }
  this->ExamineContext(window);
  this->ChooseBackend();
  this->UpdateDrawablePoints();
  this->CurrentInput = this->Internals->Points.GetCloud();
  this->Superclass::UpdateCameraShiftScale(renderer, actor);
}

bool vtkPointSurfaceMapper::IsSoftwareRasterizer()
{
  const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string name = text ? text : "";
  for (const char* software :
    { "llvmpipe", "softpipe", "swrast", "SWR", "Software", "Microsoft Basic Render" })
  {
    if (name.find(software) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

namespace
{
/// Lets nothing be queued together with a query of the time. Software works through its queue tile
/// by tile, takes the time in each tile anew, and tells that of the last one.
void FlushQuery()
{
  if (vtkPointSurfaceMapper::IsSoftwareRasterizer())
  {
    glFlush();
  }
}
}

void vtkPointSurfaceMapper::ExamineContext(vtkOpenGLRenderWindow* window)
{
  vtkInternals& internals = *this->Internals;
  if (internals.ContextTime == window->GetContextCreationTime())
  {
    return; // times are unique
  }
  internals.ContextTime = window->GetContextCreationTime();
  internals.LackOfTextures = vtkContextNeeds::FindLackOfTextures();
  internals.LackOfTargets = vtkContextNeeds::FindLackOfTargets();
  if (!internals.LackOfTextures.empty() && internals.LackOfTextures != internals.ToldLack)
  {
    internals.ToldLack = internals.LackOfTextures;
    vtkErrorMacro("This OpenGL context "
      << internals.LackOfTextures << ", in which a surface waits to be shaded; the cloud is not "
      << "drawn. Update the graphics driver, or let Mesa's software renderer draw (the environment "
         "variable LIBGL_ALWAYS_SOFTWARE=1).");
  }
}

std::string vtkPointSurfaceMapper::FindLackOfOpenGL()
{
  return this->Internals->LackOfTargets;
}

void vtkPointSurfaceMapper::ChooseBackend()
{
  vtkInternals& internals = *this->Internals;
  bool wanted = this->Backend == Automatic ? IsSoftwareRasterizer() : this->Backend == CPU;
  const std::string lack =
    wanted || !internals.LackOfTextures.empty() ? "" : this->FindLackOfOpenGL();
  if (!lack.empty() && lack != internals.ToldLack)
  {
    internals.ToldLack = lack;
    vtkWarningMacro("This OpenGL context "
      << lack << ", which the OpenGL back end needs; the CPU back end takes its place. Update the "
      << "graphics driver, or choose that back end yourself (SetBackendToCPU).");
  }
  wanted = wanted || !lack.empty();
  const int chosen = wanted && this->HasCPUForm() ? CPU : OpenGL;
  if (chosen != this->LastFrameBackend)
  {
    this->LastFrameBackend = chosen;
    this->Modified(); // what is uploaded depends on it
  }
}

namespace
{
/// What vtkGhostPointsGenerator tells of the cloud as a whole, of which this is a part: bounds,
/// mean and largest radius, sampling distance; nullptr where the cloud is whole.
vtkDoubleArray* GetWhole(const vtkPointBlocks& blocks)
{
  if (blocks.GetBlocks().empty())
  {
    return nullptr;
  }
  auto* whole = vtkDoubleArray::SafeDownCast(
    blocks.GetBlocks()[0].Data->GetFieldData()->GetArray("vtkWholeCloud"));
  return whole && whole->GetNumberOfValues() == 9 ? whole : nullptr;
}
}

void vtkPointSurfaceMapper::UpdateDrawablePoints()
{
  vtkPolyData* input = this->GetBlocks().GetCloud();
  vtkDrawablePoints::RadiusSource source;
  source.Array = this->RadiusArray ? this->RadiusArray : "";
  source.Radius = this->Radius;
  source.SamplingQuantile = this->GetNeededSamplingQuantile();
  vtkDoubleArray* whole = GetWhole(this->GetBlocks());
  if (whole)
  {
    source.SamplingDistance = whole->GetValue(8);
    const vtkBoundingBox box(whole->GetPointer(0));
    source.Diagonal = box.IsValid() ? box.GetDiagonalLength() : 0.0;
  }
  if (this->Internals->IsUpToDate(input, source))
  {
    return;
  }
  this->ForgetWarnings();
  for (const std::string& remark : this->GetBlocks().GetRemarks())
  {
    vtkWarningMacro(<< remark);
  }
  vtkDrawablePoints::Needs needs;
  needs.Normals = this->NeedsNormals() && this->UsesProjection();
  needs.Radii = this->NeedsRadii();
  needs.SamplingDistance = source.SamplingQuantile >= 0.0;
  needs.SpatialOrder = this->UsesProjection();
  std::vector<vtkIdType> blocks;
  for (const vtkPointBlock& block : this->GetBlocks().GetBlocks())
  {
    blocks.push_back(block.First);
  }
  for (const std::string& remark :
    this->Internals->Points.Build(input, blocks, needs, source, this))
  {
    vtkWarningMacro(<< remark);
  }
  // what an abort left out is made in the next frame
  this->Internals->PointsInput = this->Internals->Points.WasAborted() ? nullptr : input;
  this->Internals->PointsInputTime = input->GetMTime();
  this->Internals->PointsRadiusSource = source;
  this->Internals->PointsTime.Modified();
}

void vtkPointSurfaceMapper::ComputeBounds()
{
  this->Superclass::ComputeBounds();
  const auto& blocks = this->GetBlocks().GetBlocks();
  const bool hidden = !blocks.empty() &&
    std::none_of(blocks.begin(), blocks.end(), [](const auto& block) { return block.Visible; });
  if (this->GetInputDataObject(0, 0) && !vtkMath::AreBoundsInitialized(this->Bounds) && !hidden)
  {
    this->UpdateDrawablePoints(); // VTK will not render this; say why
  }
  vtkDoubleArray* whole = GetWhole(this->GetBlocks());
  if (whole && vtkMath::AreBoundsInitialized(this->Bounds))
  {
    // Ranks' pictures are put together of what bounds cover (IceT); footprints reach beyond those
    // of points, fills up to three radii.
    const double reach = std::max(this->RadiusScale * whole->GetValue(7), whole->GetValue(8));
    vtkBoundingBox box(this->Bounds);
    box.Inflate(3.0 * reach);
    box.GetBounds(this->Bounds);
  }
}

//------------------------------------------------------------------------------
int vtkPointSurfaceMapper::CanUseTextureMapForColoring(vtkDataObject* input)
{
  return this->Internals->TextureAtPoints ? 0
                                          : this->Superclass::CanUseTextureMapForColoring(input);
}

bool vtkPointSurfaceMapper::GetNeedToRebuildBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  vtkImageData* image = this->GetTextureOfPoints(actor);
  const bool changed =
    image && this->VBOBuildTime < std::max(image->GetMTime(), actor->GetTexture()->GetMTime());
  return changed || (image != nullptr) != this->Internals->TextureAtPoints ||
    this->Superclass::GetNeedToRebuildBufferObjects(renderer, actor);
}

vtkImageData* vtkPointSurfaceMapper::GetTextureOfPoints(vtkActor* actor)
{
  vtkTexture* texture = actor->GetTexture();
  vtkPolyData* cloud = this->GetBlocks().GetCloud();
  vtkDataArray* coordinates = cloud->GetPointData()->GetTCoords();
  const bool has = texture && !texture->GetCubeMap() && coordinates &&
    coordinates->GetNumberOfTuples() >= cloud->GetNumberOfPoints();
  return has ? texture->GetInput() : nullptr;
}

std::vector<std::pair<vtkTexture*, std::string>> vtkPointSurfaceMapper::GetTextures(vtkActor* actor)
{
  // without coordinates VTK's shaders would not compile
  auto textures = this->Superclass::GetTextures(actor);
  if (this->VBOs->GetNumberOfComponents("tcoord") == 0)
  {
    textures.erase(std::remove_if(textures.begin(), textures.end(),
                     [this](const std::pair<vtkTexture*, std::string>& texture)
                     { return texture.first != this->InternalColorTexture; }),
      textures.end());
  }
  return textures;
}

void vtkPointSurfaceMapper::BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  // As vtkOpenGLPolyDataMapper does it, less all that is about cells, plus radii.
  vtkDrawablePoints& points = this->Internals->Points;
  this->Internals->TextureAtPoints = this->GetTextureOfPoints(actor) != nullptr;
  vtkDataArray* colors = this->GetPointColors(actor);
  if (this->ColorTextureMap)
  {
    if (!this->InternalColorTexture)
    {
      this->InternalColorTexture = vtkOpenGLTexture::New();
      this->InternalColorTexture->RepeatOff();
    }
    this->InternalColorTexture->SetInputData(this->ColorTextureMap);
  }
  this->HaveCellScalars = false;
  this->HaveCellNormals = false;

  if (points.GetNumberOfDrawnPoints() == 0)
  {
    this->VBOBuildTime.Modified();
    return;
  }
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  vtkOpenGLVertexBufferObjectCache* cache = window->GetVBOCache();
  vtkPolyData* cloud = points.GetCloud();
  vtkSmartPointer<vtkDataArray> normals = this->GetNormals();
  colors = this->RequireTuples(colors, "colours");
  vtkDataArray* coordinates = this->RequireTuples(this->GetPointColorCoordinates(), "scalars");
  vtkDataArray* givenTCoords = this->GetBlocks().GetCloud()->GetPointData()->GetTCoords();
  // a pixel has room for one of them
  vtkDataArray* tcoords =
    colors || coordinates ? nullptr : this->RequireTuples(givenTCoords, "texture coordinates");
  if (vtkArrayDownCast<vtkUnsignedCharArray>(tcoords)) // which would be taken for colours
  {
    vtkNew<vtkFloatArray> floats;
    floats->DeepCopy(tcoords);
    tcoords = this->Internals->StandIns["texture coordinates"].Keep(floats);
  }
  if (colors && this->Internals->TextureAtPoints)
  {
    vtkSmartPointer<vtkDataArray> textured = vtkPointTexture::Multiply(
      vtkArrayDownCast<vtkUnsignedCharArray>(colors), givenTCoords, actor->GetTexture());
    colors = textured ? this->Internals->TexturedColors.Keep(textured) : colors;
  }
  if (!tcoords && !actor->GetProperty()->GetAllTextures().empty())
  {
    this->WarnOnce("The textures of the actor's property are not drawn, since the points have " +
      std::string(colors || coordinates
          ? "colours, which take the place of their texture coordinates; turn colours off "
            "(ScalarVisibilityOff) to see them."
          : "no texture coordinates; give them one for each point (vtkPointData::SetTCoords)."));
  }
  if (!this->ExtraAttributes.empty())
  {
    this->WarnOnce("The point array '" + this->ExtraAttributes.begin()->second.DataArrayName +
      "' is mapped to a vertex attribute, which has no use: pixels are shaded here, not vertices. "
      "Remove it (RemoveAllVertexAttributeMappings).");
  }
  if (this->UsesProjection())
  {
    colors = points.Arrange("colors", colors);
    coordinates = points.Arrange("color coordinates", coordinates);
    tcoords = points.Arrange("texture coordinates", tcoords);
  }
  if (this->UploadsStandIns())
  {
    this->Internals->ProjectionCPU.SetPoints(&points,
      colors          ? colors
        : coordinates ? coordinates
                      : tcoords);
    for (const char* name : { "vertexMC", "radiusMC" })
    {
      this->VBOs->RemoveAttribute(name);
    }
    this->UploadStandIn("normalMC", normals, cache);
    this->UploadStandIn("scalarColor", colors, cache);
    this->UploadStandIn("tcoord", tcoords, cache);
    if (coordinates)
    {
      this->UploadStandIn(VTK_POINT_SURFACE_COLOR_TCOORD, coordinates, cache);
    }
    this->VBOs->BuildAllVBOs(renderer);
    this->VBOBuildTime.Modified();
    return;
  }
  if (this->Backend == CPU)
  {
    this->WarnOnce("This mapper has no CPU form; it is drawn by OpenGL (SetBackendToOpenGL).");
  }

  this->VBOs->CacheDataArray("vertexMC", cloud->GetPoints()->GetData(), cache, VTK_FLOAT);
  if (vtkOpenGLVertexBufferObject* positions = this->VBOs->GetVBO("vertexMC"))
  {
    positions->SetCoordShiftAndScaleMethod(
      static_cast<vtkOpenGLVertexBufferObject::ShiftScaleMethod>(this->ShiftScaleMethod));
    positions->SetProp3D(actor);
    positions->SetCamera(renderer->GetActiveCamera());
  }
  this->VBOs->CacheDataArray("normalMC", normals, cache, VTK_FLOAT);
  this->VBOs->CacheDataArray("radiusMC", points.GetRadii(), cache, VTK_FLOAT);
  this->VBOs->CacheDataArray("scalarColor", colors, cache, VTK_UNSIGNED_CHAR);
  this->VBOs->CacheDataArray("tcoord", tcoords, cache, VTK_FLOAT);
  if (coordinates)
  {
    this->VBOs->CacheDataArray(VTK_POINT_SURFACE_COLOR_TCOORD, coordinates, cache, VTK_FLOAT);
  }
  this->VBOs->BuildAllVBOs(renderer);

  vtkThinnedPoints::Frame frame; // of coordinates as they are uploaded
  vtkOpenGLVertexBufferObject* positions = this->VBOs->GetVBO("vertexMC");
  if (positions && positions->GetCoordShiftAndScaleEnabled())
  {
    const std::vector<double>& shift = positions->GetShift();
    const std::vector<double>& scale = positions->GetScale();
    std::copy_n(shift.begin(), 3, frame.Origin.begin());
    std::copy_n(scale.begin(), 3, frame.Scale.begin());
    this->VBOInverseTransform->Identity();
    this->VBOInverseTransform->Translate(shift[0], shift[1], shift[2]);
    this->VBOInverseTransform->Scale(1.0 / scale[0], 1.0 / scale[1], 1.0 / scale[2]);
    this->VBOInverseTransform->GetTranspose(this->VBOShiftScale);
  }
  const vtkSpatialOrder& order = points.GetOrder();
  vtkPointProjectionOpenGL& projection = this->Internals->Projection;
  this->LastFrameBytesUploaded += projection.UploadIds(order.GetIds(), order.GetTime());
  projection.SetPoints(&points, colors ? colors : coordinates ? coordinates : tcoords, frame);
  this->VBOBuildTime.Modified();
}

vtkSmartPointer<vtkDataArray> vtkPointSurfaceMapper::GetNormals()
{
  if (this->NeedsNormals() && this->UsesProjection())
  {
    return this->Internals->Points.GetCloud()->GetPointData()->GetNormals();
  }
  // VTK's shaders take a normal from the surface buffer only where there is a buffer of normals
  vtkNew<vtkFloatArray> standIn;
  standIn->SetNumberOfComponents(3);
  standIn->InsertNextTuple3(0.0, 0.0, 1.0);
  return this->Internals->StandIns["no normals"].Keep(standIn);
}

vtkDataArray* vtkPointSurfaceMapper::RequireTuples(vtkDataArray* array, const char* what)
{
  const vtkIdType points = this->GetBlocks().GetCloud()->GetNumberOfPoints();
  if (!array || array->GetNumberOfTuples() >= points)
  {
    return array;
  }
  this->WarnOnce("There are " + std::to_string(array->GetNumberOfTuples()) + " " + what + " for " +
    std::to_string(points) + " points; they are not used. Give one for each point.");
  return nullptr;
}

void vtkPointSurfaceMapper::UploadStandIn(
  const char* attribute, vtkDataArray* array, vtkOpenGLVertexBufferObjectCache* cache)
{
  if (!array)
  {
    this->VBOs->RemoveAttribute(attribute);
    return;
  }
  vtkNew<vtkFloatArray> one;
  one->SetNumberOfComponents(array->GetNumberOfComponents());
  one->SetNumberOfTuples(1);
  one->Fill(0.0);
  this->VBOs->CacheDataArray(
    attribute, this->Internals->StandIns[attribute].Keep(one), cache, VTK_FLOAT);
}

//------------------------------------------------------------------------------
void vtkPointSurfaceMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  this->DrawingVertices = false;
  this->DrawingSelection = false;
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  this->Internals->Window = window;
  if (this->BeginsFrame())
  {
    this->LastFramePointsDrawn = 0;
    this->LastFrameLevels = 0;
    this->LastFramePasses = 0;
    this->LastFrameReconstructions = 0;
    this->LastFramePixelsShaded = 0;
    for (auto& timer : this->Internals->Timers)
    {
      timer.Reset();
    }
    std::fill_n(this->Internals->ClockMilliseconds, static_cast<int>(NumberOfStages), 0.0);
    this->CountBytesUploaded();
  }
  this->Internals->Current = nullptr;
  if (!this->Internals->LackOfTextures.empty())
  {
    std::fill_n(this->LastFrameRectangle, 4, 0);
    return;
  }
  this->TimerQuery->ReusableStart();
  FlushQuery();

  const std::vector<vtkPointBlockGroup> groups = this->GetBlockGroups(renderer, actor);
  if (groups.size() > 1)
  {
    // the first ones are opaque, though VTK draws the actor as translucent: they hide the others
    vtkOpenGLState::ScopedglDepthMask depthMask(window->GetState());
    vtkInformation* keys = actor->GetPropertyKeys();
    if (!keys || !keys->Has(vtkOpenGLActor::GLDepthMaskOverride())) // which depth peeling sets
    {
      window->GetState()->vtkglDepthMask(GL_TRUE);
    }
    this->DrawBlocks(renderer, actor, groups.front());
  }
  this->DrawBlocks(renderer, actor, groups.back());
  // of an earlier frame, so that none waits; VTK measures it for cells alone, and actors with
  // levels of detail go by it
  this->TimerQuery->ReusableStop();
  FlushQuery();
  this->TimeToDraw = std::max<double>(this->TimerQuery->GetReusableElapsedSeconds(), 1e-4);
  const std::string errors = TakeOpenGLErrors();
  if (!errors.empty())
  {
    vtkErrorMacro("OpenGL reports errors while this cloud is drawn: "
      << errors << "; the picture may be wrong. What the driver can do is told by "
      << "vtkRenderWindow::ReportCapabilities; a smaller window or a lower Supersampling takes "
         "less memory.");
  }
}

std::set<std::string> vtkPointSurfaceMapper::GetBufferNames() const
{
  return { "vertexMC", "normalMC", "radiusMC", "scalarColor", "tcoord",
    VTK_POINT_SURFACE_COLOR_TCOORD };
}

void vtkPointSurfaceMapper::CountBytesUploaded()
{
  for (const std::string& name : this->GetBufferNames())
  {
    vtkOpenGLVertexBufferObject* buffer = this->VBOs->GetVBO(name.c_str());
    if (buffer && buffer->GetUploadTime() > this->Internals->FrameTime)
    {
      this->LastFrameBytesUploaded +=
        static_cast<vtkIdType>(buffer->GetNumberOfTuples()) * buffer->GetStride();
    }
  }
  if (this->ColorTextureMap && this->ColorTextureMap->GetMTime() != this->Internals->ColorTableTime)
  {
    this->Internals->ColorTableTime = this->ColorTextureMap->GetMTime();
    vtkDataArray* table = this->ColorTextureMap->GetPointData()->GetScalars();
    this->LastFrameBytesUploaded += table->GetNumberOfValues() * table->GetDataTypeSize();
  }
}

void vtkPointSurfaceMapper::DrawBlocks(
  vtkRenderer* renderer, vtkActor* actor, const vtkPointBlockGroup& blocks)
{
  const vtkPointSurfaceView view = this->GetView(renderer, actor, blocks);
  const auto rectangle = view.GetViewportRectangle();
  std::copy(rectangle.begin(), rectangle.end(), this->LastFrameRectangle);
  if (view.Ranges.empty() || rectangle[2] <= 0 || rectangle[3] <= 0)
  {
    return;
  }
  if (this->JoinSurface(actor, view))
  {
    return;
  }
  if (!this->FindJointSurface(view))
  {
    this->FindOrMakeSurfaceBuffer(renderer, view);
  }
  if (this->LastFrameRectangle[2] <= 0 || this->LastFrameRectangle[3] <= 0)
  {
    return; // another cloud shades this one's points too
  }
  this->Internals->Timers[Shade].Start();
  FlushQuery();
  this->ShadeSurfaceBuffer(renderer, actor);
  this->Internals->Timers[Shade].Stop();
}

//------------------------------------------------------------------------------
namespace
{
/// What a motion does to normals, both of row vectors.
vtkSmartPointer<vtkMatrix3x3> GetNormalMatrix(vtkMatrix4x4* motion)
{
  auto matrix = vtkSmartPointer<vtkMatrix3x3>::New();
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      matrix->SetElement(column, row, motion->GetElement(row, column));
    }
  }
  matrix->Invert();
  return matrix;
}

/// Bounds of blocks, as far as they lie within those of what is drawn at all.
std::array<double, 6> GetBoundsOf(const vtkPointBlockGroup& blocks, const double* limits)
{
  std::array<double, 6> bounds;
  vtkMath::UninitializeBounds(bounds.data());
  for (const vtkPointBlock* block : blocks)
  {
    vtkPointBlocks::AddBounds(*block, bounds.data());
  }
  for (int i = 0; i < 6; ++i)
  {
    bounds[i] = i % 2 == 0 ? std::max(bounds[i], limits[i]) : std::min(bounds[i], limits[i]);
  }
  return bounds;
}

/// Samples of a pixel of what is drawn to now, if several: the window itself has them, few passes.
int GetMultiSamples(vtkOpenGLRenderWindow* window)
{
  GLint samples = 0;
  window->GetState()->vtkglGetIntegerv(GL_SAMPLES, &samples);
  return samples > 1 ? samples : 0;
}

int GetCulling(vtkProperty* property)
{
  return property->GetBackfaceCulling() ? vtkPointSurfaceView::BackfaceCulling
    : property->GetFrontfaceCulling()   ? vtkPointSurfaceView::FrontfaceCulling
                                        : vtkPointSurfaceView::NoCulling;
}
}

int vtkPointSurfaceMapper::GetPossibleSupersampling(const int viewport[2])
{
  const int largest = vtkTextureObject::GetMaximumTextureSize(this->Internals->Window);
  auto isPossible = [&](int samples)
  {
    const double width = static_cast<double>(samples) * viewport[0];
    const double height = static_cast<double>(samples) * viewport[1];
    return std::max(width, height) <= largest && width * height <= MaximumNumberOfSamples;
  };
  int possible = this->Supersampling;
  while (possible > 1 && !isPossible(possible))
  {
    --possible;
  }
  if (possible < this->Supersampling &&
    !std::equal(viewport, viewport + 2, this->Internals->WarnedViewport))
  {
    std::copy_n(viewport, 2, this->Internals->WarnedViewport);
    vtkWarningMacro("A Supersampling of "
      << this->Supersampling << " of a viewport of " << viewport[0] << " x " << viewport[1]
      << " pixels would need more than textures can hold (" << largest << " along a side) or "
      << MaximumNumberOfSamples << " samples; it is lowered to " << possible << " there.");
  }
  return possible;
}

vtkPointSurfaceView vtkPointSurfaceMapper::GetView(
  vtkRenderer* renderer, vtkActor* actor, const vtkPointBlockGroup& blocks)
{
  vtkPointSurfaceView view;
  auto* camera = static_cast<vtkOpenGLCamera*>(renderer->GetActiveCamera());
  vtkMatrix4x4 *wcvc, *vcdc, *wcdc;
  vtkMatrix3x3* normals;
  camera->GetKeyMatrices(renderer, wcvc, normals, vcdc, wcdc);
  vtkNew<vtkMatrix4x4> modelToEye;
  modelToEye->DeepCopy(wcvc);
  vtkNew<vtkMatrix3x3> normal;
  normal->DeepCopy(normals);
  if (!actor->GetIsIdentity())
  {
    vtkMatrix4x4* mcwc;
    vtkMatrix3x3* actorNormals;
    static_cast<vtkOpenGLActor*>(actor)->GetKeyMatrices(mcwc, actorNormals);
    vtkMatrix4x4::Multiply4x4(mcwc, wcvc, modelToEye);
    vtkMatrix3x3::Multiply3x3(actorNormals, normals, normal);
  }
  vtkMatrix4x4* viewToEye = this->Internals->ViewToEye;
  vtkEyeFrame::FromCamera(wcvc, vcdc, viewToEye);
  vtkEyeFrame::StepBack(vcdc, modelToEye, this->Internals->Points.GetBounds(), viewToEye);
  vtkMatrix4x4::Multiply4x4(modelToEye, viewToEye, modelToEye);
  vtkMatrix3x3::Multiply3x3(normal, GetNormalMatrix(viewToEye), normal);
  vtkNew<vtkMatrix4x4> eyeToClip;
  vtkMatrix4x4::Invert(viewToEye, eyeToClip);
  vtkMatrix4x4::Multiply4x4(eyeToClip, vcdc, eyeToClip);
  vtkNew<vtkMatrix4x4> uploadedToEye;
  uploadedToEye->DeepCopy(modelToEye);
  vtkOpenGLVertexBufferObject* positions = this->VBOs->GetVBO("vertexMC");
  const bool shifted = positions && positions->GetCoordShiftAndScaleEnabled();
  if (shifted)
  {
    vtkMatrix4x4::Multiply4x4(this->VBOShiftScale, modelToEye, uploadedToEye);
  }
  std::copy_n(modelToEye->GetData(), 16, view.ModelToEye.begin());
  std::copy_n(uploadedToEye->GetData(), 16, view.MCVC.begin());
  std::copy_n(eyeToClip->GetData(), 16, view.VCDC.begin());
  std::copy_n(normal->GetData(), 9, view.Normal.begin());

  // the viewport in force, whoever set it: the renderer, a pass, a baker of shadows
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  int viewport[4];
  window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  std::copy_n(viewport, 2, this->Internals->ViewportOrigin);
  view.Supersampling = this->GetPossibleSupersampling(viewport + 2);
  view.Size = { view.Supersampling * viewport[2], view.Supersampling * viewport[3] };
  view.SmoothOutline =
    GetMultiSamples(window) > 0 && view.Supersampling == 1 && !this->MakesCoverage();

  view.Cull = this->NeedsNormals() ? GetCulling(actor->GetProperty())
                                   : static_cast<int>(vtkPointSurfaceView::NoCulling);
  view.NumberOfClippingPlanes = std::min(6, this->GetNumberOfClippingPlanes());
  vtkNew<vtkMatrix4x4> eyeToModel;
  vtkMatrix4x4::Invert(modelToEye, eyeToModel);
  for (int i = 0; i < view.NumberOfClippingPlanes; ++i)
  {
    double plane[4];
    this->GetClippingPlaneInDataCoords(actor->GetMatrix(), i, plane);
    for (int row = 0; row < 4; ++row)
    {
      for (int k = 0; k < 4; ++k)
      {
        view.ClippingPlanes[i][row] += eyeToModel->GetElement(row, k) * plane[k];
      }
    }
  }

  view.DataTime = this->Internals->PointsTime.GetMTime();
  if (this->UploadsStandIns())
  {
    view.DataTime = std::max(view.DataTime, this->Internals->ProjectionCPU.GetColorsTime());
  }
  else
  {
    // not VBOs->GetMTime(), which new values in an array do not change
    for (const std::string& name : this->GetBufferNames())
    {
      vtkOpenGLVertexBufferObject* buffer = this->VBOs->GetVBO(name.c_str());
      view.DataTime =
        std::max(view.DataTime, buffer ? buffer->GetUploadTime().GetMTime() : vtkMTimeType(0));
    }
  }
  view.MapperTime = this->GetMTime();

  const vtkDrawablePoints& points = this->Internals->Points;
  view.RadiusScale = this->RadiusScale * vtkPointSurfaceView::GetLargestStretch(modelToEye);
  this->GetReach(view.MeanRadius, view.LargestRadius);
  view.MeanRadius *= view.RadiusScale;
  view.LargestRadius *= view.RadiusScale;
  if (points.GetNumberOfDrawnPoints() > 0)
  {
    view.Ranges = vtkPointBlocks::GetRanges(blocks, points.GetDrawnIds());
  }
  if (!view.Ranges.empty())
  {
    // all processes make their images alike
    vtkDoubleArray* whole = GetWhole(this->GetBlocks());
    view.SetExtent(modelToEye,
      whole ? whole->GetPointer(0) : GetBoundsOf(blocks, points.GetBounds()).data(), this->GetRim(),
      vtkTextureObject::GetMaximumTextureSize(this->Internals->Window));
  }
  return view;
}

bool vtkPointSurfaceMapper::IsPart() const
{
  return GetWhole(this->GetBlocks()) != nullptr;
}

bool vtkPointSurfaceMapper::HasDuplicates() const
{
  return !this->Internals->Points.GetDuplicates().empty();
}

bool vtkPointSurfaceMapper::CanTellDuplicates()
{
  vtkInternals& internals = *this->Internals;
  if (!this->HasDuplicates())
  {
    return false;
  }
  const std::string lack = vtkDuplicatePoints::FindLack(internals.Points.GetDuplicates().size());
  if (!lack.empty() && lack != internals.ToldLackOfDuplicates)
  {
    internals.ToldLackOfDuplicates = lack;
    vtkWarningMacro("This OpenGL context "
      << lack << ", which tells copies of other processes' points (vtkGhostType) from this one's; "
      << "they are drawn alike, so that pictures put together by depth may differ where processes "
         "meet. Update the graphics driver, or spread the points over more processes.");
  }
  return lack.empty();
}

vtkDuplicatePoints* vtkPointSurfaceMapper::ActivateDuplicates()
{
  vtkInternals& internals = *this->Internals;
  if (!this->CanTellDuplicates())
  {
    return nullptr;
  }
  internals.Duplicates.Activate(
    internals.Window, internals.Points.GetDuplicates(), internals.PointsTime.GetMTime());
  return &internals.Duplicates;
}

//------------------------------------------------------------------------------
bool vtkPointSurfaceMapper::BeginsFrame() const
{
  return !this->Internals->Joint || this->Internals->Joint->IsCollecting();
}

void vtkPointSurfaceMapper::SetJointSurface(vtkJointSurface* joint)
{
  this->Internals->Joint = joint;
}

bool vtkPointSurfaceMapper::JoinSurface(vtkActor* actor, const vtkPointSurfaceView& view)
{
  vtkJointSurface* joint = this->Internals->Joint;
  if (!joint || !joint->IsCollecting())
  {
    return false;
  }
  vtkJointSurface::Member member;
  member.Mapper = this;
  member.Actor = actor;
  member.View = view;
  member.HasColors = this->VBOs->GetNumberOfComponents("scalarColor") > 0;
  member.HasDuplicates = this->HasDuplicates();
  const double* color = actor->GetProperty()->GetDiffuseColor();
  std::copy_n(color, 3, member.Color.begin());
  member.Color[3] = 1.0f;
  member.NumberOfPoints = this->GetBlocks().GetCloud()->GetNumberOfPoints();
  // colours cannot be averaged with places in a texture
  const bool textured = vtkPointProjectionOpenGL::HasColors(this->VBOs) && !member.HasColors;
  if (!textured)
  {
    joint->Add(member);
  }
  return true;
}

bool vtkPointSurfaceMapper::FindJointSurface(const vtkPointSurfaceView& view)
{
  vtkInternals& internals = *this->Internals;
  const vtkJointSurface::Member* member =
    internals.Joint ? internals.Joint->Find(this, view) : nullptr;
  internals.PointRange[0] = member ? static_cast<int>(member->FirstId) : 0;
  internals.PointRange[1] =
    member ? static_cast<int>(member->FirstId + member->ShadedIds) : VTK_INT_MAX;
  if (member)
  {
    std::copy_n(member->ShadedRectangle.begin(), 4, this->LastFrameRectangle);
    internals.JointBuffer = internals.Joint->GetBuffer();
    internals.Current = internals.JointBuffer.get();
  }
  return member != nullptr;
}

void vtkPointSurfaceMapper::MakeJointSurface(const vtkJointSurface& joint)
{
  const auto& members = joint.GetMembers();
  const bool colors = std::any_of(
    members.begin(), members.end(), [](const auto& member) { return member.HasColors; });
  this->Internals->Projected = members;
  this->MakeBuffer(*joint.GetBuffer(), joint.GetView(), true, colors);
}

void vtkPointSurfaceMapper::FindOrMakeSurfaceBuffer(
  vtkRenderer* renderer, const vtkPointSurfaceView& view)
{
  vtkInternals& internals = *this->Internals;
  const bool needsIds = this->RecordPointIds || renderer->GetSelector() || this->HasDuplicates();
  vtkInternals::SurfaceBuffer* surface = internals.Find(view);
  const bool holds = surface && (!needsIds || surface->Target.Has(vtkSurfaceTarget::Id));
  if (!surface)
  {
    surface = internals.GetLeastRecentlyUsed();
  }
  internals.Current = surface;
  surface->LastUse = ++internals.UseCount;
  if (holds)
  {
    return;
  }

  vtkJointSurface::Member alone;
  alone.Mapper = this;
  alone.View = view;
  alone.HasColors = vtkPointProjectionOpenGL::HasColors(this->VBOs);
  internals.Projected = { alone };
  this->MakeBuffer(*surface, view, needsIds, alone.HasColors);
}

namespace
{
/// As VTK's scopes of other state, which has none for this. Depth peeling blends by the maximum.
class ScopedBlendEquation
{
public:
  explicit ScopedBlendEquation(vtkOpenGLState* state)
    : State(state)
  {
    glGetIntegerv(GL_BLEND_EQUATION_RGB, &this->Color);
    glGetIntegerv(GL_BLEND_EQUATION_ALPHA, &this->Alpha);
  }
  ~ScopedBlendEquation()
  {
    this->State->vtkglBlendEquationSeparate(
      static_cast<GLenum>(this->Color), static_cast<GLenum>(this->Alpha));
  }
  ScopedBlendEquation(const ScopedBlendEquation&) = delete;
  ScopedBlendEquation& operator=(const ScopedBlendEquation&) = delete;

private:
  vtkOpenGLState* State;
  GLint Color = GL_FUNC_ADD;
  GLint Alpha = GL_FUNC_ADD;
};
}

namespace
{
/// One rectangle for each row of tiles, that holds all of them.
std::vector<std::array<int, 4>> GetHulls(const std::vector<std::array<int, 4>>& tiles)
{
  std::vector<std::array<int, 4>> hulls;
  for (const auto& tile : tiles)
  {
    if (hulls.empty() || hulls.back()[1] != tile[1])
    {
      hulls.push_back(tile);
    }
    hulls.back()[2] = tile[2];
  }
  return hulls;
}
}

void vtkPointSurfaceMapper::MakeBuffer(
  vtkSurfaceBuffer& surface, const vtkPointSurfaceView& view, bool ids, bool colors)
{
  vtkInternals& internals = *this->Internals;
  std::vector<vtkSurfaceTarget::Layer> layers = { vtkSurfaceTarget::Surface };
  if (ids)
  {
    layers.push_back(vtkSurfaceTarget::Id);
  }
  if (colors)
  {
    layers.push_back(vtkSurfaceTarget::Color);
  }
  vtkOpenGLRenderWindow* window = internals.Window;
  vtkOpenGLState* state = window->GetState();
  const int width = view.Size[0] / view.Supersampling;
  const int height = view.Size[1] / view.Supersampling;
  surface.Target.Allocate(window, width, height, layers);
  const bool resolve = view.Supersampling > 1;
  const auto& r = view.Rectangle;
  surface.View = view;
  surface.Valid = true;
  surface.HasCoverage = resolve || view.SmoothOutline || this->MakesCoverage();
  surface.LesserTiles.clear();
  ++this->LastFrameReconstructions;
  if (this->LastFrameBackend == CPU)
  {
    const double start = vtkTimerLog::GetUniversalTime();
    vtkSurfacePixels& samples = resolve ? internals.SamplePixels : internals.Pixels;
    this->MakeSurfacePixels(view, ids, colors, samples);
    if (resolve)
    {
      surface.LesserTiles =
        vtkResolveCPU::Run(view, samples, internals.Pixels, internals.LesserPixels);
      ++this->LastFramePasses;
    }
    else if (view.SmoothOutline)
    {
      vtkOutlineCoverageCPU::Run(view.Size, samples);
      ++this->LastFramePasses;
    }
    surface.Bands = internals.Pixels.GetBands();
    this->LastFrameSurfaceBytesUploaded +=
      surface.Target.Upload(window, internals.Pixels, internals.Pixels.GetRead(surface.Bands));
    if (!surface.LesserTiles.empty())
    {
      surface.Lesser.Allocate(window, width, height, layers);
      this->LastFrameSurfaceBytesUploaded += surface.Lesser.Upload(window, internals.LesserPixels,
        internals.LesserPixels.GetRead(GetHulls(surface.LesserTiles)));
    }
    internals.ClockMilliseconds[Reconstruct] =
      1e3 * (vtkTimerLog::GetUniversalTime() - start) - internals.ClockMilliseconds[Project];
    return;
  }
  const auto pixels = view.GetPixelRectangle();
  surface.Bands = { { pixels[0], pixels[1], pixels[0] + pixels[2], pixels[1] + pixels[3] } };
  state->PushFramebufferBindings();
  GLint blendEquations[2]; // dual depth peeling has another one than the steps
  state->vtkglGetIntegerv(GL_BLEND_EQUATION_RGB, &blendEquations[0]);
  state->vtkglGetIntegerv(GL_BLEND_EQUATION_ALPHA, &blendEquations[1]);
  state->vtkglBlendEquation(GL_FUNC_ADD);
  {
    vtkOpenGLState::ScopedglViewport viewport(state);
    vtkOpenGLState::ScopedglScissor scissor(state);
    vtkOpenGLState::ScopedglDepthMask depthMask(state);
    vtkOpenGLState::ScopedglDepthFunc depthFunc(state);
    vtkOpenGLState::ScopedglColorMask colorMask(state);
    vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
    vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
    vtkOpenGLState::ScopedglEnableDisable scissorTest(state, GL_SCISSOR_TEST);
    vtkOpenGLState::ScopedglEnableDisable multisample(state, GL_MULTISAMPLE);
    vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
    ScopedBlendEquation blendEquation(state);
    state->vtkglBlendEquation(GL_FUNC_ADD);
    state->vtkglDisable(GL_BLEND);
    state->vtkglDisable(GL_DEPTH_TEST);
    state->vtkglDisable(GL_MULTISAMPLE);
    state->vtkglDisable(GL_CULL_FACE);
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    if (!this->UsesProjection())
    {
      internals.Timers[Reconstruct].Start();
    }
    if (resolve || view.SmoothOutline)
    {
      internals.Samples.Allocate(window, view.Size[0], view.Size[1], layers);
      this->MakeSurfaceBuffer(window, view, internals.Samples);
      if (resolve)
      {
        surface.Lesser.Allocate(window, width, height, layers);
        internals.Resolve.Run(window, view, internals.Samples, surface.Target, false);
        internals.Resolve.Run(window, view, internals.Samples, surface.Lesser, true);
        surface.LesserTiles = surface.Bands;
        ++this->LastFramePasses;
      }
      else
      {
        internals.Coverage.Run(
          window, { r[0], r[1], r[0] + r[2], r[1] + r[3] }, internals.Samples, surface.Target);
      }
      ++this->LastFramePasses;
    }
    else
    {
      this->MakeSurfaceBuffer(window, view, surface.Target);
    }
    internals.Timers[Reconstruct].Stop();
  }
  state->vtkglBlendEquationSeparate(blendEquations[0], blendEquations[1]);
  state->PopFramebufferBindings();
}

void vtkPointSurfaceMapper::BeginProjection()
{
  if (this->LastFrameBackend == CPU)
  {
    this->Internals->ClockMilliseconds[Project] = -1e3 * vtkTimerLog::GetUniversalTime();
    return;
  }
  this->Internals->Timers[Project].Start();
  FlushQuery();
}

void vtkPointSurfaceMapper::EndProjection()
{
  if (this->LastFrameBackend == CPU)
  {
    this->Internals->ClockMilliseconds[Project] += 1e3 * vtkTimerLog::GetUniversalTime();
    return;
  }
  this->Internals->Timers[Project].Stop();
  this->Internals->Timers[Reconstruct].Start();
  FlushQuery();
}

const std::vector<vtkJointSurfaceMember>& vtkPointSurfaceMapper::GetMembers() const
{
  return this->Internals->Projected;
}

vtkDrawnClouds vtkPointSurfaceMapper::GetDrawnClouds(
  const vtkPointSurfaceView& view, int thinning, double reach)
{
  vtkDrawnClouds clouds;
  for (const vtkJointSurface::Member& member : this->Internals->Projected)
  {
    vtkInternals& source = *member.Mapper->Internals;
    vtkPointSurfaceView ownView = member.GetView(view);
    const int ownThinning = member.Mapper->ThinsPoints()
      ? vtkPointThinning::GetSizeFor(
          ownView, source.Points.GetNumberOfDrawnPoints(), view, thinning)
      : 1;
    ownView.GrowRadii(vtkPointThinning::GetRadiusFactor(ownThinning));
    ownView.LeaveOutUnseen(source.Points.GetOrder(), reach * ownView.LargestRadius);
    if (this->LastFrameBackend == CPU)
    {
      ownView.Ranges = source.ProjectionCPU.Thin(ownThinning, ownView.Ranges);
      member.Mapper->LastFramePointsDrawn += ownView.GetNumberOfPoints();
      clouds.CPU.push_back(
        { &source.ProjectionCPU, ownView, ownThinning, member.FirstId, member.Color });
      continue;
    }
    vtkPointProjectionOpenGL::Cloud cloud;
    member.Mapper->LastFrameBytesUploaded += source.Projection.UploadThinned(ownThinning);
    ownView.Ranges = source.Projection.GetDrawn(ownThinning, ownView.Ranges);
    member.Mapper->LastFramePointsDrawn += ownView.GetNumberOfPoints();
    cloud.Projection = &source.Projection;
    cloud.View = ownView;
    cloud.Thinning = ownThinning;
    cloud.Buffers = member.Mapper->VBOs;
    cloud.UniformRadius = source.Points.GetRadii() ? 0.0 : source.Points.GetUniformRadius();
    cloud.HaveNormals = this->NeedsNormals();
    cloud.FirstId = member.FirstId;
    cloud.Color = member.Color;
    clouds.OpenGL.push_back(cloud);
  }
  return clouds;
}

void vtkPointSurfaceMapper::ProjectPoints(vtkOpenGLRenderWindow* window,
  const vtkPointSurfaceView& view, const vtkPointProjectionOptions& options,
  const vtkSurfaceTarget& surface, vtkSurfaceTarget& projected, vtkSurfaceTarget* farthest)
{
  this->BeginProjection();
  std::vector<vtkSurfaceTarget::Layer> layers = { vtkSurfaceTarget::Shape,
    vtkSurfaceTarget::Interval };
  if (surface.Has(vtkSurfaceTarget::Color))
  {
    layers.push_back(vtkSurfaceTarget::Color);
  }
  // tells a pixel's nearest point from the others; last, as it is not averaged
  if (options.AveragePoints || surface.Has(vtkSurfaceTarget::Id))
  {
    layers.push_back(vtkSurfaceTarget::Id);
  }
  projected.Allocate(window, view.Size[0], view.Size[1], layers, true);
  const std::vector<vtkPointProjectionOpenGL::Cloud> clouds =
    this->GetDrawnClouds(view, options.Thinning).OpenGL;
  vtkPointProjectionOpenGL& projection = this->Internals->Projection;
  projection.Draw(window, clouds, options, projected);
  if (farthest)
  {
    farthest->Allocate(window, view.Size[0], view.Size[1], layers, true);
    projection.Draw(window, clouds, options, *farthest, &projected);
  }
  this->EndProjection();
}

void vtkPointSurfaceMapper::ProjectPoints(const vtkPointSurfaceView& view,
  const vtkPointProjectionOptions& options, bool ids, bool colors, vtkSurfaceImage& projected,
  vtkSurfaceImage* farthest)
{
  this->BeginProjection();
  const auto& r = view.Rectangle;
  const vtkSurfaceImage::Rectangle rectangle = { r[0], r[1], r[0] + r[2], r[1] + r[3] };
  projected.Allocate(view.Size[0], view.Size[1], rectangle, ids, colors);
  const std::vector<vtkPointProjectionCPU::Cloud> clouds =
    this->GetDrawnClouds(view, options.Thinning).CPU;
  vtkPointProjectionCPU& projection = this->Internals->ProjectionCPU;
  projection.Draw(clouds, options, projected);
  if (farthest)
  {
    farthest->Allocate(view.Size[0], view.Size[1], rectangle, ids, colors);
    projection.Draw(clouds, options, *farthest, &projected);
  }
  this->EndProjection();
}

//------------------------------------------------------------------------------
namespace
{
/// While it lives, a fragment's alpha is the share of the pixel's samples that it is written to, as
/// what an opaque mesh covers in part is: it does not matter what is drawn first.
class ScopedAlphaToCoverage
{
public:
  explicit ScopedAlphaToCoverage(vtkOpenGLState* state)
    : BlendFunction(state)
  {
    // what is written replaces what was there; only of nothing there remains the share
    state->vtkglBlendFuncSeparate(GL_ONE, GL_ZERO, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  }
  ~ScopedAlphaToCoverage() { glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE); }
  ScopedAlphaToCoverage(const ScopedAlphaToCoverage&) = delete;
  ScopedAlphaToCoverage& operator=(const ScopedAlphaToCoverage&) = delete;

private:
  vtkOpenGLState::ScopedglBlendFuncSeparate BlendFunction;
};
}

vtkIdType vtkPointSurfaceMapper::DrawRectangles(
  vtkShaderProgram* program, const std::vector<std::array<int, 4>>& bands)
{
  const vtkPointSurfaceView& view = this->Internals->Current->View;
  std::vector<std::array<float, 4>> rectangles;
  vtkIdType drawnPixels = 0;
  for (const auto& band : bands)
  {
    const int* drawn = this->LastFrameRectangle;
    int size[2];
    std::array<float, 4> rectangle;
    for (int k = 0; k < 2; ++k)
    {
      const int begin = std::max(band[k] - view.Rim, drawn[k]);
      const int end = std::min(band[2 + k] - view.Rim, drawn[k] + drawn[2 + k]);
      const auto pixels = static_cast<float>(view.Size[k] / view.Supersampling - 2 * view.Rim);
      size[k] = std::max(end - begin, 0);
      rectangle[k] = 2.0f * begin / pixels - 1.0f;
      rectangle[2 + k] = 2.0f * end / pixels - 1.0f;
    }
    if (size[0] > 0 && size[1] > 0)
    {
      rectangles.push_back(rectangle);
      drawnPixels += static_cast<vtkIdType>(size[0]) * size[1];
    }
  }
  for (size_t first = 0; first < rectangles.size(); first += vtkSurfacePixels::MaximumNumberOfBands)
  {
    const int count = static_cast<int>(
      std::min<size_t>(rectangles.size() - first, vtkSurfacePixels::MaximumNumberOfBands));
    program->SetUniform4fv(
      "psRectangles", count, reinterpret_cast<const float(*)[4]>(&rectangles[first]));
    glDrawArrays(GL_TRIANGLES, 0, 6 * count);
  }
  return drawnPixels;
}

void vtkPointSurfaceMapper::DrawLesserSurface(vtkShaderProgram* program)
{
  vtkSurfaceBuffer& surface = *this->Internals->Current;
  surface.Target.Deactivate();
  surface.Lesser.Activate();
  surface.Lesser.SetSamplers(program, "ps");
  program->SetUniformi("psIsLesser", 1);
  this->DrawRectangles(program, surface.LesserTiles);
  program->SetUniformi("psIsLesser", 0);
  surface.Lesser.Deactivate();
  surface.Target.Activate();
  surface.Target.SetSamplers(program, "ps");
}

void vtkPointSurfaceMapper::ShadeSurfaceBuffer(vtkRenderer* renderer, vtkActor* actor)
{
  vtkInternals& internals = *this->Internals;
  vtkSurfaceTarget& target = internals.Current->Target;
  vtkDuplicatePoints* duplicates = this->ActivateDuplicates();
  const bool hasDuplicates = duplicates != nullptr;
  if (internals.ShadedLayers != target.GetLayers() || internals.ShadedDuplicates != hasDuplicates)
  {
    internals.ShadedLayers = target.GetLayers();
    internals.ShadedDuplicates = hasDuplicates;
    internals.ShadedLayersTime.Modified();
  }

  vtkOpenGLState* state = internals.Window->GetState();
  vtkOpenGLHelper& helper = this->Primitives[PrimitiveTris]; // what VTK lights
  helper.IBO->IndexCount = 3; // or VTK forgets when it has set the attributes
  target.Activate();
  internals.Current->Splats.Activate();
  this->UpdateShaders(helper, renderer, actor);
  if (helper.Program)
  {
    vtkOpenGLState::ScopedglDepthMask depthMask(state);
    if (renderer->GetSelector())
    {
      // VTK leaves depths as the picture before has them, and writes none where it picks points; of
      // several processes ParaView's first one clears that picture's, and would not be composited
      state->vtkglDepthMask(GL_TRUE);
    }
    vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
    state->vtkglDisable(GL_CULL_FACE); // points were culled in projection
    if (renderer->GetUseImageBasedLighting() && renderer->GetEnvironmentTexture())
    {
      state->vtkglEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS); // as vtkOpenGLPolyDataMapper does
    }
    std::optional<ScopedAlphaToCoverage> alphaToCoverage;
    const int samples = GetMultiSamples(internals.Window);
    const bool coversSamples = samples > 0 && internals.Current->HasCoverage &&
      !actor->IsRenderingTranslucentPolygonalGeometry();
    if (coversSamples)
    {
      alphaToCoverage.emplace(state);
    }
    helper.Program->SetUniformi("psCoverSteps", coversSamples ? samples : 0);
    helper.VAO->Bind();
    if (!internals.Current->LesserTiles.empty() && !renderer->GetSelector())
    {
      this->DrawLesserSurface(helper.Program);
    }
    this->LastFramePixelsShaded += this->DrawRectangles(helper.Program, internals.Current->Bands);
  }
  if (duplicates)
  {
    duplicates->Deactivate();
  }
  internals.Current->Splats.Deactivate();
  target.Deactivate();
}

bool vtkPointSurfaceMapper::GetNeedToRebuildShaders(
  vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor)
{
  return this->Superclass::GetNeedToRebuildShaders(helper, renderer, actor) ||
    helper.ShaderSourceTime < this->Internals->ShadedLayersTime;
}

void vtkPointSurfaceMapper::GetShaderTemplate(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::GetShaderTemplate(shaders, renderer, actor);
  shaders[vtkShader::Vertex]->SetSource(vtkSurfaceBufferVS);
  shaders[vtkShader::Geometry]->SetSource("");
}

void vtkPointSurfaceMapper::ReplaceShaderValues(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  vtkShader* fragment = shaders[vtkShader::Fragment];
  std::string text = fragment->GetSource();
  vtkSurfaceBufferShading::Prepare(
    text, this->Internals->ShadedLayers, this->Internals->ShadedDuplicates);
  fragment->SetSource(text);
  this->Superclass::ReplaceShaderValues(shaders, renderer, actor);
  text = fragment->GetSource();
  vtkSurfaceBufferShading::Finish(text);
  if (IsSoftwareRasterizer())
  {
    GLint components = 0;
    glGetIntegerv(GL_MAX_VARYING_COMPONENTS, &components);
    std::string vertexText = shaders[vtkShader::Vertex]->GetSource();
    vtkSurfaceBufferShading::HandOnUniforms(vertexText, text, components / 4 - 1); // psRay is one
    shaders[vtkShader::Vertex]->SetSource(vertexText);
  }
  fragment->SetSource(text);
}

namespace
{
/// What vtkSurfaceBufferVS.glsl finds each pixel's ray with.
std::array<std::array<float, 4>, 3> GetRays(const vtkPointSurfaceView& view)
{
  const auto& m = view.VCDC;
  std::array<std::array<float, 4>, 3> rays{};
  for (int k = 0; k < 2; ++k)
  {
    const double* column = &m[k == 0 ? 12 : 8]; // of 1, and of z
    // of what the viewport is of the surface buffer
    double step[2];
    for (int axis = 0; axis < 2; ++axis)
    {
      const double pixels = view.Size[axis] / view.Supersampling;
      step[axis] = column[3] * (1.0 - 2.0 * view.Rim / pixels);
    }
    const double y = -column[1] / m[5];
    const double up = step[1] / m[5];
    rays[0][2 * k] = static_cast<float>((-column[0] - m[4] * y) / m[0]);
    rays[0][2 * k + 1] = static_cast<float>(y);
    rays[1][2 * k] = static_cast<float>(step[0] / m[0]);
    rays[2][2 * k] = static_cast<float>(-m[4] * up / m[0]);
    rays[2][2 * k + 1] = static_cast<float>(up);
  }
  return rays;
}
}

void vtkPointSurfaceMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(helper, renderer, actor);
  const vtkPointSurfaceView& view = this->Internals->Current->View;
  vtkShaderProgram* program = helper.Program;
  this->Internals->Current->Target.SetSamplers(program, "ps");
  const int origin[2] = { this->Internals->ViewportOrigin[0] - view.Rim,
    this->Internals->ViewportOrigin[1] - view.Rim };
  program->SetUniform2i("psOrigin", origin);
  const float texel[2] = { static_cast<float>(view.Supersampling) / view.Size[0],
    static_cast<float>(view.Supersampling) / view.Size[1] };
  program->SetUniform2f("psTexel", texel);
  const auto rays = GetRays(view);
  program->SetUniform4fv("psRays", 3, reinterpret_cast<const float(*)[4]>(rays.data()));
  if (program->IsUniformUsed("psPoints"))
  {
    program->SetUniform2i("psPoints", this->Internals->PointRange);
  }
  if (this->Internals->ShadedDuplicates)
  {
    this->Internals->Duplicates.SetSampler(program, "psDuplicates");
    // more than depths err where the surface of the copies ends, which others have whole
    program->SetUniformf("psRecess", static_cast<float>(10.0 * view.LargestRadius));
    program->SetUniformi("psLeavesDuplicates", actor->IsRenderingTranslucentPolygonalGeometry());
  }
  program->SetUniformi("psHasCoverage", this->Internals->Current->HasCoverage);
  program->SetUniformi("psIsLesser", 0);
  const auto pixels = view.GetPixelRectangle();
  const int end[2] = { pixels[0] + pixels[2], pixels[1] + pixels[3] };
  program->SetUniform2i("psBegin", pixels.data());
  program->SetUniform2i("psEnd", end);
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(view.VCDC.data());
  program->SetUniformMatrix("psVCDC", matrix);
  vtkMatrix4x4::Invert(this->Internals->ViewToEye, matrix);
  program->SetUniformMatrix("psEyeToView", matrix);
  program->SetUniformMatrix("psNormalToView", GetNormalMatrix(matrix));
  if (program->IsUniformUsed("clipPlanes"))
  {
    // those that VTK has set are of vertices as they were uploaded
    float planes[6][4];
    for (int i = 0; i < 24; ++i)
    {
      planes[i / 4][i % 4] = static_cast<float>(view.ClippingPlanes[i / 4][i % 4]);
    }
    program->SetUniform4fv("clipPlanes", 6, planes);
  }
}

//------------------------------------------------------------------------------
void vtkPointSurfaceMapper::GetReach(double& mean, double& largest) const
{
  mean = this->Internals->Points.GetMeanRadius();
  largest = this->Internals->Points.GetLargestRadius();
  vtkDoubleArray* whole = GetWhole(this->GetBlocks());
  if (whole && this->Internals->Points.GetRadii())
  {
    mean = whole->GetValue(6);
    largest = whole->GetValue(7);
  }
}

const vtkDrawablePoints& vtkPointSurfaceMapper::GetDrawablePoints() const
{
  return this->Internals->Points;
}

std::array<float, 4> vtkPointSurfaceMapper::GetPointColor(vtkIdType id) const
{
  return this->Internals->ProjectionCPU.GetColor(static_cast<size_t>(id));
}

vtkMTimeType vtkPointSurfaceMapper::GetPointColorsTime() const
{
  return this->Internals->ProjectionCPU.GetColorsTime();
}

vtkOpenGLRenderWindow* vtkPointSurfaceMapper::GetLastWindow() const
{
  return this->Internals->Window;
}

const vtkPointSurfaceView& vtkPointSurfaceMapper::GetShadedView() const
{
  return this->Internals->Current->View;
}

vtkSurfaceTarget& vtkPointSurfaceMapper::GetSplats()
{
  return this->Internals->Current->Splats;
}

namespace
{
/// Gives the normals unit length; returns a layer with the length that they had, the coverage.
std::vector<float> SplitCoverage(std::vector<float>& surface)
{
  std::vector<float> coverage(surface.size(), 0.0f);
  for (size_t i = 0; i < surface.size(); i += 4)
  {
    if (surface[i + 3] > 0.0f)
    {
      coverage[i] = vtkMath::Normalize(&surface[i]);
    }
  }
  return coverage;
}

/// Of pixels that show a second surface as well: the two cover all of them.
void AddCoverage(const std::vector<float>& surface, std::vector<float>& coverage)
{
  for (size_t i = 0; i < surface.size(); i += 4)
  {
    coverage[i] = surface[i + 3] > 0.0f ? 1.0f : coverage[i];
  }
}

/// Rectangles as x, y, width, height.
std::vector<std::array<int, 4>> GetSizes(std::vector<std::array<int, 4>> rectangles)
{
  for (auto& r : rectangles)
  {
    r[2] -= r[0];
    r[3] -= r[1];
  }
  return rectangles;
}
}

bool vtkPointSurfaceMapper::ReadSurfaceBuffer(vtkImageData* buffer)
{
  vtkInternals& internals = *this->Internals;
  if (!internals.Current || !internals.Window)
  {
    vtkErrorMacro("There is no surface buffer to read: render a frame with this mapper first.");
    return false;
  }
  internals.Window->MakeCurrent();
  vtkOpenGLRenderWindow* window = internals.Window;
  vtkSurfaceTarget& target = internals.Current->Target;
  const vtkPointSurfaceView& view = internals.Current->View;
  const auto rectangles = GetSizes(internals.Current->Bands);
  SetImageExtent(buffer, target.GetWidth(), target.GetHeight(), view.Rim);
  auto surface = target.ReadFloats(window, vtkSurfaceTarget::Surface, rectangles);
  std::vector<float> coverage = SplitCoverage(surface);
  if (!internals.Current->LesserTiles.empty())
  {
    AddCoverage(internals.Current->Lesser.ReadFloats(
                  window, vtkSurfaceTarget::Surface, GetSizes(internals.Current->LesserTiles)),
      coverage);
  }
  AddLayer(buffer, surface, "Normals", 0, 3);
  AddLayer(buffer, surface, "Depth", 3, 1);
  AddLayer(buffer, coverage, "Coverage", 0, 1);
  if (target.Has(vtkSurfaceTarget::Color))
  {
    AddLayer(
      buffer, target.ReadFloats(window, vtkSurfaceTarget::Color, rectangles), "Colors", 0, 4);
  }
  if (target.Has(vtkSurfaceTarget::Id))
  {
    AddIds(buffer, target.ReadIds(window, rectangles));
  }
  const int viewport[6] = { 0, target.GetWidth() - 2 * view.Rim - 1, 0,
    target.GetHeight() - 2 * view.Rim - 1, 0, 0 };
  buffer->Crop(viewport);
  return true;
}

bool vtkPointSurfaceMapper::ReadProjection(const vtkPointSurfaceView& view,
  vtkSurfaceTarget& projected, vtkSurfaceImage& projectedByCPU, vtkImageData* buffer)
{
  vtkOpenGLRenderWindow* window = this->Internals->Window;
  if (!window || view.Size[0] == 0)
  {
    vtkErrorMacro("There is no projected buffer to read: render a frame with this mapper first.");
    return false;
  }
  window->MakeCurrent();
  const bool byCPU = this->LastFrameBackend == CPU;
  auto readFloats = [&](vtkSurfaceTarget::Layer layer)
  {
    return byCPU ? projectedByCPU.ReadFloats(layer)
                 : projected.ReadFloats(window, layer, { view.Rectangle });
  };
  SetImageExtent(buffer, view.Size[0], view.Size[1], view.Rim * view.Supersampling);
  const std::vector<float> shape = readFloats(vtkSurfaceTarget::Shape);
  AddLayer(buffer, shape, "Normals", 0, 3);
  AddLayer(buffer, shape, "Radius", 3, 1);
  const std::vector<float> interval = readFloats(vtkSurfaceTarget::Interval);
  AddLayer(buffer, interval, "Depth", 0, 1);
  AddLayer(buffer, interval, "Displacement", 2, 2);
  if (byCPU ? projectedByCPU.HasColors() : projected.Has(vtkSurfaceTarget::Color))
  {
    AddLayer(buffer, readFloats(vtkSurfaceTarget::Color), "Colors", 0, 4);
  }
  const vtkSurfaceBuffer* surface = this->Internals->Current;
  if (byCPU ? projectedByCPU.HasIds() : surface && surface->Target.Has(vtkSurfaceTarget::Id))
  {
    AddIds(
      buffer, byCPU ? projectedByCPU.ReadIds() : projected.ReadIds(window, { view.Rectangle }));
  }
  return true;
}

void vtkPointSurfaceMapper::SetImageExtent(vtkImageData* image, int width, int height, int rim)
{
  image->Initialize();
  image->SetExtent(-rim, width - rim - 1, -rim, height - rim - 1, 0, 0);
}

void vtkPointSurfaceMapper::AddIds(vtkImageData* image, const std::vector<unsigned int>& layer)
{
  vtkNew<vtkIntArray> ids;
  ids->SetName("PointIds");
  ids->SetNumberOfValues(static_cast<vtkIdType>(layer.size()));
  std::transform(layer.begin(), layer.end(), ids->GetPointer(0),
    [](unsigned int id) { return static_cast<int>(id) - 1; });
  image->GetPointData()->AddArray(ids);
}

void vtkPointSurfaceMapper::AddLayer(
  vtkImageData* image, const std::vector<float>& layer, const char* name, int first, int components)
{
  vtkNew<vtkFloatArray> values;
  values->SetName(name);
  values->SetNumberOfComponents(components);
  values->SetNumberOfTuples(static_cast<vtkIdType>(layer.size() / 4));
  float* value = values->GetPointer(0);
  for (size_t pixel = 0; pixel < layer.size(); pixel += 4)
  {
    value = std::copy_n(&layer[pixel + first], components, value);
  }
  image->GetPointData()->AddArray(values);
}

//------------------------------------------------------------------------------
double vtkPointSurfaceMapper::GetLastFrameProjectMilliseconds()
{
  return this->Internals->GetMilliseconds(Project);
}

double vtkPointSurfaceMapper::GetLastFrameReconstructMilliseconds()
{
  return this->Internals->GetMilliseconds(Reconstruct);
}

double vtkPointSurfaceMapper::GetLastFrameShadeMilliseconds()
{
  return this->Internals->GetMilliseconds(Shade);
}

void vtkPointSurfaceMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RadiusArray: " << (this->RadiusArray ? this->RadiusArray : "(none)") << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "RadiusScale: " << this->RadiusScale << "\n";
  os << indent << "Supersampling: " << this->Supersampling << "\n";
  os << indent << "RecordPointIds: " << this->RecordPointIds << "\n";
  os << indent << "Backend: " << this->Backend << "\n";
  os << indent << "LastFrameBackend: " << this->LastFrameBackend << "\n";
  os << indent << "LastFramePointsDrawn: " << this->LastFramePointsDrawn << "\n";
  const int* r = this->LastFrameRectangle;
  os << indent << "LastFrameRectangle: " << r[0] << " " << r[1] << " " << r[2] << " " << r[3]
     << "\n";
  os << indent << "LastFrameLevels: " << this->LastFrameLevels << "\n";
  os << indent << "LastFramePasses: " << this->LastFramePasses << "\n";
  os << indent << "LastFrameReconstructions: " << this->LastFrameReconstructions << "\n";
  os << indent << "LastFramePixelsShaded: " << this->LastFramePixelsShaded << "\n";
  os << indent << "LastFrameBytesUploaded: " << this->LastFrameBytesUploaded << "\n";
  os << indent << "LastFrameSurfaceBytesUploaded: " << this->LastFrameSurfaceBytesUploaded << "\n";
}
