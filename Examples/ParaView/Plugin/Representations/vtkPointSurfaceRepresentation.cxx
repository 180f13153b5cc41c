// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSurfaceRepresentation.h"

#include "vtkAlgebraicSplatMapper.h"
#include "vtkDirectPointMapper.h"
#include "vtkGhostPointsGenerator.h"
#include "vtkImageSpacePointMapper.h"
#include "vtkPullPushMapper.h"
#include "vtkSurfaceSplatMapper.h"

#include "vtkBoundingBox.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkLogger.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVLogger.h"
#include "vtkPVRenderView.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

vtkStandardNewMacro(vtkPointSurfaceRepresentation);

vtkPointSurfaceRepresentation::vtkPointSurfaceRepresentation()
{
  this->Ghosts->SetInputConnection(this->GeometryFilter->GetOutputPort());
  this->MultiBlockMaker->SetInputConnection(this->Ghosts->GetOutputPort());
  this->UpdateMappers(PULL_PUSH, 1.0);
  this->SetArrayIdNames(nullptr, nullptr);
}

vtkPointSurfaceRepresentation::~vtkPointSurfaceRepresentation() = default;

//------------------------------------------------------------------------------
namespace
{
template <class T>
bool Change(T& value, const T& to)
{
  const bool changed = value != to;
  value = to;
  return changed;
}
}

void vtkPointSurfaceRepresentation::SetSystem(int system)
{
  const bool wasDirect = this->System == DIRECT;
  if (!Change(this->System, std::min<int>(std::max<int>(system, AUTOMATIC), SURFACE_SPLATS)))
  {
    return;
  }
  this->Modified();
  if (wasDirect != (this->System == DIRECT))
  {
    this->MarkModified(); // ranks tell each other what Direct alone needs
  }
}

void vtkPointSurfaceRepresentation::SetPublished(bool published)
{
  if (!Change(this->Published, published))
  {
    return;
  }
  this->Modified();
  if (this->System == DIRECT)
  {
    this->MarkModified();
  }
}

void vtkPointSurfaceRepresentation::SetRadiusArray(const std::string& array)
{
  if (Change(this->RadiusArray, array))
  {
    this->MarkModified(); // ranks get the points within some radii
  }
}

void vtkPointSurfaceRepresentation::SetRadius(double radius)
{
  if (Change(this->Radius, std::max(radius, 0.0)))
  {
    this->MarkModified();
  }
}

void vtkPointSurfaceRepresentation::SetRadiusScale(double scale)
{
  if (Change(this->RadiusScale, std::min(std::max(scale, 1e-6), 1e6)))
  {
    this->MarkModified();
  }
}

bool vtkPointSurfaceRepresentation::HasRadiusArray() const
{
  return !this->RadiusArray.empty() && this->RadiusArray != "None";
}

int vtkPointSurfaceRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkNew<vtkGhostPointsGenerator> usual;
  this->Ghosts->SetRadiusArray(this->HasRadiusArray() ? this->RadiusArray : "");
  this->Ghosts->SetRadius(this->Radius);
  this->Ghosts->SetReach(usual->GetReach() * this->RadiusScale);
  this->Ghosts->SetSamplingQuantile(this->System != DIRECT ? -1.0
      : this->Published                                    ? 0.0
                                                           : usual->GetSamplingQuantile());
  constexpr vtkIdType DistantPoints = 1000000; // the price is in Parallel.md
  this->Ghosts->SetDistantPoints(this->System == DIRECT ? DistantPoints : 0);
  const int result = this->Superclass::RequestData(request, inputVector, outputVector);
  vtkVLogF(PARAVIEW_LOG_RENDERING_VERBOSITY(),
    "%s: %lld points, %lld of them copies of other ranks'", this->GetLogName().c_str(),
    static_cast<long long>(
      this->Ghosts->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT)),
    static_cast<long long>(this->Ghosts->GetNumberOfGhostPoints()));
  return result;
}

//------------------------------------------------------------------------------
namespace
{
using PointSets = std::vector<vtkPointSet*>;

/// Adds those of visible blocks.
void AddBlocks(vtkDataObject* data, vtkCompositeDataDisplayAttributes* attributes, bool visible,
  PointSets& pointSets)
{
  if (attributes->HasBlockVisibility(data))
  {
    visible = attributes->GetBlockVisibility(data);
  }
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    for (vtkDataObject* child : vtk::Range(tree, vtk::DataObjectTreeOptions::SkipEmptyNodes))
    {
      AddBlocks(child, attributes, visible, pointSets);
    }
    return;
  }
  auto* points = vtkPointSet::SafeDownCast(data);
  if (visible && points && points->GetNumberOfPoints() > 0)
  {
    pointSets.push_back(points);
  }
}

