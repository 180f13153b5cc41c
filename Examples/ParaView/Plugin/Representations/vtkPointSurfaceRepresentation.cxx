// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSurfaceRepresentation.h"

#include "vtkAlgebraicSplatMapper.h"
#include "vtkDirectPointMapper.h"
#include "vtkImageSpacePointMapper.h"
#include "vtkPullPushMapper.h"
#include "vtkSurfaceSplatMapper.h"

#include "vtkBoundingBox.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVRenderView.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSelection.h"

vtkStandardNewMacro(vtkPointSurfaceRepresentation);

vtkPointSurfaceRepresentation::vtkPointSurfaceRepresentation()
{
  this->SuppressLOD = true;
  this->UpdateMappers(PULL_PUSH);
  this->SetArrayIdNames(nullptr, nullptr);
}

vtkPointSurfaceRepresentation::~vtkPointSurfaceRepresentation() = default;

//------------------------------------------------------------------------------
namespace
{
/// Adds the points of visible blocks. VTK's own bounds are those of cells, of which there may be
/// none.
void AddBounds(vtkDataObject* data, vtkCompositeDataDisplayAttributes* attributes, bool visible,
  vtkBoundingBox& box)
{
  if (attributes->HasBlockVisibility(data))
  {
    visible = attributes->GetBlockVisibility(data);
  }
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    for (vtkDataObject* child : vtk::Range(tree, vtk::DataObjectTreeOptions::SkipEmptyNodes))
    {
      AddBounds(child, attributes, visible, box);
    }
    return;
  }
  auto* points = vtkPointSet::SafeDownCast(data);
  if (visible && points && points->GetNumberOfPoints() > 0)
  {
    double bounds[6];
    for (int axis = 0; axis < 3; ++axis)
    {
      points->GetPoints()->GetData()->GetFiniteRange(bounds + 2 * axis, axis);
    }
    box.AddBounds(bounds);
  }
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
  vtkBoundingBox box;
  AddBounds(data, attributes, true, box);
  double bounds[6];
  box.GetBounds(bounds);
  vtkNew<vtkMatrix4x4> matrix;
  this->Actor->GetMatrix(matrix);
  vtkPVRenderView::SetGeometryBounds(inInfo, this, bounds, matrix);
}

int vtkPointSurfaceRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  vtkDataObject* data = nullptr;
  if (request == vtkPVView::REQUEST_RENDER() && this->GetVisibility())
  {
    data = vtkPVView::GetDeliveredPiece(inInfo, this);
    this->UpdateMappers(this->ChooseSystem(data));
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
  return 1;
}

//------------------------------------------------------------------------------
namespace
{
/// Whether a point set in `data` has the arrays of vtkAlgebraicSplats.
bool HasSplats(vtkDataObject* data)
{
  for (vtkDataSet* dataSet : vtkCompositeDataSet::GetDataSets<vtkDataSet>(data))
  {
    if (dataSet->GetPointData()->HasArray("SplatCoefficients"))
    {
      return true;
    }
  }
  return false;
}

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
  return HasSplats(data) ? ALGEBRAIC_SPLATS : PULL_PUSH;
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

void vtkPointSurfaceRepresentation::UpdateMappers(int system)
{
  if (system != this->MapperSystem || this->Published != this->MapperPublished)
  {
    this->MapperSystem = system;
    this->MapperPublished = this->Published;
    this->ReplaceMapper(this->Mapper, system);
    this->ReplaceMapper(this->BackfaceMapper, system);
    this->Actor->SetMapper(this->Mapper);
    this->BackfaceActor->SetMapper(this->BackfaceMapper);
  }
  this->SetUpMapper(this->Mapper);
  this->SetUpMapper(this->BackfaceMapper);
}

void vtkPointSurfaceRepresentation::ReplaceMapper(vtkMapper*& mapper, int system)
{
  vtkSmartPointer<vtkPointSurfaceMapper> fresh = this->NewMapper(system);
  fresh->ShallowCopy(mapper);
  fresh->SetSelection(mapper->GetSelection());
  fresh->SetStatic(mapper->GetStatic());
  fresh->SetProcessIdArrayName("vtkProcessId");
  fresh->SetCompositeIdArrayName("vtkCompositeIndex");
  fresh->SetCompositeDataDisplayAttributes(this->BlockAttributes);
  if (auto* former = vtkOpenGLPolyDataMapper::SafeDownCast(mapper))
  {
    fresh->SetVBOShiftScaleMethod(former->GetVBOShiftScaleMethod());
  }
  mapper->Delete();
  mapper = fresh;
  mapper->Register(nullptr); // as the superclass deletes it
}

void vtkPointSurfaceRepresentation::SetUpMapper(vtkMapper* mapper) const
{
  auto* surface = static_cast<vtkPointSurfaceMapper*>(mapper);
  const bool named = !this->RadiusArray.empty() && this->RadiusArray != "None";
  surface->SetRadiusArray(named ? this->RadiusArray.c_str() : nullptr);
  surface->SetRadius(this->Radius);
  surface->SetRadiusScale(this->RadiusScale);
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
