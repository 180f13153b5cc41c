// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDrawablePoints.h"

#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPointNormals.h"
#include "vtkPointSpacing.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProgressRelay.h"
#include "vtkSamplingDistance.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace
{
bool IsFinite(const double* x)
{
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

/// True for a value that can be a radius.
bool IsRadius(double r)
{
  return std::isfinite(r) && r > 0.0;
}

std::string Name(vtkDataArray* array)
{
  return array->GetName() ? array->GetName() : "(no name)";
}

/// The array of three float components that the shaders want; a copy only if it is not one yet.
vtkSmartPointer<vtkFloatArray> AsFloats(vtkDataArray* array)
{
  vtkSmartPointer<vtkFloatArray> floats = vtkFloatArray::SafeDownCast(array);
  if (!floats)
  {
    floats = vtkSmartPointer<vtkFloatArray>::New();
    floats->DeepCopy(array);
  }
  return floats;
}

/// The point data that a filter makes of a cloud, with its progress reported as the caller's.
vtkPointData* UpdateFor(
  vtkAlgorithm* caller, vtkAlgorithm* filter, vtkPolyData* cloud, const char* what)
{
  vtkNew<vtkProgressRelay> relay;
  relay->Set(caller, 0.0, 1.0);
  filter->AddObserver(vtkCommand::ProgressEvent, relay);
  filter->SetInputDataObject(cloud);
  caller->SetProgressText(what);
  filter->Update();
  caller->SetProgressText(nullptr);
  return vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))->GetPointData();
}

vtkSmartPointer<vtkFloatArray> CopyOf(vtkFloatArray* array)
{
  auto copy = vtkSmartPointer<vtkFloatArray>::New();
  copy->DeepCopy(array);
  return copy;
}
}

std::vector<std::string> vtkDrawablePoints::Build(vtkPolyData* input,
  const std::vector<vtkIdType>& blocks, const Needs& needs, const RadiusSource& source,
  vtkAlgorithm* caller)
{
  this->Remarks.clear();
  this->Aborted = false;
  caller->SetAbortExecute(0); // as pipelines do before a filter runs
  this->BuildTime.Modified();
  this->Cloud = vtkSmartPointer<vtkPolyData>::New();
  this->Cloud->GetPointData()->ShallowCopy(input->GetPointData());
  this->SelectPoints(input);
  this->Diagonal = source.Diagonal > 0.0 || this->NumberOfDrawnPoints == 0
    ? source.Diagonal
    : vtkBoundingBox(this->Bounds).GetDiagonalLength();
  this->Radii = nullptr;
  this->LargestRadius = this->MeanRadius = 0.0;
  if (!needs.Normals)
  {
    this->Cloud->GetPointData()->SetNormals(nullptr);
  }
  else if (this->NumberOfDrawnPoints > 0)
  {
    this->SelectNormals(input, caller);
  }
  if (needs.Radii && this->NumberOfDrawnPoints > 0)
  {
    this->SelectRadii(input, source, caller);
  }
  if (needs.SamplingDistance && this->NumberOfDrawnPoints > 0)
  {
    this->SelectSamplingDistance(source, caller);
  }
  if (needs.SpatialOrder && this->NumberOfDrawnPoints > 0)
  {
    this->OrderPoints(blocks, caller);
  }
  return this->Remarks;
}