/// Calls visit(x, isCopy) for each finite point; a copy is of another rank's.
template <class Visit>
void VisitPoints(vtkPointSet* points, vtkUnsignedCharArray* types, Visit visit)
{
  for (vtkIdType id = 0; id < points->GetNumberOfPoints(); ++id)
  {
    double x[3];
    points->GetPoint(id, x);
    if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]))
    {
      visit(x, (types->GetValue(id) & vtkDataSetAttributes::DUPLICATEPOINT) != 0);
    }
  }
}

vtkUnsignedCharArray* GetTypes(vtkPointSet* points)
{
  return vtkUnsignedCharArray::SafeDownCast(
    points->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
}

/// Of the points that are no copies. VTK's own bounds are those of cells, of which there may be
/// none.
vtkBoundingBox GetOwnBox(const PointSets& pointSets)
{
  vtkBoundingBox box;
  for (vtkPointSet* points : pointSets)
  {
    if (vtkUnsignedCharArray* types = GetTypes(points))
    {
      VisitPoints(points, types,
        [&box](double x[3], bool isCopy)
        {
          if (!isCopy)
          {
            box.AddPoint(x);
          }
        });
      continue;
    }
    double bounds[6];
    for (int axis = 0; axis < 3; ++axis)
    {
      points->GetPoints()->GetData()->GetFiniteRange(bounds + 2 * axis, axis);
    }
    box.AddBounds(bounds);
  }
  return box;
}

/// The box of a rank's own points up to the middle between them and copies beyond: ParaView orders
/// ranks for blending by boxes that touch, and takes small ones that overlap amiss.
vtkBoundingBox GetRegion(const PointSets& pointSets)
{
  const vtkBoundingBox own = GetOwnBox(pointSets);
  if (!own.IsValid())
  {
    return own;
  }
  double least[3], most[3];
  own.GetMinPoint(least);
  own.GetMaxPoint(most);
  double before[3], behind[3]; // the copies' coordinates next to them
  std::fill_n(before, 3, -VTK_DOUBLE_MAX);
  std::fill_n(behind, 3, VTK_DOUBLE_MAX);
  auto addCopy = [&](const double x[3], bool isCopy)
  {
    for (int axis = 0; isCopy && axis < 3; ++axis)
    {
      if (x[axis] < least[axis])
      {
        before[axis] = std::max(before[axis], x[axis]);
      }
      else if (x[axis] > most[axis])
      {
        behind[axis] = std::min(behind[axis], x[axis]);
      }
    }
  };
  for (vtkPointSet* points : pointSets)
  {
    if (vtkUnsignedCharArray* types = GetTypes(points))
    {
      VisitPoints(points, types, addCopy);
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    least[axis] = before[axis] > -VTK_DOUBLE_MAX ? 0.5 * (before[axis] + least[axis]) : least[axis];
    most[axis] = behind[axis] < VTK_DOUBLE_MAX ? 0.5 * (behind[axis] + most[axis]) : most[axis];
  }
  return vtkBoundingBox(least[0], most[0], least[1], most[1], least[2], most[2]);
}

vtkBoundingBox Transform(const vtkBoundingBox& box, vtkMatrix4x4* matrix)
{
  vtkBoundingBox transformed;
  for (int corner = 0; box.IsValid() && corner < 8; ++corner)
  {
    double x[4] = { 0.0, 0.0, 0.0, 1.0 };
    box.GetCorner(corner, x);
    matrix->MultiplyPoint(x, x);
    transformed.AddPoint(x);
  }
  return transformed;
}
}

void vtkPointSurfaceRepresentation::TellBounds(vtkInformation* inInfo)
{
  vtkDataObject* data = this->GetRenderedDataObject(0);
  if (!data)
  {
    return;
  }
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  this->PopulateBlockAttributes(attributes, data);
  PointSets pointSets;
  AddBlocks(data, attributes, true, pointSets);
  vtkNew<vtkMatrix4x4> matrix;
  this->Actor->GetMatrix(matrix);
  double bounds[6];
  Transform(GetRegion(pointSets), matrix).GetBounds(bounds);
  vtkPVRenderView::SetGeometryBounds(inInfo, this, bounds);
  // Where pictures are blended, in the order of ranks' regions, ParaView would give each rank the
  // cells of another region, and points that are in no cells to none. It takes a region's bounds
  // here, but goes by those above, as they are before a matrix.
  vtkPVRenderView::SetOrderedCompositingConfiguration(
    inInfo, this, vtkPVRenderView::USE_BOUNDS_FOR_REDISTRIBUTION, bounds);
}

//------------------------------------------------------------------------------
namespace
{
/// One point of 2^level stands for all of them while the camera moves.
int GetLevel(vtkInformation* inInfo)
{
  auto* view = vtkPVRenderView::SafeDownCast(inInfo->Get(vtkPVView::VIEW()));
  return view ? static_cast<int>(std::lround(8.0 * (1.0 - view->GetLODResolution()))) : 0;
}

/// Whether a point is one of those of 2^level that are drawn: by chance, so that no pattern in
/// their order comes through, but by its place alone, so that ranks agree on it.
bool IsKept(const double x[3], int level)
{
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &x[axis], sizeof bits);
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio
    hash ^= hash >> 29;
  }
  return (hash * 0x9e3779b97f4a7c15u) >> (64 - level) == 0;
}

