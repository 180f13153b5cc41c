// SPDX-License-Identifier: BSD-3-Clause
// vtkIsosurfacePoints against analytic surfaces, against the vertices of vtkFlyingEdges3D, and on
// data with faults.
#include "PointSurfaceTestUtilities.h"

#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkIsosurfacePoints.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace
{
using Vector = std::array<double, 3>;
using Image = vtkSmartPointer<vtkImageData>;

//------------------------------------------------------------------------------
// Surfaces as zero sets, positive inside, with the outward normal and the distance of a point near
// the surface.
struct Surface
{
  const char* Name;
  double (*Value)(const Vector&);
  Vector (*Normal)(const Vector&);
  double (*Distance)(const Vector&);
};

Vector Unit(Vector v)
{
  vtkMath::Normalize(v.data());
  return v;
}

const Surface Sphere = { "sphere", [](const Vector& x) { return 1.0 - vtkMath::Norm(x.data()); },
  [](const Vector& x) { return Unit(x); },
  [](const Vector& x) { return vtkMath::Norm(x.data()) - 1.0; } };

double FromRing(const Vector& x)
{
  return std::hypot(x[0], x[1]) - 0.9;
}

const Surface Torus = { "torus",
  [](const Vector& x) { return 0.16 - FromRing(x) * FromRing(x) - x[2] * x[2]; },
  [](const Vector& x)
  {
    const double ring = std::hypot(x[0], x[1]);
    return Unit({ FromRing(x) * x[0] / ring, FromRing(x) * x[1] / ring, x[2] });
  },
  [](const Vector& x) { return std::hypot(FromRing(x), x[2]) - 0.4; } };

double GyroidValue(const Vector& x)
{
  return std::sin(3 * x[0]) * std::cos(3 * x[1]) + std::sin(3 * x[1]) * std::cos(3 * x[2]) +
    std::sin(3 * x[2]) * std::cos(3 * x[0]);
}

Vector GyroidGradient(const Vector& x)
{
  Vector g;
  for (int c = 0; c < 3; ++c)
  {
    const double next = 3 * x[(c + 1) % 3];
    const double last = 3 * x[(c + 2) % 3];
    g[c] = 3 * (std::cos(3 * x[c]) * std::cos(next) - std::sin(last) * std::sin(3 * x[c]));
  }
  return g;
}

const Surface Gyroid = { "gyroid", GyroidValue,
  [](const Vector& x)
  {
    const Vector g = GyroidGradient(x);
    return Unit({ -g[0], -g[1], -g[2] });
  },
  [](const Vector& x) { // to first order, which is enough this near
    return -GyroidValue(x) / vtkMath::Norm(GyroidGradient(x).data());
  } };

//------------------------------------------------------------------------------
enum class Frame
{
  Plain,
  Oblique // anisotropic, rotated, mirrored, extent and origin off zero
};

// n voxels along the longest axis of a box about [-1.5, 1.5]^3, without values.
Image MakeGrid(int n, Frame frame)
{
  auto image = Image::New();
  const double h = 3.0 / (n - 1);
  if (frame == Frame::Plain)
  {
    image->SetDimensions(n, n, n);
    image->SetSpacing(h, h, h);
    image->SetOrigin(-1.5, -1.5, -1.5);
    return image;
  }
  const double angle = 0.5;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  image->SetDirectionMatrix(c, -s, 0, s, c, 0, 0, 0, -1);
  image->SetSpacing(h, 0.8 * h, 1.5 * h);
  const int dims[3] = { n, int(n / 0.8), int(n / 1.5) + 1 };
  const int first[3] = { -5, 3, 7 };
  image->SetExtent(first[0], first[0] + dims[0] - 1, first[1], first[1] + dims[1] - 1, first[2],
    first[2] + dims[2] - 1);
  double center[3];
  image->TransformContinuousIndexToPhysicalPoint(
    first[0] + 0.5 * dims[0], first[1] + 0.5 * dims[1], first[2] + 0.5 * dims[2], center);
  image->SetOrigin(-center[0], -center[1], -center[2]);
  return image;
}

Image Sample(Image image, const std::function<double(const Vector&)>& field, int type = VTK_DOUBLE)
{
  image->AllocateScalars(type, 1);
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  scalars->SetName("field");
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    Vector x;
    image->GetPoint(id, x.data());
    scalars->SetComponent(id, 0, field(x));
  }
  return image;
}

