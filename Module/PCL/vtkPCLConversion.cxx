// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPCLConversion.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkTypeTraits.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace
{
using Field = pcl::PCLPointField;

// Points in memory; of some of them, where ids are given.
struct Rows
{
  const unsigned char* Data = nullptr;
  std::size_t Step = 0;
  vtkIdType Count = 0;
  const vtkIdType* Ids = nullptr;

  const unsigned char* Point(vtkIdType row) const
  {
    return this->Data + this->Step * static_cast<std::size_t>(this->Ids ? this->Ids[row] : row);
  }
};

// Calls the function with a value of the type that a field's number stands for.
template <typename Function>
auto WithType(const Field& field, Function function)
{
  switch (field.datatype)
  {
    case Field::INT8:
      return function(std::int8_t());
    case Field::BOOL: // a byte, as VTK has no such array
    case Field::UINT8:
      return function(std::uint8_t());
    case Field::INT16:
      return function(std::int16_t());
    case Field::UINT16:
      return function(std::uint16_t());
    case Field::INT32:
      return function(std::int32_t());
    case Field::UINT32:
      return function(std::uint32_t());
    case Field::INT64:
      return function(std::int64_t());
    case Field::UINT64:
      return function(std::uint64_t());
    case Field::FLOAT32:
      return function(float());
    case Field::FLOAT64:
      return function(double());
  }
  throw std::invalid_argument("the field " + field.name + " has an unknown type");
}

template <typename T>
T Load(const unsigned char* bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

// Values of N (0: of any number of) neighbouring components of each point.
template <typename T, int N>
void CopyComponents(const Rows& rows, std::size_t offset, int components, T* values)
{
  const std::size_t size = sizeof(T) * (N > 0 ? N : components);
  vtkSMPTools::For(0, rows.Count,
    [&](vtkIdType begin, vtkIdType end)
    {
      auto* to = reinterpret_cast<unsigned char*>(values) + size * begin;
      if (!rows.Ids && rows.Step == size)
      {
        std::memcpy(to, rows.Point(begin), size * (end - begin));
        return;
      }
      for (vtkIdType row = begin; row < end; ++row, to += size)
      {
        std::memcpy(to, rows.Point(row) + offset, N > 0 ? N * sizeof(T) : size);
      }
    });
}

// An array of components that lie side by side from the offset on.
template <typename T>
vtkSmartPointer<vtkDataArray> Gather(const Rows& rows, std::size_t offset, int components)
{
  vtkSmartPointer<vtkDataArray> array;
  array.TakeReference(vtkDataArray::CreateDataArray(vtkTypeTraits<T>::VTKTypeID()));
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(rows.Count);
  auto* values = static_cast<T*>(array->GetVoidPointer(0));
  switch (components)
  {
    case 1:
      CopyComponents<T, 1>(rows, offset, components, values);
      break;
    case 3:
      CopyComponents<T, 3>(rows, offset, components, values);
      break;
    default:
      CopyComponents<T, 0>(rows, offset, components, values);
  }
  return array;
}

double LoadAsDouble(const unsigned char* point, const Field& field)
{
  return WithType(field,
    [&](auto type) { return static_cast<double>(Load<decltype(type)>(point + field.offset)); });
}

// Three fields of one component each as the components of an array: of float or double where all
// three are, else of double.
vtkSmartPointer<vtkDataArray> GatherVector(const Rows& rows, const std::array<Field, 3>& fields)
{
  const auto type = fields[0].datatype;
  const std::size_t size = type == Field::FLOAT32 ? sizeof(float) : sizeof(double);
  if ((type == Field::FLOAT32 || type == Field::FLOAT64) && fields[1].datatype == type &&
    fields[2].datatype == type && fields[1].offset == fields[0].offset + size &&
    fields[2].offset == fields[1].offset + size)
  {
    return type == Field::FLOAT32 ? Gather<float>(rows, fields[0].offset, 3)
                                  : Gather<double>(rows, fields[0].offset, 3);
  }
  const bool single = std::all_of(fields.begin(), fields.end(),
    [](const Field& field) { return field.datatype == Field::FLOAT32; });
  vtkSmartPointer<vtkDataArray> array;
  array.TakeReference(vtkDataArray::CreateDataArray(single ? VTK_FLOAT : VTK_DOUBLE));
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(rows.Count);
  for (vtkIdType row = 0; row < rows.Count; ++row)
  {
    for (int i = 0; i < 3; ++i)
    {
      array->SetComponent(row, i, LoadAsDouble(rows.Point(row), fields[i]));
    }
  }
  return array;
}

// Of 4 components (red, green, blue, opacity), or of 3. PCL keeps them in the bytes b, g, r, a.
vtkSmartPointer<vtkUnsignedCharArray> GatherColors(
  const Rows& rows, std::size_t offset, int components)
{
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetName(components == 4 ? "RGBA" : "RGB");
  colors->SetNumberOfComponents(components);
  colors->SetNumberOfTuples(rows.Count);
  vtkSMPTools::For(0, rows.Count,
    [&](vtkIdType begin, vtkIdType end)
    {
      unsigned char* to = colors->GetPointer(components * begin);
      for (vtkIdType row = begin; row < end; ++row, to += components)
      {
        const auto packed = Load<std::uint32_t>(rows.Point(row) + offset);
        to[0] = static_cast<unsigned char>(packed >> 16);
        to[1] = static_cast<unsigned char>(packed >> 8);
        to[2] = static_cast<unsigned char>(packed);
        if (components == 4)
        {
          to[3] = static_cast<unsigned char>(packed >> 24);
        }
      }
    });
  return colors;
}

bool HasOpacity(const Rows& rows, std::size_t offset)
{
  for (vtkIdType row = 0; row < rows.Count; ++row)
  {
    if (Load<std::uint32_t>(rows.Point(row) + offset) >> 24)
    {
      return true;
    }
  }
  return false;
}

bool IsColor(const Field& field)
{
  return (field.name == "rgb" || field.name == "rgba") && field.count == 1 &&
    (field.datatype == Field::FLOAT32 || field.datatype == Field::UINT32 ||
      field.datatype == Field::INT32);
}

// Whether there are three fields of these names and one component each.
bool Find(const std::vector<Field>& fields, const std::array<const char*, 3>& names,
  std::array<Field, 3>& found)
{
  for (int i = 0; i < 3; ++i)
  {
    const auto field = std::find_if(fields.begin(), fields.end(),
      [&](const Field& candidate) { return candidate.name == names[i] && candidate.count == 1; });
    if (field == fields.end())
    {
      return false;
    }
    found[i] = *field;
  }
  return true;
}

bool IsOneOf(const Field& field, const std::array<Field, 3>& fields)
{
  return std::any_of(
    fields.begin(), fields.end(), [&](const Field& other) { return other.name == field.name; });
}

constexpr std::array<const char*, 3> PositionNames = { "x", "y", "z" };
constexpr std::array<const char*, 3> NormalNames = { "normal_x", "normal_y", "normal_z" };

std::vector<vtkIdType> FindFinite(const Rows& rows, const std::array<Field, 3>& position)
{
  std::vector<vtkIdType> ids;
  for (vtkIdType id = 0; id < rows.Count; ++id)
  {
    if (std::all_of(position.begin(), position.end(),
          [&](const Field& field) { return std::isfinite(LoadAsDouble(rows.Point(id), field)); }))
    {
      ids.push_back(id);
    }
  }
  return ids;
}

template <typename Array>
void AddFieldData(
  vtkPolyData* output, const char* name, std::initializer_list<typename Array::ValueType> values)
{
  vtkNew<Array> array;
  array->SetName(name);
  for (const auto value : values)
  {
    array->InsertNextValue(value);
  }
  output->GetFieldData()->AddArray(array);
}
} // anonymous namespace

//------------------------------------------------------------------------------
void vtkPCLConversion::Read(
  const Layout& layout, const unsigned char* data, vtkPolyData* output, bool removeInvalidPoints)
{
  output->Initialize();
  std::array<Field, 3> position;
  if (!Find(layout.Fields, PositionNames, position))
  {
    std::string names;
    for (const Field& field : layout.Fields)
    {
      names += " " + field.name;
    }
    throw std::invalid_argument(
      "there are no points without the fields x, y and z; the fields are:" + names);
  }

  Rows rows;
  rows.Data = data;
  rows.Step = layout.Step;
  rows.Count = static_cast<vtkIdType>(layout.Width) * layout.Height;
  std::vector<vtkIdType> finite;
  if (removeInvalidPoints)
  {
    finite = FindFinite(rows, position);
    if (static_cast<vtkIdType>(finite.size()) < rows.Count)
    {
      rows.Count = static_cast<vtkIdType>(finite.size());
      rows.Ids = finite.data();
    }
  }

  vtkNew<vtkPoints> points;
  points->SetData(GatherVector(rows, position));
  output->SetPoints(points);

  vtkPointData* pointData = output->GetPointData();
  std::array<Field, 3> normal;
  const bool hasNormals = Find(layout.Fields, NormalNames, normal);
  for (const Field& field : layout.Fields)
  {
    if (field.name == "_" || IsOneOf(field, position) || (hasNormals && IsOneOf(field, normal)))
    {
      continue;
    }
    if (IsColor(field))
    {
      const bool opacity = field.name == "rgba" && HasOpacity(rows, field.offset);
      pointData->SetScalars(GatherColors(rows, field.offset, opacity ? 4 : 3));
      continue;
    }
    const vtkSmartPointer<vtkDataArray> array = WithType(field,
      [&](auto type)
      { return Gather<decltype(type)>(rows, field.offset, static_cast<int>(field.count)); });
    array->SetName(field.name.c_str());
    pointData->AddArray(array);
  }
  if (hasNormals)
  {
    const vtkSmartPointer<vtkDataArray> normals = GatherVector(rows, normal);
    normals->SetName("Normals");
    pointData->SetNormals(normals);
  }

  const bool whole = rows.Count == static_cast<vtkIdType>(layout.Width) * layout.Height;
  const int width = static_cast<int>(whole ? layout.Width : rows.Count);
  const int height = static_cast<int>(whole ? layout.Height : 1);
  AddFieldData<vtkIntArray>(output, "organised_dims", { width, height });
}

//------------------------------------------------------------------------------
void vtkPCLConversion::ToPolyData(const pcl::PCLPointCloud2& cloud, const Eigen::Vector4f& origin,
  const Eigen::Quaternionf& orientation, vtkPolyData* output, bool removeInvalidPoints)
{
  ToPolyData(
    cloud, cloud.data.data(), cloud.data.size(), origin, orientation, output, removeInvalidPoints);
}

//------------------------------------------------------------------------------
void vtkPCLConversion::ToPolyData(const pcl::PCLPointCloud2& cloud, const unsigned char* data,
  std::size_t size, const Eigen::Vector4f& origin, const Eigen::Quaternionf& orientation,
  vtkPolyData* output, bool removeInvalidPoints)
{
  Layout layout;
  layout.Fields = cloud.fields;
  layout.Step = cloud.point_step;
  layout.Width = cloud.width;
  layout.Height = cloud.height;
  if (size / std::max<std::size_t>(layout.Step, 1) <
    static_cast<std::size_t>(layout.Width) * layout.Height)
  {
    throw std::invalid_argument("the cloud has fewer data than its width and height ask for");
  }
  Read(layout, data, output, removeInvalidPoints);
  WriteViewpoint(origin, orientation, output);
}

//------------------------------------------------------------------------------
void vtkPCLConversion::WriteViewpoint(
  const Eigen::Vector4f& origin, const Eigen::Quaternionf& orientation, vtkPolyData* output)
{
  AddFieldData<vtkDoubleArray>(output, "viewpoint",
    { origin[0], origin[1], origin[2], orientation.w(), orientation.x(), orientation.y(),
      orientation.z() });
}

//------------------------------------------------------------------------------
void vtkPCLConversion::ReadViewpoint(
  vtkPolyData* input, Eigen::Vector4f& origin, Eigen::Quaternionf& orientation)
{
  origin = Eigen::Vector4f::Zero();
  orientation = Eigen::Quaternionf::Identity();
  vtkDataArray* viewpoint = input->GetFieldData()->GetArray("viewpoint");
  if (viewpoint && viewpoint->GetNumberOfValues() == 7)
  {
    std::array<float, 7> v;
    const int components = viewpoint->GetNumberOfComponents();
    for (int i = 0; i < 7; ++i)
    {
      v[i] = static_cast<float>(viewpoint->GetComponent(i / components, i % components));
    }
    origin = Eigen::Vector4f(v[0], v[1], v[2], 0.0f);
    orientation = Eigen::Quaternionf(v[3], v[4], v[5], v[6]);
  }
}

//------------------------------------------------------------------------------
void vtkPCLConversion::ReadSize(vtkPolyData* input, Layout& layout)
{
  const vtkIdType count = input->GetNumberOfPoints();
  layout.Width = static_cast<unsigned int>(count);
  layout.Height = 1;
  vtkDataArray* size = input->GetFieldData()->GetArray("organised_dims");
  if (size && size->GetNumberOfValues() == 2)
  {
    const int components = size->GetNumberOfComponents();
    const double width = size->GetComponent(0, 0);
    const double height = size->GetComponent(1 / components, 1 % components);
    if (width >= 0 && height >= 0 && width * height == count)
    {
      layout.Width = static_cast<unsigned int>(width);
      layout.Height = static_cast<unsigned int>(height);
    }
  }
}

namespace
{
// The nearest value of the type; 0 for NaN where the type has none.
template <typename T>
T Cast(double value)
{
  if constexpr (std::is_floating_point<T>::value)
  {
    return static_cast<T>(value);
  }
  else
  {
    if (std::isnan(value) || value <= static_cast<double>(std::numeric_limits<T>::min()))
    {
      return std::isnan(value) ? T(0) : std::numeric_limits<T>::min();
    }
    if (value >= static_cast<double>(std::numeric_limits<T>::max()))
    {
      return std::numeric_limits<T>::max();
    }
    return static_cast<T>(value);
  }
}

// Writes `count` components, from `component` on, of an array to a field of each point; false where
// one of the values is not finite.
template <typename T>
bool Scatter(vtkDataArray* array, int component, int count, unsigned char* to, std::size_t step)
{
  const int components = array->GetNumberOfComponents();
  const bool same =
    array->GetDataType() == vtkTypeTraits<T>::VTKTypeID() && array->HasStandardMemoryLayout();
  const T* values = same ? static_cast<const T*>(array->GetVoidPointer(0)) : nullptr;
  bool finite = true;
  for (vtkIdType id = 0; id < array->GetNumberOfTuples(); ++id, to += step)
  {
    for (int i = 0; i < count; ++i)
    {
      const T value = values ? values[id * components + component + i]
                             : Cast<T>(array->GetComponent(id, component + i));
      std::memcpy(to + i * sizeof(T), &value, sizeof(T));
      if constexpr (std::is_floating_point<T>::value)
      {
        finite = finite && std::isfinite(value);
      }
    }
  }
  return finite;
}

vtkUnsignedCharArray* FindColors(vtkPointData* data)
{
  for (vtkDataArray* array : { data->GetArray("RGB"), data->GetArray("RGBA"), data->GetScalars() })
  {
    auto* colors = vtkUnsignedCharArray::SafeDownCast(array);
    if (colors && (colors->GetNumberOfComponents() == 3 || colors->GetNumberOfComponents() == 4))
    {
      return colors;
    }
  }
  return nullptr;
}

void ScatterColors(vtkUnsignedCharArray* colors, unsigned char* to, std::size_t step)
{
  const int components = colors->GetNumberOfComponents();
  const unsigned char* from = colors->GetPointer(0);
  for (vtkIdType id = 0; id < colors->GetNumberOfTuples(); ++id, from += components, to += step)
  {
    const std::uint32_t opacity = components == 4 ? from[3] : 255;
    const std::uint32_t packed = opacity << 24 | from[0] << 16 | from[1] << 8 | from[2];
    std::memcpy(to, &packed, sizeof(packed));
  }
}
} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<std::string> vtkPCLConversion::Write(
  vtkPolyData* input, const Layout& layout, unsigned char* data, bool& dense)
{
  dense = true;
  std::vector<std::string> missing;
  vtkPointData* pointData = input->GetPointData();
  const vtkIdType count = input->GetNumberOfPoints();
  for (const Field& field : layout.Fields)
  {
    const auto is = [&](const char* name) { return field.name == name; };
    const auto axis = std::find_if(PositionNames.begin(), PositionNames.end(), is);
    const auto normalAxis = std::find_if(NormalNames.begin(), NormalNames.end(), is);
    vtkDataArray* array = pointData->GetArray(field.name.c_str());
    int component = 0;
    if (IsColor(field))
    {
      array = FindColors(pointData);
    }
    else if (axis != PositionNames.end())
    {
      array = count > 0 ? input->GetPoints()->GetData() : nullptr;
      component = static_cast<int>(axis - PositionNames.begin());
    }
    else if (normalAxis != NormalNames.end())
    {
      array = pointData->GetNormals() ? pointData->GetNormals() : pointData->GetArray("Normals");
      component = static_cast<int>(normalAxis - NormalNames.begin());
    }

    const int components = static_cast<int>(std::max<pcl::uindex_t>(field.count, 1));
    if (!array || array->GetNumberOfTuples() != count ||
      (!IsColor(field) && array->GetNumberOfComponents() < component + components))
    {
      missing.push_back(field.name);
      continue;
    }
    if (IsColor(field))
    {
      ScatterColors(vtkUnsignedCharArray::SafeDownCast(array), data + field.offset, layout.Step);
      continue;
    }
    dense = WithType(field,
              [&](auto type)
              {
                return Scatter<decltype(type)>(
                  array, component, components, data + field.offset, layout.Step);
              }) &&
      dense;
  }
  return missing;
}