//------------------------------------------------------------------------------
void vtkDrawablePoints::SelectPoints(vtkPolyData* input)
{
  vtkPoints* points = input->GetPoints();
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
  vtkUnsignedCharArray* ghosts = vtkUnsignedCharArray::SafeDownCast(
    input->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));

  this->InputPoints = points;
  if (ghosts && ghosts->GetNumberOfTuples() != count)
  {
    std::ostringstream line;
    line << "Array '" << Name(ghosts) << "' has " << ghosts->GetNumberOfTuples() << " values for "
         << count << " points; no point is hidden. Give one value for each point.";
    this->Say(line.str());
    ghosts = nullptr;
  }
  std::vector<unsigned int> ids;
  vtkMath::UninitializeBounds(this->Bounds);
  double lower[3] = { VTK_DOUBLE_MAX, VTK_DOUBLE_MAX, VTK_DOUBLE_MAX };
  double upper[3] = { -VTK_DOUBLE_MAX, -VTK_DOUBLE_MAX, -VTK_DOUBLE_MAX };
  std::vector<vtkIdType> faulty;
  vtkIdType drawn = 0;
  this->Duplicates.clear();
  for (vtkIdType id = 0; id < count; ++id)
  {
    double x[3];
    points->GetPoint(id, x);
    const bool finite = IsFinite(x);
    if (!finite)
    {
      faulty.push_back(id);
    }
    if (ghosts && (ghosts->GetValue(id) & vtkDataSetAttributes::DUPLICATEPOINT))
    {
      this->Duplicates.resize(count);
      this->Duplicates[id] = 255;
    }
    const bool hidden = ghosts && (ghosts->GetValue(id) & vtkDataSetAttributes::HIDDENPOINT);
    if (!finite || hidden)
    {
      if (ids.empty())
      {
        // the first point to leave out: from here on a list is needed
        ids.resize(drawn);
        for (vtkIdType i = 0; i < drawn; ++i)
        {
          ids[i] = static_cast<unsigned int>(i);
        }
        ids.reserve(count);
      }
      continue;
    }
    if (drawn < id)
    {
      ids.push_back(static_cast<unsigned int>(id));
    }
    ++drawn;
    for (int k = 0; k < 3; ++k)
    {
      lower[k] = std::min(lower[k], x[k]);
      upper[k] = std::max(upper[k], x[k]);
    }
  }
  this->NumberOfDrawnPoints = drawn;
  if (ids != this->DrawnIds)
  {
    this->DrawnIds.swap(ids);
    this->DrawnIdsTime.Modified();
  }
  if (drawn == 0)
  {
    this->Cloud->SetPoints(vtkNew<vtkPoints>());
    this->Cloud->GetPointData()->Initialize();
    this->Say(count == 0 ? "The input has no points: nothing is drawn."
        : static_cast<vtkIdType>(faulty.size()) < count
        ? "All of the input's points are hidden (array 'vtkGhostType') or have coordinates that "
          "are "
          "not finite: nothing is drawn."
        : "None of the input's points has finite coordinates: nothing is drawn.");
    return;
  }
  for (int k = 0; k < 3; ++k)
  {
    this->Bounds[2 * k] = lower[k];
    this->Bounds[2 * k + 1] = upper[k];
  }
  if (faulty.empty())
  {
    this->Cloud->SetPoints(points);
    return;
  }

  // A coordinate that is not finite would spoil the shift and scale that VTK makes of the array.
  vtkNew<vtkPoints> repaired;
  repaired->DeepCopy(points);
  for (vtkIdType id : faulty)
  {
    repaired->SetPoint(id, lower);
  }
  if (this->KeptCoordinates.Keep(repaired->GetData()) == repaired->GetData())
  {
    this->RepairedPoints = repaired; // other values than last time
  }
  this->Cloud->SetPoints(this->RepairedPoints);
  double x[3];
  points->GetPoint(faulty.front(), x);
  std::ostringstream line;
  line << faulty.size() << " of " << count
       << " points have coordinates that are not finite (the first is point " << faulty.front()
       << ": " << x[0] << ", " << x[1] << ", " << x[2]
       << "); they are not drawn. Remove them from the input to be rid of this warning.";
  this->Say(line.str());
}