// Values from 0 to `levels` - 1 with no order in space.
Image MakeNoise(int n, int levels, int type)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(7);
  return Sample(
    MakeGrid(n, Frame::Plain),
    [&](const Vector&) { return std::floor(levels * random->GetNextValue()); }, type);
}

vtkSmartPointer<vtkPolyData> Points(vtkImageData* image, double isovalue)
{
  vtkNew<vtkIsosurfacePoints> filter;
  filter->SetInputData(image);
  filter->SetValue(0, isovalue);
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> Mesh(vtkImageData* image, double isovalue)
{
  vtkNew<vtkFlyingEdges3D> filter;
  filter->SetInputData(image);
  filter->SetValue(0, isovalue);
  filter->ComputeScalarsOff();
  filter->Update();
  return filter->GetOutput();
}

// Sorted, to be compared.
std::vector<Vector> Positions(vtkPolyData* data)
{
  std::vector<Vector> positions(data->GetNumberOfPoints());
  for (vtkIdType id = 0; id < data->GetNumberOfPoints(); ++id)
  {
    data->GetPoint(id, positions[id].data());
  }
  std::sort(positions.begin(), positions.end());
  return positions;
}

vtkIdType CountDistinct(vtkPolyData* data)
{
  const std::vector<Vector> all = Positions(data);
  vtkIdType count = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    count += i == 0 || all[i] != all[i - 1];
  }
  return count;
}

bool AreUnit(vtkDataArray* normals)
{
  for (vtkIdType id = 0; id < normals->GetNumberOfTuples(); ++id)
  {
    if (!(std::abs(vtkMath::Norm(normals->GetTuple(id)) - 1.0) < 1e-5))
    {
      return false;
    }
  }
  return true;
}