vtkSmartPointer<vtkPolyData> Thin(vtkPolyData* points, int level)
{
  auto fewer = vtkSmartPointer<vtkPolyData>::New();
  if (level == 0)
  {
    fewer->ShallowCopy(points);
    return fewer;
  }
  vtkNew<vtkIdList> kept;
  for (vtkIdType id = 0; id < points->GetNumberOfPoints(); ++id)
  {
    double x[3];
    points->GetPoint(id, x);
    if (IsKept(x, level))
    {
      kept->InsertNextId(id);
    }
  }
  vtkNew<vtkPoints> places;
  if (points->GetPoints())
  {
    places->SetDataType(points->GetPoints()->GetDataType());
    points->GetPoints()->GetPoints(kept, places);
  }
  fewer->SetPoints(places);
  fewer->GetPointData()->CopyAllOn();
  fewer->GetPointData()->CopyAllocate(points->GetPointData(), kept->GetNumberOfIds());
  fewer->GetPointData()->CopyData(points->GetPointData(), kept);
  fewer->GetFieldData()->ShallowCopy(points->GetFieldData());
  return fewer;
}

double GetGrowth(int level)
{
  return std::sqrt(static_cast<double>(1 << level));
}

/// Points that are chosen at random leave larger gaps than even ones, which their radii, given or
/// estimated, may just have closed.
double GetGapGrowth(int level)
{
  return level > 0 ? 1.15 : 1.0;
}

double GetGivenGrowth(int level)
{
  return GetGapGrowth(level) * GetGrowth(level);
}

/// Radii that are estimated of fewer points grow by themselves; what vtkGhostPointsGenerator has
/// told of them, and of the sampling distance, has to follow. The largest radius is that of the
/// largest gap, which chance makes up to 1.45 times as large among even points.
void GrowWhole(vtkPolyData* points, int level)
{
  constexpr double LargestGap = 1.5;
  vtkDataArray* told = points->GetFieldData()->GetArray("vtkWholeCloud");
  if (!told || level == 0)
  {
    return;
  }
  vtkNew<vtkDoubleArray> whole;
  whole->DeepCopy(told);
  whole->SetValue(6, GetGrowth(level) * whole->GetValue(6)); // mean
  whole->SetValue(7, LargestGap * GetGrowth(level) * whole->GetValue(7));
  whole->SetValue(8, GetGivenGrowth(level) * whole->GetValue(8)); // sampling distance
  points->GetFieldData()->AddArray(whole);
}

bool HasArray(vtkDataObject* data, const char* name)
{
  for (vtkDataSet* dataSet : vtkCompositeDataSet::GetDataSets<vtkDataSet>(data))
  {
    if (dataSet->GetPointData()->HasArray(name))
    {
      return true;
    }
  }
  return false;
}
}

bool vtkPointSurfaceRepresentation::HasRadii(vtkDataObject* data, int system) const
{
  const bool usesArrays = system != DIRECT;
  return this->Radius > 0.0 || (usesArrays && (this->HasRadiusArray() || HasArray(data, "radius")));
}