//------------------------------------------------------------------------------
void vtkDrawablePoints::SelectNormals(vtkPolyData* input, vtkAlgorithm* caller)
{
  vtkDataArray* given = input->GetPointData()->GetNormals();
  if (given && given->GetNumberOfTuples() != input->GetNumberOfPoints())
  {
    std::ostringstream line;
    line << "Array '" << Name(given) << "' has " << given->GetNumberOfTuples() << " normals for "
         << input->GetNumberOfPoints()
         << " points; normals are estimated instead. Give one normal for each point.";
    this->Say(line.str());
    given = nullptr;
  }
  if (!given)
  {
    this->EstimateNormals(caller);
    return;
  }

  vtkSmartPointer<vtkFloatArray> normals = AsFloats(given);
  vtkIdType zero = 0;
  vtkIdType faulty = 0;
  vtkIdType first = -1;
  vtkSmartPointer<vtkFloatArray> repaired;
  for (vtkIdType id = 0; id < normals->GetNumberOfTuples(); ++id)
  {
    double n[3];
    normals->GetTuple(id, n);
    const bool finite = IsFinite(n);
    if (finite && (n[0] != 0.0 || n[1] != 0.0 || n[2] != 0.0))
    {
      continue;
    }
    first = first < 0 ? id : first;
    ++(finite ? zero : faulty);
    if (!finite)
    {
      if (!repaired)
      {
        repaired = CopyOf(normals);
      }
      repaired->SetTuple3(id, 0.0, 0.0, 0.0);
    }
  }
  if (first >= 0)
  {
    std::ostringstream line;
    line << "Array '" << Name(given) << "' has " << zero << " normals that are zero and " << faulty
         << " that are not finite (the first is of point " << first
         << "); those points are drawn facing the viewer. vtkPointNormals estimates normals from "
            "the points.";
    this->Say(line.str());
  }
  this->Cloud->GetPointData()->SetNormals(this->KeptNormals.Keep(repaired ? repaired : normals));
}

//------------------------------------------------------------------------------
void vtkDrawablePoints::SelectRadii(
  vtkPolyData* input, const RadiusSource& source, vtkAlgorithm* caller)
{
  const vtkIdType count = input->GetNumberOfPoints();
  vtkPointData* pointData = input->GetPointData();
  vtkDataArray* array = nullptr;
  if (!source.Array.empty())
  {
    array = pointData->GetArray(source.Array.c_str());
    if (!array)
    {
      this->Say("There is no point array '" + source.Array +
        "' to take radii from; another source is used. Name an array of the input "
        "(SetRadiusArray).");
    }
  }
  if (!array && source.Radius > 0.0)
  {
    const double diagonal = this->GetDiagonal();
    this->LargestRadius = this->MeanRadius = source.Radius;
    if (diagonal > 0.0 && source.Radius > diagonal)
    {
      std::ostringstream line;
      line << "The radius " << source.Radius << " is larger than the whole cloud; its diagonal, "
           << diagonal << ", is taken. Are radius and coordinates in the same units?";
      this->Say(line.str());
      this->LargestRadius = this->MeanRadius = diagonal;
    }
    return;
  }
  if (!array)
  {
    array = pointData->GetArray("radius");
  }
  if (array && (array->GetNumberOfTuples() != count || array->GetNumberOfComponents() != 1))
  {
    std::ostringstream line;
    line << "Array '" << Name(array) << "' has " << array->GetNumberOfTuples() << " values of "
         << array->GetNumberOfComponents() << " components for " << count
         << " points; radii are estimated instead. Give one value for each point.";
    this->Say(line.str());
    array = nullptr;
  }
  if (array)
  {
    this->RepairRadii(array);
  }
  if (!this->Radii)
  {
    this->EstimateRadii(caller);
  }
}

