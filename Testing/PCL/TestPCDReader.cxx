// SPDX-License-Identifier: BSD-3-Clause
// vtkPCDReader and vtkPCLConversion on files that PCL has written, bit for bit, and on broken ones.
#include "PointSurfaceTestUtilities.h"

#include "vtkFieldData.h"
#include "vtkLongArray.h"
#include "vtkPCDReader.h"
#include "vtkPCLConversion.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedLongArray.h"
#include "vtkXMLPolyDataReader.h"

#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

namespace
{
using Field = pcl::PCLPointField;
constexpr std::array<const char*, 3> Encodings = { "ascii", "binary", "binary_compressed" };
constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

// With as many digits as single precision needs.
template <typename Cloud>
void Write(const std::string& file, const Cloud& cloud, const std::string& encoding)
{
  pcl::PCDWriter writer;
  if (encoding == "ascii")
  {
    writer.writeASCII(file, cloud, 9);
  }
  else if (encoding == "binary")
  {
    writer.writeBinary(file, cloud);
  }
  else
  {
    writer.writeBinaryCompressed(file, cloud);
  }
}

// What the reader makes of a file, with all that it has to say.
struct Reading
{
  vtkNew<vtkPCDReader> Reader;
  PointSurfaceTest::Messages Messages{ Reader };

  explicit Reading(const std::string& file)
  {
    this->Reader->SetFileName(file.c_str());
    this->Reader->Update();
  }
  vtkPolyData* GetOutput() { return this->Reader->GetOutput(); }
  bool Failed()
  {
    return this->Messages.GetCount() == 1 && this->GetOutput()->GetNumberOfPoints() == 0 &&
      this->GetOutput()->GetPointData()->GetNumberOfArrays() == 0;
  }
  bool Succeeded(vtkIdType points)
  {
    return this->Messages.GetCount() == 0 && this->GetOutput()->GetNumberOfPoints() == points;
  }
};

// A grid of 7 x 5 points with values in all fields, some positions of NaN, seen from somewhere.
template <typename PointT>
pcl::PointCloud<PointT> MakeCloud()
{
  pcl::PointCloud<PointT> cloud;
  cloud.width = 7;
  cloud.height = 5;
  cloud.points.resize(35);
  cloud.sensor_origin_ = Eigen::Vector4f(0.5f, -1.25f, 3.0f, 0.0f);
  cloud.sensor_orientation_ = Eigen::Quaternionf(0.5f, -0.5f, 0.5f, 0.5f);
  cloud.is_dense = false;
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(3);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    for (const Field& field : pcl::getFields<PointT>())
    {
      random->Next();
      const double value = random->GetRangeValue(-1e3, 1e3);
      auto* to = reinterpret_cast<unsigned char*>(&cloud[i]) + field.offset;
      if (field.name == "rgb" || field.name == "rgba")
      {
        const std::uint32_t opacity = field.name == "rgb" ? 255 : 1 + i;
        const auto color = static_cast<std::uint32_t>((value + 1e3) / 2e3 * 0xffffff);
        const std::uint32_t packed = opacity << 24 | color;
        std::memcpy(to, &packed, 4);
      }
      else if (field.datatype == Field::FLOAT32)
      {
        const float single = i % 6 == 5 && field.name == "y" ? NaN : static_cast<float>(value);
        std::memcpy(to, &single, 4);
      }
      else
      {
        const std::uint32_t whole = 4000000000u - static_cast<std::uint32_t>(value + 1e3);
        std::memcpy(to, &whole, 4);
      }
    }
  }
  return cloud;
}

template <typename PointT>
bool AreEqual(const pcl::PointCloud<PointT>& a, const pcl::PointCloud<PointT>& b)
{
  bool equal = a.width == b.width && a.height == b.height && a.size() == b.size() &&
    a.sensor_origin_ == b.sensor_origin_ &&
    a.sensor_orientation_.coeffs() == b.sensor_orientation_.coeffs();
  for (std::size_t i = 0; equal && i < a.size(); ++i)
  {
    for (const Field& field : pcl::getFields<PointT>())
    {
      equal = equal &&
        std::memcmp(reinterpret_cast<const unsigned char*>(&a[i]) + field.offset,
          reinterpret_cast<const unsigned char*>(&b[i]) + field.offset, 4) == 0;
    }
  }
  return equal;
}