bool IsSame(vtkDataArray* a, vtkDataArray* b)
{
  if (a->GetNumberOfValues() != b->GetNumberOfValues())
  {
    return false;
  }
  for (vtkIdType i = 0; i < a->GetNumberOfValues(); ++i)
  {
    const int components = a->GetNumberOfComponents();
    if (a->GetComponent(i / components, i % components) !=
      b->GetComponent(i / components, i % components))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
struct Errors
{
  double Distance = 0.0;
  double Angle = 0.0; // degrees
};

Errors Measure(const Surface& surface, int n, Frame frame)
{
  Image image = Sample(MakeGrid(n, frame), surface.Value);
  auto cloud = Points(image, 0.0);
  vtkDataArray* normals = cloud->GetPointData()->GetNormals();
  Errors errors;
  for (vtkIdType id = 0; id < cloud->GetNumberOfPoints(); ++id)
  {
    Vector x;
    cloud->GetPoint(id, x.data());
    errors.Distance = std::max(errors.Distance, std::abs(surface.Distance(x)));
    // At the border gradients are of first order only.
    int ijk[3];
    double pcoords[3];
    image->ComputeStructuredCoordinates(x.data(), ijk, pcoords);
    bool interior = true;
    for (int c = 0; c < 3; ++c)
    {
      interior = interior && ijk[c] > image->GetExtent()[2 * c] + 1 &&
        ijk[c] < image->GetExtent()[2 * c + 1] - 2;
    }
    if (interior)
    {
      const double cosine = vtkMath::Dot(surface.Normal(x).data(), normals->GetTuple(id));
      errors.Angle =
        std::max(errors.Angle, vtkMath::DegreesFromRadians(std::acos(std::min(1.0, cosine))));
    }
  }
  return errors;
}

void TestAccuracy(PointSurfaceTest::Checks& check)
{
  for (const Surface& surface : { Sphere, Torus, Gyroid })
  {
    for (Frame frame : { Frame::Plain, Frame::Oblique })
    {
      const std::string name =
        std::string(surface.Name) + (frame == Frame::Plain ? "" : ", oblique grid");
      const Errors coarse = Measure(surface, 33, frame);
      const Errors fine = Measure(surface, 65, frame);
      check.AtMost(fine.Distance, 0.003, name + ": largest distance to the surface");
      check.AtMost(fine.Angle, 1.5, name + ": largest angle to the normal, degrees");
      check.AtMost(fine.Distance, coarse.Distance / 3.0, name + ": distance shrinks as h^2");
      check.AtMost(fine.Angle, coarse.Angle / 3.0, name + ": angle shrinks as h^2");
    }
  }
}

//------------------------------------------------------------------------------
void TestAgainstFlyingEdges(PointSurfaceTest::Checks& check)
{
  // Widths about the 64 voxels that are looked at together.
  for (int n : { 2, 3, 40, 63, 64, 65, 66 })
  {
    Image image = MakeNoise(n, 100, VTK_DOUBLE);
    image->SetOrigin(0, 0, 0);
    image->SetSpacing(1, 1, 1);
    auto cloud = Points(image, 49.5);
    auto mesh = Mesh(image, 49.5);
    check(cloud->GetNumberOfPoints() > 0 && Positions(cloud) == Positions(mesh),
      "noise, " + std::to_string(n) + " voxels wide: the vertices of flying edges");
  }
  Image gyroid = Sample(MakeGrid(50, Frame::Oblique), Gyroid.Value, VTK_FLOAT);
  check(Points(gyroid, 0.1)->GetNumberOfPoints() == Mesh(gyroid, 0.1)->GetNumberOfPoints(),
    "gyroid: as many points as flying edges has");
  check(Points(gyroid, 0.1)->GetNumberOfCells() == 0, "no cells");
  double bounds[6];
  Points(Sample(MakeGrid(65, Frame::Plain), Sphere.Value), 0.0)->GetBounds(bounds);
  check(std::abs(bounds[0] + 1.0) < 0.01 && std::abs(bounds[5] - 1.0) < 0.01, "bounds");
}

//------------------------------------------------------------------------------
void TestCoincident(PointSurfaceTest::Checks& check)
{
  for (int type : { VTK_UNSIGNED_CHAR, VTK_DOUBLE })
  {
    Image image = MakeNoise(30, 4, type);
    auto cloud = Points(image, 2.0);
    auto mesh = Mesh(image, 2.0);
    check(CountDistinct(mesh) < mesh->GetNumberOfPoints(), "flying edges has coincident points");
    check(CountDistinct(cloud) == cloud->GetNumberOfPoints(), "no coincident points");
    check(CountDistinct(mesh) == cloud->GetNumberOfPoints(), "each position of flying edges");
    check(AreUnit(cloud->GetPointData()->GetNormals()), "unit normals at voxels of the isovalue");
  }
  // A hair above the isovalue single precision cannot tell crossings from the voxel, double can.
  Image image = Sample(MakeGrid(20, Frame::Oblique),
    [](const Vector& x) { return std::floor(4 * Gyroid.Value(x)) + 1e-9; });
  auto cloud = Points(image, 1.0);
  check(CountDistinct(cloud) == cloud->GetNumberOfPoints(), "no points that rounding makes equal");
  vtkNew<vtkIsosurfacePoints> filter;
  filter->SetInputData(image);
  filter->SetValue(0, 1.0);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  check(filter->GetOutput()->GetNumberOfPoints() > cloud->GetNumberOfPoints() &&
      CountDistinct(filter->GetOutput()) == Mesh(image, 1.0)->GetNumberOfPoints(),
    "all of them in double precision");
}

//------------------------------------------------------------------------------
// The largest distance from the mesh to its nearest point, in units of that point's radius and
// minimised over the points. Distances within the tangent planes, if asked for.
double LargestGap(vtkPolyData* mesh, vtkPolyData* cloud, bool discs)
{
  vtkDataArray* radii = cloud->GetPointData()->GetArray("radius");
  vtkDataArray* normals = cloud->GetPointData()->GetNormals();
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  vtkNew<vtkIdList> near;
  double largest = 0.0;
  const vtkIdType* corners;
  vtkIdType count;
  for (mesh->GetPolys()->InitTraversal(); mesh->GetPolys()->GetNextCell(count, corners);)
  {
    double p[3][3];
    for (int c = 0; c < 3; ++c)
    {
      mesh->GetPoint(corners[c], p[c]);
    }
    const int steps = 4;
    for (int a = 0; a <= steps; ++a)
    {
      for (int b = 0; a + b <= steps; ++b)
      {
        Vector x;
        for (int c = 0; c < 3; ++c)
        {
          x[c] = (a * p[0][c] + b * p[1][c] + (steps - a - b) * p[2][c]) / steps;
        }
        locator->FindPointsWithinRadius(radii->GetRange()[1] * 1.001, x.data(), near);
        double smallest = 1e30;
        for (vtkIdType i = 0; i < near->GetNumberOfIds(); ++i)
        {
          const vtkIdType id = near->GetId(i);
          Vector d;
          cloud->GetPoint(id, d.data());
          vtkMath::Subtract(x.data(), d.data(), d.data());
          double distance2 = vtkMath::Dot(d.data(), d.data());
          if (discs)
          {
            const double height = vtkMath::Dot(d.data(), normals->GetTuple(id));
            distance2 =
              std::abs(height) < 0.5 * radii->GetTuple1(id) ? distance2 - height * height : 1e30;
          }
          smallest = std::min(smallest, std::sqrt(distance2) / radii->GetTuple1(id));
        }
        largest = std::max(largest, smallest);
      }
    }
  }
  return largest;
}

void TestRadii(PointSurfaceTest::Checks& check)
{
  struct Case
  {
    std::string Name;
    Image Volume;
    double Isovalue;
    bool Smooth;
  };
  for (const Case& c :
    { Case{ "sphere", Sample(MakeGrid(16, Frame::Plain), Sphere.Value), 0.0, true },
      Case{ "torus, oblique grid", Sample(MakeGrid(24, Frame::Oblique), Torus.Value), 0.0, true },
      Case{ "noise", MakeNoise(10, 100, VTK_DOUBLE), 49.5, false },
      Case{ "labels", MakeNoise(10, 3, VTK_UNSIGNED_CHAR), 1.0, false } })
  {
    auto mesh = Mesh(c.Volume, c.Isovalue);
    auto cloud = Points(c.Volume, c.Isovalue);
    const double gap = LargestGap(mesh, cloud, false);
    check.AtMost(gap, 1.0 + 1e-4, c.Name + ": balls cover the mesh");
    check(gap > 0.6, c.Name + ": balls of 0.6 of the radius do not");
    if (c.Smooth)
    {
      const double discGap = LargestGap(mesh, cloud, true);
      check.AtMost(discGap, 1.0 + 1e-4, c.Name + ": discs cover the mesh");
      check(discGap > 0.6, c.Name + ": discs of 0.6 of the radius do not");
    }
    check(
      cloud->GetPointData()->GetArray("radius")->GetRange()[0] > 0.0, c.Name + ": no radius is 0");
  }
  // A plane across the voxels of an anisotropic grid: half the diagonal of its cells.
  Image plane = Image::New();
  plane->SetDimensions(9, 9, 9);
  plane->SetSpacing(3, 4, 12);
  auto cloud = Points(Sample(plane, [](const Vector& x) { return x[2]; }), 40.0);
  const double* range = cloud->GetPointData()->GetArray("radius")->GetRange();
  check(std::abs(range[0] - 2.5) < 1e-5 && std::abs(range[1] - 2.5) < 1e-5, "radii of a plane");
}

//------------------------------------------------------------------------------
void TestThreads(PointSurfaceTest::Checks& check)
{
  Image image = MakeNoise(70, 5, VTK_FLOAT);
  check(PointSurfaceTest::IsSameForAnyThreads(
          [&]
          {
            auto cloud = Points(image, 2.0);
            return std::vector<vtkSmartPointer<vtkDataArray>>{ cloud->GetPoints()->GetData(),
              cloud->GetPointData()->GetNormals(), cloud->GetPointData()->GetArray("radius") };
          }),
    "the same bits for any backend and number of threads");
}

//------------------------------------------------------------------------------
void TestTypes(PointSurfaceTest::Checks& check)
{
  const auto field = [](const Vector& x) { return std::floor(60 + 20 * Gyroid.Value(x)); };
  for (double isovalue : { 57.5, 60.0 })
  {
    auto expected = Points(Sample(MakeGrid(25, Frame::Plain), field), isovalue);
    for (int type : { VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT,
           VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG,
           VTK_UNSIGNED_LONG_LONG, VTK_ID_TYPE, VTK_FLOAT })
    {
      auto cloud = Points(Sample(MakeGrid(25, Frame::Plain), field, type), isovalue);
      check(expected->GetNumberOfPoints() > 0 &&
          IsSame(cloud->GetPoints()->GetData(), expected->GetPoints()->GetData()),
        std::string("points from ") + vtkImageScalarTypeNameMacro(type));
    }
  }
  Image bits = MakeNoise(12, 2, VTK_UNSIGNED_CHAR);
  auto expected = Points(bits, 0.5);
  vtkNew<vtkBitArray> array;
  array->DeepCopy(bits->GetPointData()->GetScalars());
  bits->GetPointData()->SetScalars(array);
  check(IsSame(Points(bits, 0.5)->GetPoints()->GetData(), expected->GetPoints()->GetData()),
    "points from bits");
  // Isovalues beyond what small types hold.
  Image bytes = MakeNoise(12, 200, VTK_UNSIGNED_CHAR);
  for (double isovalue : { -1.0, 0.0, 255.5, 1e300, -1e300 })
  {
    check(Points(bytes, isovalue)->GetNumberOfPoints() == 0, "isovalue out of range");
  }
}

//------------------------------------------------------------------------------
void TestOptions(PointSurfaceTest::Checks& check)
{
  Image image = Sample(MakeGrid(25, Frame::Plain), Torus.Value, VTK_FLOAT);
  vtkNew<vtkIsosurfacePoints> filter;
  filter->SetInputData(image);
  filter->GenerateValues(3, -0.1, 0.1);
  filter->ComputeScalarsOn();
  filter->Update();
  vtkPolyData* all = filter->GetOutput();
  vtkIdType id = 0;
  bool same = true;
  for (double isovalue : { -0.1, 0.0, 0.1 })
  {
    auto one = Points(image, isovalue);
    for (vtkIdType i = 0; i < one->GetNumberOfPoints() && id < all->GetNumberOfPoints(); ++i, ++id)
    {
      for (int c = 0; c < 3; ++c)
      {
        same = same && one->GetPoint(i)[c] == all->GetPoint(id)[c];
      }
      same = same && all->GetPointData()->GetScalars()->GetTuple1(id) == isovalue;
    }
  }
  check(same && id == all->GetNumberOfPoints(), "three isovalues, one after the other");
  check(std::string(all->GetPointData()->GetScalars()->GetName()) == "field", "name of scalars");
  check(Points(image, 0.0)->GetPointData()->GetScalars() == nullptr, "no scalars unless asked");

  // An array that holds the coordinates is interpolated to the points themselves, in two contours.
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName("coordinates");
  coordinates->SetNumberOfComponents(3);
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    coordinates->InsertNextTuple(image->GetPoint(voxel));
  }
  image->GetPointData()->AddArray(coordinates);
  filter->SetNumberOfContours(2);
  filter->InterpolateAttributesOn();
  filter->Update();
  vtkDataArray* interpolated = all->GetPointData()->GetArray("coordinates");
  double largest =
    interpolated && interpolated->GetNumberOfTuples() == all->GetNumberOfPoints() ? 0.0 : 1e30;
  for (vtkIdType i = 0; largest < 1e30 && i < all->GetNumberOfPoints(); ++i)
  {
    Vector x;
    all->GetPoint(i, x.data());
    largest =
      std::max(largest, vtkMath::Distance2BetweenPoints(x.data(), interpolated->GetTuple(i)));
  }
  check.AtMost(largest, 1e-11, "interpolated coordinates");

  vtkNew<vtkIsosurfacePoints> flipped;
  flipped->SetInputData(image);
  flipped->FlipNormalsOn();
  flipped->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  flipped->Update();
  auto plain = Points(image, 0.0);
  check(flipped->GetOutput()->GetPoints()->GetDataType() == VTK_DOUBLE &&
      plain->GetPoints()->GetDataType() == VTK_FLOAT,
    "precision of the points");
  bool turned = plain->GetNumberOfPoints() > 0;
  for (vtkIdType i = 0; i < plain->GetNumberOfPoints(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      turned = turned &&
        plain->GetPointData()->GetNormals()->GetComponent(i, c) ==
          -flipped->GetOutput()->GetPointData()->GetNormals()->GetComponent(i, c);
    }
  }
  check(turned, "flipped normals");

  // A component of several.
  Image vectors = Sample(MakeGrid(25, Frame::Plain), Torus.Value, VTK_FLOAT);
  vectors->GetPointData()->AddArray(coordinates);
  vtkNew<vtkIsosurfacePoints> component;
  PointSurfaceTest::Messages none(component);
  component->SetInputData(vectors);
  component->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "coordinates");
  component->SetArrayComponent(1);
  component->SetValue(0, 0.3);
  component->Update();
  double bounds[6];
  component->GetOutput()->GetBounds(bounds);
  check(component->GetOutput()->GetNumberOfPoints() == 25 * 25 &&
      std::abs(bounds[2] - 0.3) < 1e-6 && std::abs(bounds[3] - 0.3) < 1e-6,
    "the second component");
  check(PointSurfaceTest::Abort(component), "progress is reported");
  check(component->GetOutput()->GetNumberOfPoints() == 0, "nothing comes out of an aborted filter");
  check(none.GetCount() == 0, "no messages");
}