void vtkDrawablePoints::RepairRadii(vtkDataArray* array)
{
  // No radius needs to be larger than the cloud; a larger one would overflow in the shaders.
  const double diagonal = this->GetDiagonal();
  const double limit = diagonal > 0.0 ? diagonal : VTK_FLOAT_MAX;

  const vtkIdType count = array->GetNumberOfTuples();
  double sum = 0.0;
  vtkIdType good = 0;
  vtkIdType huge = 0;
  vtkIdType firstFaulty = -1;
  vtkIdType firstHuge = -1;
  this->LargestRadius = 0.0;
  for (vtkIdType id = 0; id < count; ++id)
  {
    const double r = array->GetComponent(id, 0);
    if (!IsRadius(r))
    {
      firstFaulty = firstFaulty < 0 ? id : firstFaulty;
      continue;
    }
    if (r > limit)
    {
      firstHuge = firstHuge < 0 ? id : firstHuge;
      ++huge;
    }
    ++good;
    sum += std::min(r, limit);
    this->LargestRadius = std::max(this->LargestRadius, std::min(r, limit));
  }
  const double mean = good > 0 ? sum / good : 0.0;
  this->MeanRadius = mean;
  if (firstFaulty >= 0)
  {
    std::ostringstream line;
    line << count - good << " of " << count << " radii in array '" << Name(array)
         << "' are not positive and finite (the first is " << array->GetComponent(firstFaulty, 0)
         << " of point " << firstFaulty << "); ";
    if (good > 0)
    {
      line << "those points get the mean of the others, " << mean << ".";
    }
    else
    {
      line << "radii are estimated instead.";
    }
    line << " vtkPointSpacing makes radii from the points.";
    this->Say(line.str());
  }
  if (firstHuge >= 0)
  {
    std::ostringstream line;
    line << huge << " of " << count << " radii in array '" << Name(array)
         << "' are larger than the whole cloud (the first is " << array->GetComponent(firstHuge, 0)
         << " of point " << firstHuge << "); they are taken as its diagonal, " << limit
         << ". Are radii and coordinates in the same units?";
    this->Say(line.str());
  }
  if (good == 0)
  {
    return;
  }
  this->Radii = AsFloats(array);
  if (firstFaulty >= 0 || firstHuge >= 0)
  {
    this->Radii = CopyOf(this->Radii);
    for (vtkIdType id = 0; id < count; ++id)
    {
      const double r = array->GetComponent(id, 0);
      this->Radii->SetValue(id, static_cast<float>(IsRadius(r) ? std::min(r, limit) : mean));
    }
  }
  this->Radii = static_cast<vtkFloatArray*>(this->KeptRadii.Keep(this->Radii));
}

bool vtkDrawablePoints::Estimate::IsOf(vtkPoints* points) const
{
  return this->Array && this->Points == points && this->Time == points->GetMTime();
}

void vtkDrawablePoints::Estimate::Set(vtkPoints* points, vtkFloatArray* array)
{
  this->Points = points;
  this->Time = points->GetMTime();
  this->Array = array;
}

void vtkDrawablePoints::EstimateNormals(vtkAlgorithm* caller)
{
  if (this->EstimatedNormals.IsOf(this->InputPoints))
  {
    this->Cloud->GetPointData()->SetNormals(this->EstimatedNormals.Array);
    return;
  }
  vtkNew<vtkPointNormals> estimate;
  vtkPointData* output = UpdateFor(caller, estimate, this->Cloud, "Estimating normals");
  auto* normals = vtkFloatArray::SafeDownCast(output->GetNormals());
  if (!normals)
  {
    this->Aborted = true;
    vtkNew<vtkFloatArray> facing;
    facing->SetName("Normals");
    facing->SetNumberOfComponents(3);
    facing->SetNumberOfTuples(this->Cloud->GetNumberOfPoints());
    facing->Fill(0.0);
    this->Cloud->GetPointData()->SetNormals(facing);
    this->Say("The estimate of normals was aborted; points are drawn facing the viewer.");
    return;
  }
  this->EstimatedNormals.Set(this->InputPoints, normals);
  this->Cloud->GetPointData()->SetNormals(normals);
}