//------------------------------------------------------------------------------
template <typename PointT>
void TestPointType(
  PointSurfaceTest::Checks& check, const std::string& folder, const std::string& name)
{
  const pcl::PointCloud<PointT> cloud = MakeCloud<PointT>();
  for (const std::string encoding : Encodings)
  {
    const std::string what = name + ", " + encoding;
    const std::string file = folder + "/type.pcd";
    Write(file, cloud, encoding);
    Reading reading(file);
    check(reading.Succeeded(35), what + ": is read");
    pcl::PointCloud<PointT> back;
    check(vtkPCLConversion::FromPolyData(reading.GetOutput(), back).empty(), what + ": all fields");
    check(AreEqual(cloud, back), what + ": bit for bit");
    check(!back.is_dense, what + ": is known to have NaN");
  }
  vtkNew<vtkPolyData> direct;
  vtkPCLConversion::ToPolyData(cloud, direct);
  pcl::PointCloud<PointT> back;
  vtkPCLConversion::FromPolyData(direct, back);
  check(AreEqual(cloud, back), name + " with no file between: bit for bit");
}

//------------------------------------------------------------------------------
// What becomes of the fields, told by the members of PCL's points.
void TestContent(PointSurfaceTest::Checks& check)
{
  const auto surfels = MakeCloud<pcl::PointSurfel>();
  vtkNew<vtkPolyData> output;
  vtkPCLConversion::ToPolyData(surfels, output);
  vtkPointData* data = output->GetPointData();
  bool same = data->GetNormals() && data->GetScalars() &&
    std::string(data->GetScalars()->GetName()) == "RGBA" && data->GetArray("radius") &&
    data->GetArray("confidence") && data->GetArray("curvature");
  check(same, "arrays of surfels");
  for (int i = 0; same && i < 35; ++i)
  {
    const pcl::PointSurfel& surfel = surfels[i];
    const double* x = output->GetPoint(i);
    const double* n = data->GetNormals()->GetTuple(i);
    const double* c = data->GetScalars()->GetTuple(i);
    same = x[0] == surfel.x && (x[1] == surfel.y || std::isnan(surfel.y)) && x[2] == surfel.z &&
      n[0] == surfel.normal_x && n[1] == surfel.normal_y && n[2] == surfel.normal_z &&
      c[0] == surfel.r && c[1] == surfel.g && c[2] == surfel.b && c[3] == surfel.a &&
      data->GetArray("radius")->GetTuple1(i) == surfel.radius &&
      data->GetArray("confidence")->GetTuple1(i) == surfel.confidence &&
      data->GetArray("curvature")->GetTuple1(i) == surfel.curvature;
  }
  check(same, "values of surfels");
  const double viewpoint[7] = { 0.5, -1.25, 3.0, 0.5, -0.5, 0.5, 0.5 };
  vtkDataArray* seen = output->GetFieldData()->GetArray("viewpoint");
  for (int i = 0; i < 7; ++i)
  {
    check(seen && seen->GetTuple1(i) == viewpoint[i], "viewpoint");
  }
  vtkDataArray* size = output->GetFieldData()->GetArray("organised_dims");
  check(size && size->GetTuple1(0) == 7 && size->GetTuple1(1) == 5, "width and height");

  // NaN left out: i % 6 == 5, five of 35.
  vtkPCLConversion::ToPolyData(surfels, output, true);
  data = output->GetPointData();
  size = output->GetFieldData()->GetArray("organised_dims");
  check(output->GetNumberOfPoints() == 30 && size->GetTuple1(0) == 30 && size->GetTuple1(1) == 1,
    "points of NaN are left out");
  same = true;
  for (int i = 0; i < 30; ++i)
  {
    const pcl::PointSurfel& surfel = surfels[i + i / 5];
    same = same && output->GetPoint(i)[1] == surfel.y &&
      data->GetArray("radius")->GetTuple1(i) == surfel.radius &&
      data->GetNormals()->GetTuple(i)[2] == surfel.normal_z &&
      data->GetScalars()->GetTuple(i)[0] == surfel.r;
  }
  check(same, "the others keep their values");

  // Opacities of 0 are none; a cloud without NaN stays a grid.
  auto clear = MakeCloud<pcl::PointXYZRGBA>();
  for (auto& point : clear)
  {
    point.a = 0;
    point.y = 1.0f;
  }
  vtkPCLConversion::ToPolyData(clear, output, true);
  check(output->GetPointData()->GetScalars()->GetNumberOfComponents() == 3, "no opacities");
  check(output->GetFieldData()->GetArray("organised_dims")->GetTuple1(0) == 7, "still a grid");

  for (auto& point : clear)
  {
    point.y = NaN;
  }
  vtkPCLConversion::ToPolyData(clear, output, true);
  size = output->GetFieldData()->GetArray("organised_dims");
  check(output->GetNumberOfPoints() == 0 && size->GetTuple1(0) == 0 && size->GetTuple1(1) == 1,
    "all points are left out");

  // From polydata that knows more and less than the point type.
  vtkSmartPointer<vtkPolyData> sphere = PointSurfaceTest::MakeSphereCloud(50);
  vtkNew<vtkPoints> doubles;
  doubles->SetDataTypeToDouble();
  doubles->DeepCopy(sphere->GetPoints());
  sphere->SetPoints(doubles);
  pcl::PointCloud<pcl::PointSurfel> few;
  check(vtkPCLConversion::FromPolyData(sphere, few) ==
      std::vector<std::string>{ "rgba", "confidence", "curvature" },
    "fields that are missing are named");
  check(few.width == 50 && few.height == 1 && few.is_dense && few[0].a == pcl::PointSurfel().a &&
      few[7].x == static_cast<float>(sphere->GetPoint(7)[0]) && few[7].normal_x == few[7].x &&
      few[7].radius == static_cast<float>(sphere->GetPointData()->GetArray("radius")->GetTuple1(7)),
    "surfels of a sphere");

  pcl::PointCloud<pcl::Normal> bare;
  try
  {
    vtkPCLConversion::ToPolyData(bare, output);
    check(false, "no positions are an error");
  }
  catch (const std::invalid_argument& fault)
  {
    check(std::string(fault.what()).find("normal_x") != std::string::npos, "fields are named");
  }
}