void vtkPointSurfaceRepresentation::UpdateLOD(vtkInformation* inInfo)
{
  auto* data = vtkDataObjectTree::SafeDownCast(vtkPVView::GetPiece(inInfo, this));
  if (!data || this->SuppressLOD)
  {
    return;
  }
  auto thinned = vtkSmartPointer<vtkDataObjectTree>::Take(data->NewInstance());
  thinned->CopyStructure(data);
  const int system = this->ChooseSystem(data);
  const bool thins = system != ALGEBRAIC_SPLATS;
  const int level = GetLevel(inInfo);
  auto leaf = vtkSmartPointer<vtkDataObjectTreeIterator>::Take(data->NewTreeIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    vtkDataObject* object = leaf->GetCurrentDataObject();
    auto* points = vtkPolyData::SafeDownCast(object);
    if (!thins || !points)
    {
      thinned->SetDataSetFrom(leaf, object);
      continue;
    }
    const vtkSmartPointer<vtkPolyData> fewer = Thin(points, level);
    if (!this->HasRadii(data, system))
    {
      GrowWhole(fewer, level);
    }
    thinned->SetDataSetFrom(leaf, fewer);
  }
  vtkPVView::SetPieceLOD(inInfo, this, thinned);
}

//------------------------------------------------------------------------------
int vtkPointSurfaceRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (request == vtkPVView::REQUEST_UPDATE_LOD()) // for which the superclass decimates meshes
  {
    if (this->GetVisibility())
    {
      this->UpdateLOD(inInfo);
    }
    return this->GetVisibility();
  }
  vtkDataObject* data = nullptr;
  if (request == vtkPVView::REQUEST_RENDER() && this->GetVisibility())
  {
    data = vtkPVView::GetDeliveredPiece(inInfo, this);
    const int system = this->ChooseSystem(data);
    const int level = GetLevel(inInfo);
    this->UpdateMappers(system,
      system == ALGEBRAIC_SPLATS       ? 1.0
        : this->HasRadii(data, system) ? GetGivenGrowth(level)
        : system == DIRECT             ? 1.0
                                       : GetGapGrowth(level));
  }
  // The superclass tells the blocks' attributes only to mappers of VTK's own, and then takes them
  // for told.
  const bool attributesChanged =
    data && (this->BlockAttrChanged || this->BlockAttributeTime < data->GetMTime());
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    this->TellBounds(inInfo);
  }
  if (attributesChanged)
  {
    this->PopulateBlockAttributes(this->BlockAttributes, data);
  }
  if (data)
  {
    // Of those that draw together each may be without points, and a client whose server draws is:
    // nothing that mappers should warn of.
    auto* view = vtkPVRenderView::SafeDownCast(inInfo->Get(vtkPVView::VIEW()));
    const bool draws = !view || !view->GetUseDistributedRenderingForRender() ||
      data->GetNumberOfElements(vtkDataObject::POINT) > 0;
    this->Actor->SetVisibility(draws);
    this->BackfaceActor->SetVisibility(draws && this->BackfaceActor->GetVisibility());
  }
  if (data && this->Actor->GetEnableLOD())
  {
    this->PopulateBlockAttributes(
      this->LODBlockAttributes, vtkPVView::GetDeliveredPieceLOD(inInfo, this));
  }
  return 1;
}

//------------------------------------------------------------------------------
namespace
{
template <class Mapper>
vtkSmartPointer<vtkPointSurfaceMapper> MakeMapper(bool published)
{
  auto mapper = vtkSmartPointer<Mapper>::New();
  if (published)
  {
    mapper->SetToPublished();
  }
  return mapper;
}
}

int vtkPointSurfaceRepresentation::ChooseSystem(vtkDataObject* data) const
{
  if (this->System != AUTOMATIC)
  {
    return this->System;
  }
  return HasArray(data, "SplatCoefficients") ? ALGEBRAIC_SPLATS : PULL_PUSH;
}

vtkSmartPointer<vtkPointSurfaceMapper> vtkPointSurfaceRepresentation::NewMapper(int system) const
{
  switch (system)
  {
    case IMAGE_SPACE:
      return MakeMapper<vtkImageSpacePointMapper>(this->Published);
    case DIRECT:
      return MakeMapper<vtkDirectPointMapper>(this->Published);
    case ALGEBRAIC_SPLATS:
      return MakeMapper<vtkAlgebraicSplatMapper>(this->Published);
    case SURFACE_SPLATS: // of no one paper
      return vtkSmartPointer<vtkSurfaceSplatMapper>::New();
    default:
      return MakeMapper<vtkPullPushMapper>(this->Published);
  }
}