//------------------------------------------------------------------------------
void TestFlatGradients(PointSurfaceTest::Checks& check)
{
  // A single voxel: all six central differences about it vanish at its own place.
  Image image = Image::New();
  image->SetDimensions(5, 5, 5);
  image->SetSpacing(1, 2, 3);
  image->SetDirectionMatrix(0, 1, 0, -1, 0, 0, 0, 0, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  image->GetPointData()->GetScalars()->Fill(0);
  image->SetScalarComponentFromDouble(2, 2, 2, 0, 1);
  auto cloud = Points(image, 1e-9); // at the neighbours, whose differences are not flat
  check(cloud->GetNumberOfPoints() == 6, "six points about a voxel");
  cloud = Points(image, 1.0 - 1e-5);
  Vector center;
  image->GetPoint(62, center.data());
  bool outward = cloud->GetNumberOfPoints() == 6;
  for (vtkIdType id = 0; id < cloud->GetNumberOfPoints(); ++id)
  {
    Vector d;
    cloud->GetPoint(id, d.data());
    vtkMath::Subtract(d.data(), center.data(), d.data());
    outward = outward &&
      vtkMath::Dot(Unit(d).data(), cloud->GetPointData()->GetNormals()->GetTuple(id)) > 0.999;
  }
  check(outward, "normals of a single voxel point outward");
  check(Points(image, 1.0)->GetNumberOfPoints() == 1, "one point for a voxel of the isovalue");

  // Alternating voxels have no central differences at all but at the border.
  Image checkers = Sample(
    MakeGrid(9, Frame::Oblique), [](const Vector&) { return 0.0; }, VTK_INT);
  for (vtkIdType id = 0; id < checkers->GetNumberOfPoints(); ++id)
  {
    checkers->GetPointData()->GetScalars()->SetTuple1(id, id % 2);
  }
  check(AreUnit(Points(checkers, 0.5)->GetPointData()->GetNormals()), "unit normals on checkers");
  check(AreUnit(Points(MakeNoise(20, 3, VTK_CHAR), 0.5)->GetPointData()->GetNormals()),
    "unit normals on labels");
  // Differences too small and too large to square.
  for (double scale : { 1e-250, 1e-30, 1e250 })
  {
    Image scaled = Sample(
      MakeGrid(17, Frame::Plain), [scale](const Vector& x) { return scale * Sphere.Value(x); });
    auto points = Points(scaled, 0.0);
    bool good = points->GetNumberOfPoints() > 0;
    for (vtkIdType id = 0; id < points->GetNumberOfPoints(); ++id)
    {
      Vector x;
      points->GetPoint(id, x.data());
      good = good &&
        vtkMath::Dot(Unit(x).data(), points->GetPointData()->GetNormals()->GetTuple(id)) > 0.99;
    }
    check(good, "normals of a field of scale " + std::to_string(std::log10(scale)));
  }
}

//------------------------------------------------------------------------------
// One message that holds the text, and no points.
void CheckRefusal(PointSurfaceTest::Checks& check, vtkIsosurfacePoints* filter, const char* text)
{
  PointSurfaceTest::Messages messages(filter);
  filter->Update();
  check(messages.Contain(text), std::string("one message with '") + text + "'");
  check(filter->GetOutput()->GetNumberOfPoints() == 0, std::string("no points: ") + text);
}

void TestFaults(PointSurfaceTest::Checks& check)
{
  vtkNew<vtkIsosurfacePoints> filter;
  PointSurfaceTest::Messages none(filter);
  Image image = MakeNoise(8, 10, VTK_SHORT);
  filter->SetInputData(image);
  filter->SetValue(0, 1000);
  filter->Update();
  check(filter->GetOutput()->GetNumberOfPoints() == 0 && none.GetCount() == 0,
    "an isovalue that no voxel has is no fault");
  Image nothing = Image::New();
  filter->SetInputData(nothing);
  filter->Update();
  check(none.GetCount() == 0, "an empty image is no fault");

  vtkNew<vtkIsosurfacePoints> slice;
  Image flat = Image::New();
  flat->SetDimensions(8, 8, 1);
  slice->SetInputData(Sample(flat, [](const Vector& x) { return x[0]; }));
  CheckRefusal(check, slice, "8 x 8 x 1");

  vtkNew<vtkIsosurfacePoints> bare;
  bare->SetInputData(MakeGrid(4, Frame::Plain));
  CheckRefusal(check, bare, "SetInputArrayToProcess");

  vtkNew<vtkIsosurfacePoints> component;
  component->SetInputData(image);
  component->SetArrayComponent(1);
  CheckRefusal(check, component, "array 'field' has 1");

  vtkNew<vtkIsosurfacePoints> length;
  Image shortened = MakeGrid(4, Frame::Plain);
  vtkNew<vtkFloatArray> few;
  few->SetName("few");
  few->SetNumberOfTuples(5);
  shortened->GetPointData()->SetScalars(few);
  length->SetInputData(shortened);
  CheckRefusal(check, length, "array 'few' has 5");

  vtkNew<vtkIsosurfacePoints> undefined;
  undefined->SetInputData(image);
  undefined->SetValue(0, std::numeric_limits<double>::quiet_NaN());
  CheckRefusal(check, undefined, "isovalue");

  Image spaceless = MakeNoise(8, 10, VTK_SHORT);
  spaceless->SetSpacing(1, 0, 1);
  vtkNew<vtkIsosurfacePoints> degenerate;
  degenerate->SetInputData(spaceless);
  CheckRefusal(check, degenerate, "spacing");

  Image far = Sample(MakeGrid(17, Frame::Plain), Sphere.Value);
  far->SetOrigin(1e7, 0, 0);
  vtkNew<vtkIsosurfacePoints> single;
  single->SetInputData(far);
  PointSurfaceTest::Messages messages(single);
  single->Update();
  check(messages.Contain("SetOutputPointsPrecision"), "a far origin is warned of");
  single->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  single->Update();
  check(messages.GetCount() == 1, "but not in double precision");
}

//------------------------------------------------------------------------------
void TestNotFinite(PointSurfaceTest::Checks& check)
{
  for (int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    Image image = Sample(MakeGrid(40, Frame::Plain), Sphere.Value, type);
    auto whole = Points(image, 0.0);
    // A column of voxels that cuts the surface twice.
    std::set<vtkIdType> holes;
    for (int k = 0; k < 40; ++k)
    {
      const vtkIdType id = 20 + 40 * (20 + 40 * k);
      holes.insert(id);
      image->GetPointData()->GetScalars()->SetTuple1(id,
        k % 2 ? std::numeric_limits<double>::quiet_NaN() : std::numeric_limits<double>::infinity());
    }
    vtkNew<vtkIsosurfacePoints> filter;
    filter->SetInputData(image);
    PointSurfaceTest::Messages messages(filter);
    filter->Update();
    check(messages.Contain("array 'field' has 40"), "one warning with name and count");
    vtkPolyData* cloud = filter->GetOutput();

    // What is left are the points whose edge does not end in such a voxel.
    std::vector<Vector> expected;
    for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i)
    {
      Vector x;
      whole->GetPoint(i, x.data());
      bool kept = true;
      for (int end : { 0, 1 })
      {
        int ijk[3];
        double spacing = image->GetSpacing()[0];
        for (int c = 0; c < 3; ++c)
        {
          const double index = (x[c] + 1.5) / spacing;
          // Float32 coordinates of voxels are off by rounding.
          ijk[c] = static_cast<int>(end ? std::ceil(index - 1e-4) : std::floor(index + 1e-4));
        }
        kept = kept && holes.count(ijk[0] + 40 * (ijk[1] + 40 * ijk[2])) == 0;
      }
      if (kept)
      {
        expected.push_back(x);
      }
    }
    std::sort(expected.begin(), expected.end());
    check(expected.size() < Positions(whole).size() && Positions(cloud) == expected,
      "the points of all other edges");
    check(AreUnit(cloud->GetPointData()->GetNormals()), "unit normals beside undefined voxels");
    double worst = 1.0;
    for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
    {
      Vector x;
      cloud->GetPoint(i, x.data());
      worst = std::min(
        worst, vtkMath::Dot(Unit(x).data(), cloud->GetPointData()->GetNormals()->GetTuple(i)));
    }
    check.AtMost(1.0 - worst, 0.01, "one-sided differences beside undefined voxels");
    const double* range = cloud->GetPointData()->GetArray("radius")->GetRange();
    check(range[0] > 0.0 && range[1] < 0.2, "radii beside undefined voxels");
  }
}
} // anonymous namespace

int TestIsosurfacePoints(int, char*[])
{
  PointSurfaceTest::Checks check;
  TestAccuracy(check);
  TestAgainstFlyingEdges(check);
  TestCoincident(check);
  TestRadii(check);
  TestThreads(check);
  TestTypes(check);
  TestOptions(check);
  TestFlatGradients(check);
  TestNotFinite(check);
  TestFaults(check);
  return check.GetResult();
}