//------------------------------------------------------------------------------
// A field of each type with its extreme values.
struct AnyTypes
{
  pcl::PCLPointCloud2 Cloud;

  template <typename T>
  void Add(const std::string& name, int type, const std::vector<T>& values)
  {
    Field field;
    field.name = name;
    field.datatype = static_cast<std::uint8_t>(type);
    field.offset = this->Cloud.point_step;
    field.count = static_cast<pcl::uindex_t>(values.size());
    this->Cloud.fields.push_back(field);
    this->Cloud.point_step += field.count * sizeof(T);
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    this->Cloud.data.insert(this->Cloud.data.end(), bytes, bytes + values.size() * sizeof(T));
  }
  template <typename T>
  void AddLimits(const std::string& name, int type)
  {
    this->Add<T>(
      name, type, { std::numeric_limits<T>::min(), T(1), std::numeric_limits<T>::max() });
  }
};

template <typename T>
bool HasLimits(vtkPolyData* cloud, const char* name)
{
  vtkDataArray* array = cloud->GetPointData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() != 3 || array->GetDataTypeSize() != sizeof(T))
  {
    return false;
  }
  const auto* values = static_cast<const T*>(array->GetVoidPointer(0));
  return values[0] == std::numeric_limits<T>::min() && values[1] == T(1) &&
    values[2] == std::numeric_limits<T>::max();
}