void vtkPointSurfaceRepresentation::UpdateMappers(int system, double growth)
{
  if (system != this->MapperSystem || this->Published != this->MapperPublished)
  {
    this->MapperSystem = system;
    this->MapperPublished = this->Published;
    this->ReplaceMapper(this->Mapper, system, this->BlockAttributes);
    this->ReplaceMapper(this->BackfaceMapper, system, this->BlockAttributes);
    this->ReplaceMapper(this->LODMapper, system, this->LODBlockAttributes);
    this->ReplaceMapper(this->LODBackfaceMapper, system, this->LODBlockAttributes);
    this->Actor->SetMapper(this->Mapper);
    this->Actor->SetLODMapper(this->LODMapper);
    this->BackfaceActor->SetMapper(this->BackfaceMapper);
    this->BackfaceActor->SetLODMapper(this->LODBackfaceMapper);
  }
  this->SetUpMapper(this->Mapper, 1.0);
  this->SetUpMapper(this->BackfaceMapper, 1.0);
  this->SetUpMapper(this->LODMapper, growth);
  this->SetUpMapper(this->LODBackfaceMapper, growth);
}

void vtkPointSurfaceRepresentation::ReplaceMapper(
  vtkMapper*& mapper, int system, vtkCompositeDataDisplayAttributes* blocks)
{
  vtkSmartPointer<vtkPointSurfaceMapper> fresh = this->NewMapper(system);
  fresh->ShallowCopy(mapper);
  fresh->SetSelection(mapper->GetSelection());
  fresh->SetStatic(mapper->GetStatic());
  fresh->SetProcessIdArrayName("vtkProcessId");
  fresh->SetCompositeIdArrayName("vtkCompositeIndex");
  fresh->SetCompositeDataDisplayAttributes(blocks);
  if (auto* former = vtkOpenGLPolyDataMapper::SafeDownCast(mapper))
  {
    fresh->SetVBOShiftScaleMethod(former->GetVBOShiftScaleMethod());
  }
  mapper->Delete();
  mapper = fresh;
  mapper->Register(nullptr); // as the superclass deletes it
}

void vtkPointSurfaceRepresentation::SetUpMapper(vtkMapper* mapper, double growth) const
{
  auto* surface = static_cast<vtkPointSurfaceMapper*>(mapper);
  surface->SetRadiusArray(this->HasRadiusArray() ? this->RadiusArray.c_str() : nullptr);
  surface->SetRadius(this->Radius);
  surface->SetRadiusScale(growth * this->RadiusScale);
  surface->SetSupersampling(this->Supersampling);
  surface->SetBackend(this->Backend);
  if (this->Published)
  {
    return;
  }
  if (auto* imageSpace = vtkImageSpacePointMapper::SafeDownCast(mapper))
  {
    imageSpace->SetSmoothingIterations(this->SmoothingIterations);
    imageSpace->SetAntialiasOutline(this->AntialiasOutline);
  }
  else if (auto* direct = vtkDirectPointMapper::SafeDownCast(mapper))
  {
    direct->SetDepthTolerance(this->DepthTolerance);
  }
}

//------------------------------------------------------------------------------
void vtkPointSurfaceRepresentation::SetArrayIdNames(const char* pointArray, const char* cellArray)
{
  auto* mapper = static_cast<vtkPointSurfaceMapper*>(this->Mapper);
  mapper->SetPointIdArrayName(pointArray ? pointArray : "vtkOriginalPointIds");
  mapper->SetCellIdArrayName(cellArray ? cellArray : "vtkOriginalCellIds");
}

void vtkPointSurfaceRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "System: " << this->System << "\n";
  os << indent << "Published: " << this->Published << "\n";
  os << indent << "RadiusArray: " << this->RadiusArray << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "RadiusScale: " << this->RadiusScale << "\n";
  os << indent << "Supersampling: " << this->Supersampling << "\n";
  os << indent << "Backend: " << this->Backend << "\n";
  os << indent << "SmoothingIterations: " << this->SmoothingIterations << "\n";
  os << indent << "AntialiasOutline: " << this->AntialiasOutline << "\n";
  os << indent << "DepthTolerance: " << this->DepthTolerance << "\n";
}