void vtkDrawablePoints::EstimateRadii(vtkAlgorithm* caller)
{
  if (this->EstimatedRadii.IsOf(this->InputPoints))
  {
    this->Radii = this->EstimatedRadii.Array;
  }
  else
  {
    vtkNew<vtkPointSpacing> estimate;
    vtkPointData* output = UpdateFor(caller, estimate, this->Cloud, "Estimating radii");
    this->Radii = vtkFloatArray::SafeDownCast(output->GetArray("radius"));
    this->EstimatedRadii.Set(this->InputPoints, this->Radii);
  }
  this->LargestRadius = this->MeanRadius = 0.0;
  if (!this->Radii)
  {
    this->Aborted = true;
    this->Say("The estimate of radii was aborted; nothing is drawn. Set a radius.");
    return;
  }
  this->LargestRadius = this->Radii->GetRange()[1];
  for (vtkIdType id = 0; id < this->Radii->GetNumberOfTuples(); ++id)
  {
    this->MeanRadius += this->Radii->GetValue(id) / this->Radii->GetNumberOfTuples();
  }
}

void vtkDrawablePoints::SelectSamplingDistance(const RadiusSource& source, vtkAlgorithm* caller)
{
  double distance = source.Radius > 0.0 ? source.Radius : source.SamplingDistance;
  if (!(distance > 0.0))
  {
    caller->SetProgressText("Estimating the sampling distance");
    distance = vtkSamplingDistance(
      this->Cloud->GetPoints(), this->DrawnIds, source.SamplingQuantile, caller);
    caller->SetProgressText(nullptr);
    if (caller->GetAbortExecute())
    {
      this->Aborted = true;
      this->Say("The estimate of the sampling distance was aborted; single pixels are drawn. Set a "
                "radius.");
    }
  }
  this->LargestRadius = this->MeanRadius = distance;
}

//------------------------------------------------------------------------------
void vtkDrawablePoints::OrderPoints(const std::vector<vtkIdType>& blocks, vtkAlgorithm* caller)
{
  std::vector<vtkIdType> starts = blocks;
  if (!this->DrawnIds.empty())
  {
    for (vtkIdType& start : starts)
    {
      start = std::lower_bound(
                this->DrawnIds.begin(), this->DrawnIds.end(), static_cast<unsigned int>(start)) -
        this->DrawnIds.begin();
    }
  }
  vtkPoints* points = this->Cloud->GetPoints();
  this->Order.Update(points, this->DrawnIds, starts, caller);
  auto ordered = vtkSmartPointer<vtkPolyData>::New();
  vtkDataArray* coordinates = this->Arrange("coordinates", points->GetData());
  if (!this->OrderedPoints || this->OrderedPoints->GetData() != coordinates)
  {
    this->OrderedPoints = vtkSmartPointer<vtkPoints>::New();
    this->OrderedPoints->SetData(coordinates); // which makes the array a modified one
  }
  ordered->SetPoints(this->OrderedPoints);
  ordered->GetPointData()->SetNormals(
    this->Arrange("normals", this->Cloud->GetPointData()->GetNormals()));
  this->Cloud = ordered;
  this->Radii = static_cast<vtkFloatArray*>(this->Arrange("radii", this->Radii));
}

vtkDataArray* vtkDrawablePoints::Arrange(const std::string& use, vtkDataArray* array)
{
  if (!array)
  {
    this->ArrangedArrays.erase(use);
    return nullptr;
  }
  Arranged& arranged = this->ArrangedArrays[use];
  if (arranged.Source != array || arranged.SourceTime != array->GetMTime() ||
    arranged.OrderTime != this->Order.GetTime())
  {
    arranged.Source = array;
    arranged.SourceTime = array->GetMTime();
    arranged.OrderTime = this->Order.GetTime();
    arranged.Array = this->Order.Arrange(array);
  }
  return arranged.Array;
}