// `large`: the largest of 8 bytes.
AnyTypes MakeAnyTypes(std::int64_t large)
{
  AnyTypes any;
  any.AddLimits<std::int8_t>("i1", Field::INT8);
  any.Add<float>("x", Field::FLOAT32, { 1.5f });
  any.AddLimits<std::uint8_t>("u1", Field::UINT8);
  any.AddLimits<std::int16_t>("i2", Field::INT16);
  any.Add<double>("y", Field::FLOAT64, { 5403000.25 });
  any.AddLimits<std::uint16_t>("u2", Field::UINT16);
  any.AddLimits<std::int32_t>("i4", Field::INT32);
  any.AddLimits<std::uint32_t>("u4", Field::UINT32);
  any.Add<std::int16_t>("z", Field::INT16, { -7 });
  any.Add<std::int64_t>("i8", Field::INT64, { -large, 1, large });
  any.Add<std::uint64_t>("u8", Field::UINT64, { 0, 1, static_cast<std::uint64_t>(large) });
  any.AddLimits<float>("f4", Field::FLOAT32);
  any.AddLimits<double>("f8", Field::FLOAT64);
  any.Add<std::uint8_t>("b1", Field::BOOL, { 1 });
  any.Cloud.width = any.Cloud.height = 1;
  any.Cloud.row_step = any.Cloud.point_step;
  return any;
}

void TestFieldTypes(PointSurfaceTest::Checks& check, const std::string& folder)
{
  pcl::PCDWriter writer;
  const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  const Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  const std::string file = folder + "/any.pcd";
  for (const std::string encoding : Encodings)
  {
    // PCL reads text as double precision.
    const bool text = encoding == "ascii";
    const std::int64_t large =
      text ? std::int64_t(1) << 53 : std::numeric_limits<std::int64_t>::max();
    const AnyTypes any = MakeAnyTypes(large);
    if (text)
    {
      writer.writeASCII(file, MakeAnyTypes(large + 1).Cloud, origin, orientation, 17);
      check(Reading(file).Messages.Contain("2^53"), "a whole number that PCL cannot read");
      writer.writeASCII(file, any.Cloud, origin, orientation, 17);
    }
    else if (encoding == "binary")
    {
      writer.writeBinary(file, any.Cloud, origin, orientation);
    }
    else
    {
      writer.writeBinaryCompressed(file, any.Cloud, origin, orientation);
    }
    Reading reading(file);
    vtkPolyData* cloud = reading.GetOutput();
    check(reading.Succeeded(1), encoding + ": any types are read");
    if (cloud->GetNumberOfPoints() != 1)
    {
      continue;
    }
    const double* x = cloud->GetPoint(0);
    check(x[0] == 1.5 && x[1] == 5403000.25 && x[2] == -7.0, encoding + ": mixed coordinates");
    check(HasLimits<std::int8_t>(cloud, "i1") && HasLimits<std::uint8_t>(cloud, "u1"),
      encoding + ": 1 byte");
    check(HasLimits<std::int16_t>(cloud, "i2") && HasLimits<std::uint16_t>(cloud, "u2"),
      encoding + ": 2 bytes");
    check(HasLimits<std::int32_t>(cloud, "i4") && HasLimits<std::uint32_t>(cloud, "u4"),
      encoding + ": 4 bytes");
    auto* i8 = vtkArrayDownCast<vtkLongArray>(cloud->GetPointData()->GetArray("i8"));
    auto* u8 = vtkArrayDownCast<vtkUnsignedLongArray>(cloud->GetPointData()->GetArray("u8"));
    check(i8 && u8 && i8->GetValue(0) == -large && i8->GetValue(2) == large &&
        u8->GetValue(1) == 1 && u8->GetValue(2) == static_cast<std::uint64_t>(large),
      encoding + ": 8 bytes");
    check(HasLimits<float>(cloud, "f4") && HasLimits<double>(cloud, "f8"), encoding + ": floats");
    vtkDataArray* flag = cloud->GetPointData()->GetArray("b1");
    check(flag && flag->GetTuple1(0) == 1.0, encoding + ": bool");
  }
}

//------------------------------------------------------------------------------
std::string Content(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

void WriteContent(const std::string& file, const std::string& content)
{
  std::ofstream(file, std::ios::binary) << content;
}

std::string Replaced(std::string text, const std::string& part, const std::string& by)
{
  const auto at = text.find(part);
  return at == std::string::npos ? text : text.replace(at, part.size(), by);
}

void TestFaults(PointSurfaceTest::Checks& check, const std::string& folder)
{
  const std::string file = folder + "/broken.pcd";
  const std::string good =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z label\nSIZE 4 4 4 1\nTYPE F F F U\n"
    "COUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n"
    "DATA ascii\n1 2 3 4\r\n\n+5 nan 1e3 255\n";
  WriteContent(file, good);
  check(Reading(file).Succeeded(2), "the file that the others are made from");

  const struct
  {
    const char* Part;
    const char* By;
    const char* Says;
  } faults[] = {
    { "FIELDS x y z label", "FIELDS", "SIZE" },
    { "FIELDS x y z label\n", "", "SIZE" },
    { "FIELDS x y z label", "FIELDS x y z x", "twice" },
    { "FIELDS x y z label", "FIELDS a b c label", "a b c" },
    { "SIZE 4 4 4 1", "SIZE 4 4 4", "SIZE" },
    { "SIZE 4 4 4 1", "SIZE 4 4 -4 1", "-4" },
    { "SIZE 4 4 4 1", "SIZE 4 4 3 1", "3 bytes" },
    { "SIZE 4 4 4 1\n", "", "SIZE" },
    { "TYPE F F F U\n", "", "TYPE" },
    { "TYPE F F F U", "TYPE F F Q U", "Q" },
    { "COUNT 1 1 1 1", "COUNT 1 1 1 0", "COUNT" },
    { "COUNT 1 1 1 1", "COUNT 1 1 1 2000000000", "COUNT" },
    { "WIDTH 2", "WIDTH 3", "POINTS 2" },
    { "WIDTH 2", "WIDTH two", "two" },
    { "WIDTH 2\nHEIGHT 1", "WIDTH 65536\nHEIGHT 65536", "65536" },
    { "WIDTH 2\n", "WIDTH 2\nWIDTH 2\n", "twice" },
    { "HEIGHT 1", "HEIGHT -1", "-1" },
    { "VIEWPOINT 0 0 0 1 0 0 0", "VIEWPOINT 0 0 0", "VIEWPOINT" },
    { "VIEWPOINT 0 0 0 1 0 0 0", "VIEWPOINT 0 0 0 1 0 0 nan", "VIEWPOINT" },
    { "POINTS 2", "POINTS 99999999999999999999", "POINTS" },
    { "WIDTH 2\nHEIGHT 1", "WIDTH 2000000000\nHEIGHT 1", "POINTS" },
    { "DATA ascii", "DATA text", "text" },
    { "DATA ascii", "DATA", "DATA" },
    { "DATA ascii", "DATA binary", "cut short" },
    { "DATA ascii", "DATA binary_compressed", "compressed" },
    { "DATA ascii\n", "", "no" },
    { "POINTS 2\nDATA ascii", "DATA ascii\nPOINTS 2", "POINTS" },
    { "1 2 3 4", "1 2 3", "label" },
    { "1 2 3 4", "1 2 3 4 5", "more values" },
    { "1 2 3 4", "1 2 three 4", "three" },
    { "1 2 3 4", "1 2 3 256", "256" },
    { "1 2 3 4", "1 2 3 nan", "nan" },
    { "1 2 3 4", "1 2 3 4.5", "4.5" },
    { "+5 nan 1e3 255\n", "         \n", "line 3" },
    { "+5 nan 1e3 255\n", "\n\n\n\n\n\n\n\n", "there are 1" },
  };
  for (const auto& fault : faults)
  {
    WriteContent(file, Replaced(good, fault.Part, fault.By));
    Reading reading(file);
    const std::string what = std::string(fault.Part) + " -> " + fault.By;
    check(reading.Failed(), what + ": one error, and an empty output");
    check(reading.Messages.Contain(fault.Says), what + ": says what is wrong");
  }
  const std::string huge =
    Replaced(Replaced(good, "WIDTH 2", "WIDTH 2000000000"), "POINTS 2", "POINTS 2000000000");
  for (const std::string encoding : Encodings)
  {
    WriteContent(file, Replaced(huge, "ascii", encoding));
    check(Reading(file).Failed(), encoding + ": two thousand million points of a short file");
  }

  for (const std::string content :
    { std::string(), std::string(5000000, 'x'), std::string(100, '\0') })
  {
    WriteContent(file, content);
    check(Reading(file).Failed(), "no such thing");
  }
  check(Reading(folder + "/absent.pcd").Messages.Contain("does not exist"), "an absent file");
  check(Reading(folder).Failed(), "a folder");
  check(Reading("").Messages.Contain("SetFileName"), "no file name");

  // No points are no fault.
  const std::string none = Replaced(Replaced(good, "WIDTH 2", "WIDTH 0"), "POINTS 2", "POINTS 0");
  WriteContent(file, none);
  check(Reading(file).Succeeded(0), "no points");
  WriteContent(file,
    Replaced(none.substr(0, none.find("1 2 3 4")), "ascii", "binary_compressed") +
      std::string(8, '\0'));
  check(Reading(file).Succeeded(0), "no points, compressed");
  // Data that look like a header are none.
  std::string data = "FIELDS x y z\nSIZE 4 4 4\nPOINTS 1000000\nDATA binary_compressed\n";
  data.resize(120, '0');
  WriteContent(file, "FIELDS x y z\nPOINTS 10\nDATA binary\n" + data);
  Reading disguised(file);
  check(disguised.Succeeded(10) &&
      std::memcmp(disguised.GetOutput()->GetPoints()->GetVoidPointer(0), data.data(), 120) == 0,
    "data like a header");
  // As files were before version 0.7.
  WriteContent(file, "COLUMNS x y z\nPOINTS 1\nDATA ascii\n1 2 3\n");
  check(Reading(file).Succeeded(1), "an old header");
}

// Each file cut at each length, and with each byte of header and sizes changed: what is read is as
// large as it should be, or there is one error.
void TestDamage(PointSurfaceTest::Checks& check, const std::string& folder)
{
  const std::string file = folder + "/damaged.pcd";
  for (const std::string encoding : Encodings)
  {
    Write(file, MakeCloud<pcl::PointXYZI>(), encoding);
    const std::string good = Content(file);
    int wrong = 0;
    // the last digits of the last number may be missing
    const std::size_t whole = encoding == "ascii" ? good.find_last_of(' ') + 1 : good.size() - 1;
    for (std::size_t length = 0; length <= whole; length += length < 300 ? 1 : 7)
    {
      WriteContent(file, good.substr(0, length));
      wrong += !Reading(file).Failed();
    }
    check(wrong == 0, encoding + ": cut short, " + std::to_string(wrong) + " with no error");

    wrong = 0;
    const std::size_t header = good.find("DATA");
    for (std::size_t i = 0; i < header + 40; ++i)
    {
      for (const char by : { '\0', ' ', '\n', '0', '9', '-', '\xff' })
      {
        std::string bad = good;
        bad[i] = by;
        WriteContent(file, bad);
        Reading reading(file);
        vtkDataArray* size = reading.GetOutput()->GetFieldData()->GetArray("organised_dims");
        wrong += !reading.Failed() &&
          !(size &&
            reading.Succeeded(static_cast<vtkIdType>(size->GetTuple1(0) * size->GetTuple1(1))));
      }
    }
    check(wrong == 0, encoding + ": damaged, " + std::to_string(wrong) + " of another size");
  }
}

//------------------------------------------------------------------------------
void TestProgress(PointSurfaceTest::Checks& check, const std::string& folder)
{
  pcl::PointCloud<pcl::PointXYZ> cloud;
  cloud.resize(200000, pcl::PointXYZ(1.0f, 2.0f, 3.0f));
  const std::string file = folder + "/long.pcd";
  Write(file, cloud, "ascii");
  Reading reading(file);
  check(reading.Succeeded(200000), "a long file");
  check(PointSurfaceTest::Abort(reading.Reader) && reading.Messages.GetCount() == 0 &&
      reading.GetOutput()->GetNumberOfPoints() == 0,
    "an aborted reader has no points, and nothing to say");
  reading.Reader->Modified();
  reading.Reader->Update();
  check(reading.Succeeded(200000), "and reads again");
}

//------------------------------------------------------------------------------
bool AreEqual(vtkDataArray* a, vtkDataArray* b)
{
  return a && b && a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents() &&
    a->GetNumberOfValues() == b->GetNumberOfValues() &&
    std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
      static_cast<std::size_t>(a->GetNumberOfValues()) * a->GetDataTypeSize()) == 0;
}

template <typename PointT>
void TestScan(PointSurfaceTest::Checks& check, const std::string& folder, const std::string& name)
{
  const std::string path = PointSurfaceTest::SharedData("scans/" + name + ".vtp");
  if (path.empty())
  {
    return;
  }
  vtkNew<vtkXMLPolyDataReader> scan;
  scan->SetFileName(path.c_str());
  scan->Update();
  vtkPolyData* truth = scan->GetOutput();
  pcl::PointCloud<PointT> cloud;
  check(vtkPCLConversion::FromPolyData(truth, cloud).empty(), name + " has all fields");
  const std::string file = folder + "/" + name + ".pcd";
  for (const std::string encoding : Encodings)
  {
    if (encoding == "ascii" && cloud.size() > 200000)
    {
      continue; // takes long
    }
    Write(file, cloud, encoding);
    Reading reading(file);
    vtkPolyData* read = reading.GetOutput();
    const std::string what = name + ", " + encoding;
    check(reading.Succeeded(truth->GetNumberOfPoints()), what);
    check(AreEqual(truth->GetPoints()->GetData(), read->GetPoints()->GetData()), what + ": points");
    for (const char* field : { "organised_dims", "viewpoint" })
    {
      check(AreEqual(truth->GetFieldData()->GetArray(field), read->GetFieldData()->GetArray(field)),
        what + ": " + field);
    }
    check(!truth->GetPointData()->HasArray("RGB") ||
        AreEqual(truth->GetPointData()->GetArray("RGB"), read->GetPointData()->GetScalars()),
      what + ": colours");
  }
  std::remove(file.c_str());
}
} // anonymous namespace

int TestPCDReader(int, char* arguments[])
{
  PointSurfaceTest::Checks check;
  const std::string folder = arguments[1];
  TestPointType<pcl::PointXYZ>(check, folder, "PointXYZ");
  TestPointType<pcl::PointXYZI>(check, folder, "PointXYZI");
  TestPointType<pcl::PointXYZL>(check, folder, "PointXYZL");
  TestPointType<pcl::PointXYZRGB>(check, folder, "PointXYZRGB");
  TestPointType<pcl::PointXYZRGBA>(check, folder, "PointXYZRGBA");
  TestPointType<pcl::PointNormal>(check, folder, "PointNormal");
  TestPointType<pcl::PointXYZRGBNormal>(check, folder, "PointXYZRGBNormal");
  TestPointType<pcl::PointXYZINormal>(check, folder, "PointXYZINormal");
  TestPointType<pcl::PointSurfel>(check, folder, "PointSurfel");
  TestContent(check);
  TestFieldTypes(check, folder);
  TestFaults(check, folder);
  TestDamage(check, folder);
  TestProgress(check, folder);
  TestScan<pcl::PointXYZRGB>(check, folder, "table-mug-stereo-rgb");
  TestScan<pcl::PointXYZRGB>(check, folder, "office-kinect-rgb");
  TestScan<pcl::PointXYZ>(check, folder, "room-lidar");
  TestScan<pcl::PointXYZ>(check, folder, "terrain-utm-csite2");
  return check.GetResult();
}
