// SPDX-License-Identifier: BSD-3-Clause
// The reference of the pull-push reconstruction against cases computed by hand.
#include "PullPushReference.h"
#include "SurfaceBufferComparison.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <cmath>
#include <iostream>
#include <stdexcept>
#include <string>

using Image = PullPushReference::Image;
using Matrix = PullPushReference::Matrix;
using Pixel = PullPushReference::Pixel;

namespace
{
const std::array<double, 3> FACING = { 0.0, 0.0, 1.0 };
int Failures = 0;

void Check(bool holds, const std::string& what)
{
  if (!holds)
  {
    std::cerr << "Failed: " << what << "\n";
    ++Failures;
  }
}

void CheckNear(double actual, double expected, const std::string& what)
{
  Check(std::abs(actual - expected) <= 1e-12,
    what + ": " + std::to_string(actual) + " instead of " + std::to_string(expected));
}

// A parallel projection in which a pixel is one eye unit wide and high.
Matrix OneUnitPerPixel(const Image& image)
{
  return { 2.0 / image.GetWidth(), 0, 0, 0, 0, 2.0 / image.GetHeight(), 0, 0, 0, 0, -1, 0, 0, 0, 0,
    1 };
}

PullPushReference Reconstruct(const Image& image, int levels)
{
  return PullPushReference(image, OneUnitPerPixel(image), levels);
}

void TestLevels()
{
  Check(PullPushReference::FullLevels(1, 1) == 0, "no level above 1x1");
  Check(PullPushReference::FullLevels(2, 2) == 1, "one level above 2x2");
  Check(PullPushReference::FullLevels(3, 5) == 3, "2x3, 1x2 and 1x1 above 3x5");
  Check(PullPushReference::FullLevels(1024, 1) == 10, "ten levels above 1024x1");
}

void TestOnePixel()
{
  Image image(1, 1);
  Check(!Reconstruct(image, 1).GetResult().At(0, 0).Valid, "nothing comes of nothing");
  image.At(0, 0) = PullPushReference::MakePoint(FACING, 0.5, 5.0, 7);
  for (int levels = 0; levels < 3; ++levels)
  {
    const Pixel pixel = Reconstruct(image, levels).GetResult().At(0, 0);
    Check(pixel.Valid && !pixel.Recomputed && pixel.Source == 7, "a lone pixel is copied");
    CheckNear(pixel.MinimumDepth, 5.0, "minimum depth of a lone pixel");
    CheckNear(pixel.MaximumDepth, 5.5, "maximum depth of a lone pixel");
  }
}

// A radius of 1.2 pixels reaches the next pixels (distance 1), not the diagonal one (1.41).
void TestOnePointReachesItsNeighbors()
{
  Image image(2, 2);
  image.At(0, 0) = PullPushReference::MakePoint(FACING, 1.2, 5.0, 3);
  image.At(0, 0).Color = { 0.25, 0.5, 0.75, 1.0 };
  const PullPushReference reference = Reconstruct(image, 1);
  const Pixel& coarse = reference.GetLevel(1).At(0, 0);
  CheckNear(coarse.Displacement[0], -0.5, "displacement x of the coarse pixel");
  CheckNear(coarse.Displacement[1], -0.5, "displacement y of the coarse pixel");

  const Pixel& right = reference.GetResult().At(1, 0);
  Check(right.Valid && right.Recomputed && right.Source == 3, "the next pixel is filled");
  Check(reference.GetResult().At(0, 1).Valid, "the pixel above is filled");
  Check(!reference.GetResult().At(1, 1).Valid, "the diagonal pixel is out of reach");
  CheckNear(right.Displacement[0], -1.0, "displacement x of the filled pixel");
  CheckNear(right.Displacement[1], 0.0, "displacement y of the filled pixel");
  CheckNear(right.MinimumDepth, 5.0, "depth of the filled pixel");
  CheckNear(right.MaximumDepth, 6.2, "maximum depth of the filled pixel");
  CheckNear(right.Color[2], 0.75, "colour of the filled pixel");
  Check(!right.NearDecision, "1 against 1.2 is no close call");
}

void TestPullAverages()
{
  Image image(2, 2);
  image.At(0, 0) = PullPushReference::MakePoint(FACING, 1.0, 5.5, 1);
  image.At(1, 1) = PullPushReference::MakePoint({ 0.6, 0.0, 0.8 }, 2.0, 5.0, 2);
  image.At(1, 0) = PullPushReference::MakePoint(FACING, 50.0, 9.0, 3);
  image.At(0, 0).Color = { 1.0, 0.0, 0.0, 1.0 };
  const PullPushReference reference = Reconstruct(image, 1);
  const Pixel& coarse = reference.GetLevel(1).At(0, 0);
  Check(coarse.Source == 2, "the front child is the source");
  CheckNear(coarse.Radius, 1.5, "radius of the two that are not occluded");
  CheckNear(coarse.MinimumDepth, 5.0, "smallest minimum depth");
  CheckNear(coarse.MaximumDepth, 7.0, "largest maximum depth of those that are not occluded");
  CheckNear(coarse.Displacement[0], 0.0, "displacements of opposite children");
  CheckNear(coarse.Normal[0], 0.6 / std::sqrt(3.6), "normalised sum of the normals, x");
  CheckNear(coarse.Normal[2], 1.8 / std::sqrt(3.6), "normalised sum of the normals, z");
  CheckNear(coarse.Color[0], 0.5, "colour");
}

void TestTiesAndCancellingNormals()
{
  Image image(2, 2);
  image.At(1, 0) = PullPushReference::MakePoint({ 1.0, 0.0, 0.0 }, 1.0, 5.0, 1);
  image.At(0, 1) = PullPushReference::MakePoint({ -1.0, 0.0, 0.0 }, 1.0, 5.0, 2);
  const PullPushReference reference = Reconstruct(image, 1);
  const Pixel& coarse = reference.GetLevel(1).At(0, 0);
  Check(coarse.Source == 1, "of two equal depths the first in order is in front");
  CheckNear(coarse.Normal[0], 1.0, "normals that cancel give way to the front child's");
}

// One point through a pyramid of sizes 3x5, 2x3, 1x2 and 1x1.
void TestOddSizes()
{
  Image image(3, 5);
  image.At(2, 4) = PullPushReference::MakePoint(FACING, 100.0, 5.0, 1);
  const PullPushReference reference = Reconstruct(image, 3);
  const double displacements[4][2] = { { 0.0, 0.0 }, { -0.5, -0.5 }, { 0.5, -1.5 }, { -1.5, 0.5 } };
  const int pixels[4][2] = { { 2, 4 }, { 1, 2 }, { 0, 1 }, { 0, 0 } };
  for (int level = 0; level < 4; ++level)
  {
    const Pixel& pixel = reference.GetLevel(level).At(pixels[level][0], pixels[level][1]);
    const std::string where = " at level " + std::to_string(level);
    CheckNear(pixel.Displacement[0], displacements[level][0], "displacement x" + where);
    CheckNear(pixel.Displacement[1], displacements[level][1], "displacement y" + where);
  }
  for (int y = 0; y < 5; ++y)
  {
    for (int x = 0; x < 3; ++x)
    {
      const Pixel& pixel = reference.GetResult().At(x, y);
      Check(pixel.Valid, "a large disc covers every pixel");
      CheckNear(pixel.Displacement[0], 2.0 - x, "displacement x to the one point");
      CheckNear(pixel.Displacement[1], 4.0 - y, "displacement y to the one point");
      CheckNear(pixel.MinimumDepth, 5.0, "depth of the one point");
    }
  }
}

// Figure 5: one of the four coarser pixels does not reach the centre of the finer one.
void TestFigure5()
{
  Image image(4, 4);
  image.At(0, 0) = PullPushReference::MakePoint(FACING, 3.0, 10.0, 0);
  image.At(3, 0) = PullPushReference::MakePoint(FACING, 1.0, 20.0, 1);
  image.At(0, 3) = PullPushReference::MakePoint(FACING, 3.5, 13.0, 2);
  image.At(3, 3) = PullPushReference::MakePoint({ 0.6, 0.0, 0.8 }, 12.0, 23.0, 3);
  image.At(0, 0).Color[0] = 13.0;
  const PullPushReference reference = Reconstruct(image, 1);
  const Pixel& pixel = reference.GetResult().At(1, 1);
  Check(pixel.Valid && pixel.Source == 0, "the source is the pixel of weight 9/13");
  CheckNear(pixel.MinimumDepth, (9 * 10.0 + 3 * 13.0 + 23.0) / 13.0, "weights 9/13, 3/13, 1/13");
  CheckNear(pixel.MaximumDepth, (9 * 13.0 + 3 * 16.5 + 35.0) / 13.0, "maximum depth");
  CheckNear(pixel.Radius, (9 * 3.0 + 3 * 3.5 + 12.0) / 13.0, "radius");
  CheckNear(pixel.Color[0], 9.0, "colour");
  CheckNear(pixel.Normal[0], 0.6 / std::sqrt(0.36 + 12.8 * 12.8), "normal");
  CheckNear(pixel.Displacement[0], (9 * 0.5 + 3 * 0.5 + 3.5) / 13.0 - 1.5, "displacement x");
  CheckNear(pixel.Displacement[1], (9 * 0.5 + 3 * 3.5 + 3.5) / 13.0 - 1.5, "displacement y");
}

// All four contribute, from each side: 9/16, 3/16 by column, 3/16 by row, 1/16.
void TestWeightsOnEachSide()
{
  Image image(4, 4);
  const int corners[4][2] = { { 0, 0 }, { 3, 0 }, { 0, 3 }, { 3, 3 } };
  const double depths[4] = { 10.0, 20.0, 40.0, 80.0 };
  for (int i = 0; i < 4; ++i)
  {
    image.At(corners[i][0], corners[i][1]) =
      PullPushReference::MakePoint(FACING, 50.0, depths[i], i);
  }
  const Image result = Reconstruct(image, 1).GetResult();
  CheckNear(result.At(1, 1).MinimumDepth, (90.0 + 60.0 + 120.0 + 80.0) / 16.0, "own: (0, 0)");
  CheckNear(result.At(2, 1).MinimumDepth, (180.0 + 30.0 + 240.0 + 40.0) / 16.0, "own: (1, 0)");
  CheckNear(result.At(1, 2).MinimumDepth, (360.0 + 240.0 + 30.0 + 20.0) / 16.0, "own: (0, 1)");
  CheckNear(result.At(2, 2).MinimumDepth, (720.0 + 120.0 + 60.0 + 10.0) / 16.0, "own: (1, 1)");
  Check(result.At(2, 2).Source == 3, "the source is the pixel of weight 9/16");
  // At the image's border there is no neighbour column.
  CheckNear(result.At(3, 1).MinimumDepth, (3 * 20.0 + 80.0) / 4.0, "no column beyond the border");
}

void TestFrontSheetHidesBackPoint()
{
  Image image(4, 4);
  for (int i = 0; i < 16; ++i)
  {
    image.At(i % 4, i / 4) = PullPushReference::MakePoint(FACING, 1.5, 5.0, i);
  }
  image.At(1, 1) = PullPushReference::MakePoint({ 0.6, 0.0, 0.8 }, 1.5, 9.0, 99);
  const Pixel pixel = Reconstruct(image, 2).GetResult().At(1, 1);
  Check(pixel.Recomputed, "the point behind the sheet is recomputed");
  Check(pixel.Source == 0, "its source is the front child of its own coarse pixel");
  CheckNear(pixel.MinimumDepth, 5.0, "its depth is the sheet's");
  CheckNear(pixel.Normal[2], 1.0, "its normal is the sheet's");
}

// Occluded by the interval of the coarse pixel, but out of reach of the front point's disc.
void TestSilhouetteKeepsBackPoint()
{
  Image image(2, 2);
  image.At(0, 0) = PullPushReference::MakePoint(FACING, 0.9, 5.0, 1);
  image.At(1, 0) = PullPushReference::MakePoint(FACING, 0.9, 9.0, 2);
  const Pixel pixel = Reconstruct(image, 1).GetResult().At(1, 0);
  Check(pixel.Valid && !pixel.Recomputed && pixel.Source == 2, "the back point stays");
  CheckNear(pixel.MinimumDepth, 9.0, "with its own depth");
}

// In front of the corresponding coarser pixel is occluded as well: outside of the interval.
void TestInFrontOfIntervalIsRecomputed()
{
  // The coarse pixel (0, 0) of level 1 lies behind the sheet of level 2 and is filled from it, to
  // a depth behind the point's: a far point's own pixel then lies in front of its coarse pixel.
  Image image(8, 4);
  image.At(0, 0) = PullPushReference::MakePoint(FACING, 20.0, 10.0, 0);
  image.At(2, 0) = PullPushReference::MakePoint(FACING, 20.0, 35.0, 1);
  image.At(4, 0) = PullPushReference::MakePoint(FACING, 20.0, 40.0, 2);
  const PullPushReference reference = Reconstruct(image, 2);
  // Level 2: (0, 0) has 10 alone (35 > 30), (1, 0) has 40. Level 1's (1, 0), depth 35, is occluded
  // and becomes (3 * 10 + 40) / 4 = 17.5 to (3 * 30 + 60) / 4 = 37.5: the point at 35 is inside.
  CheckNear(reference.GetLevel(1).At(1, 0).MinimumDepth, 17.5, "recomputed coarse pixel");
  Check(!reference.GetResult().At(2, 0).Recomputed, "inside of the recomputed interval");

  image.At(2, 0) = PullPushReference::MakePoint(FACING, 20.0, 30.5, 1);
  image.At(4, 0) = PullPushReference::MakePoint(FACING, 20.0, 200.0, 2);
  const PullPushReference other = Reconstruct(image, 2);
  CheckNear(other.GetLevel(1).At(1, 0).MinimumDepth, 57.5, "recomputed behind the point");
  Check(other.GetResult().At(2, 0).Recomputed, "in front of the recomputed interval");
}

void TestEllipse()
{
  const Image image(100, 50);
  Pixel pixel = PullPushReference::MakePoint({ 0.8, 0.0, 0.6 }, 1.0, 2.0, 0);
  pixel.Displacement = { 3.0, -2.0 };
  const std::array<double, 2> center = { 20.0, 20.0 };
  bool nearDecision = false;
  const auto contains = [&](const PullPushReference& reference, double x, double y) {
    return reference.EllipseContains(pixel, center, { 23.0 + x, 18.0 + y }, nearDecision);
  };

  const PullPushReference parallel(image, OneUnitPerPixel(image), 0);
  Check(contains(parallel, 0.599, 0.0), "inside the minor axis");
  Check(!contains(parallel, 0.601, 0.0), "outside the minor axis");
  Check(contains(parallel, 0.0, -0.999), "inside the major axis");
  Check(!contains(parallel, 0.0, -1.001), "outside the major axis");

  // At depth 2 the frustum is 2 wide and 4 high: a pixel is 0.02 by 0.08.
  const Matrix projection = { 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0 };
  const PullPushReference perspective(image, projection, 0);
  Check(contains(perspective, 29.9, 0.0), "0.6 is 30 pixels of 0.02");
  Check(!contains(perspective, 30.1, 0.0), "and no more");
  Check(contains(perspective, 0.0, 12.4), "1 is 12.5 pixels of 0.08");
  Check(!contains(perspective, 0.0, 12.6), "and no more");

  pixel.Normal = { 0.0, 1.0, 0.0 };
  Check(contains(parallel, 0.0, 0.0009), "seen edge-on, a thousandth is left");
  Check(!contains(parallel, 0.0, 0.0011), "seen edge-on, no more than that");
  Check(!nearDecision, "none of these is a close call");
  contains(parallel, 1.0 + 1e-6, 0.0);
  Check(nearDecision, "this one is");
}

void TestNearDecisions()
{
  Image image(2, 2);
  image.At(0, 0) = PullPushReference::MakePoint(FACING, 1.0 + 1e-7, 5.0, 1);
  Check(Reconstruct(image, 1).GetResult().At(1, 0).NearDecision, "the ellipse just reaches");
  image.At(0, 0) = PullPushReference::MakePoint(FACING, 1.0 - 1e-7, 5.0, 1);
  const Pixel missed = Reconstruct(image, 1).GetResult().At(1, 0);
  Check(!missed.Valid && missed.NearDecision, "the ellipse just falls short");

  image.At(0, 0) = PullPushReference::MakePoint(FACING, 2.0, 5.0, 1);
  image.At(1, 0) = PullPushReference::MakePoint(FACING, 2.0, 7.0 + 1e-6, 2);
  Check(Reconstruct(image, 1).GetResult().At(1, 1).NearDecision, "just occluded, inherited");
  for (double depth : { 5.0, 5.0 + 1e-6 })
  {
    image.At(1, 0) = PullPushReference::MakePoint(FACING, 2.0, depth, 2);
    for (int i = 0; i < 4; ++i)
    {
      Check(!Reconstruct(image, 1).GetResult().At(i % 2, i / 2).NearDecision,
        "the order of two points' depths is no close call");
    }
  }
}

void AddArray(vtkFieldData* data, vtkDataArray* array, const char* name, int components, int tuples)
{
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Fill(0.0);
  data->AddArray(array);
}

// The comparison must find the faults that are put into a buffer.
void TestComparison()
{
  const int size = 8;
  const int count = size * size;
  vtkNew<vtkImageData> projected;
  projected->SetDimensions(size, size, 1);
  vtkNew<vtkFloatArray> normals, radii, depths, displacements, colors;
  vtkNew<vtkIntArray> ids, levels;
  vtkNew<vtkDoubleArray> matrix;
  AddArray(projected->GetPointData(), normals, "Normals", 3, count);
  AddArray(projected->GetPointData(), radii, "Radius", 1, count);
  AddArray(projected->GetPointData(), depths, "Depth", 1, count);
  AddArray(projected->GetPointData(), displacements, "Displacement", 2, count);
  AddArray(projected->GetPointData(), colors, "Colors", 4, count);
  AddArray(projected->GetPointData(), ids, "PointIds", 1, count);
  AddArray(projected->GetFieldData(), matrix, "Projection", 1, 16);
  AddArray(projected->GetFieldData(), levels, "Levels", 1, 1);
  const Matrix projection = OneUnitPerPixel(Image(size, size));
  std::copy(projection.begin(), projection.end(), matrix->GetPointer(0));
  levels->SetValue(0, 3);
  const int pointPixel = 3 * size + 3;
  normals->SetTuple3(pointPixel, 0.0, 0.0, 1.0);
  radii->SetValue(pointPixel, 1.2f);
  depths->SetValue(pointPixel, 5.0f);
  colors->SetTuple4(pointPixel, 0.2, 0.4, 0.6, 1.0);
  ids->SetValue(pointPixel, 42);

  // The point and its four neighbours, which copy it.
  vtkNew<vtkImageData> surface;
  surface->SetDimensions(size, size, 1);
  vtkNew<vtkFloatArray> surfaceNormals, surfaceDepths, surfaceColors;
  vtkNew<vtkIntArray> surfaceIds;
  AddArray(surface->GetPointData(), surfaceNormals, "Normals", 3, count);
  AddArray(surface->GetPointData(), surfaceDepths, "Depth", 1, count);
  AddArray(surface->GetPointData(), surfaceColors, "Colors", 4, count);
  AddArray(surface->GetPointData(), surfaceIds, "PointIds", 1, count);
  for (int neighbor : { 0, -1, 1, -size, size })
  {
    surfaceNormals->SetTuple3(pointPixel + neighbor, 0.0, 0.0, 1.0);
    surfaceDepths->SetValue(pointPixel + neighbor, 5.0f);
    surfaceColors->SetTuple4(pointPixel + neighbor, 0.2, 0.4, 0.6, 1.0);
    surfaceIds->SetValue(pointPixel + neighbor, 42);
  }
  const SurfaceBufferComparison equal(projected, surface);
  equal.Print(std::cout);
  Check(equal.Agrees() && equal.Covered == 5 && equal.NearDecision == 0, "equal buffers agree");

  const auto expectFault = [&](vtkDataArray* array, int pixel, double value, const char* what)
  {
    const double before = array->GetComponent(pixel, 0);
    array->SetComponent(pixel, 0, value);
    Check(!SurfaceBufferComparison(projected, surface).Agrees(), what);
    array->SetComponent(pixel, 0, before);
  };
  expectFault(surfaceDepths, pointPixel, 5.001, "a wrong depth is found");
  expectFault(surfaceDepths, pointPixel, std::nan(""), "a depth that is not a number is found");
  expectFault(surfaceNormals, pointPixel + 1, 0.001, "a wrong normal is found");
  expectFault(surfaceColors, pointPixel + 1, 0.201, "a wrong colour is found");
  expectFault(surfaceIds, pointPixel - 1, 41, "a wrong source is found");
  expectFault(surfaceDepths, 0, 5.0, "a pixel too many is found");
  expectFault(surfaceDepths, pointPixel + 1, 0.0, "a missing pixel is found");

  surface->GetPointData()->RemoveArray("PointIds");
  try
  {
    SurfaceBufferComparison(projected, surface);
    Check(false, "a missing array is found");
  }
  catch (const std::runtime_error& error)
  {
    Check(std::string(error.what()).find("PointIds") != std::string::npos, "and it is named");
  }
}
}

int TestPullPushReference(int, char*[])
{
  TestLevels();
  TestOnePixel();
  TestOnePointReachesItsNeighbors();
  TestPullAverages();
  TestTiesAndCancellingNormals();
  TestOddSizes();
  TestFigure5();
  TestWeightsOnEachSide();
  TestFrontSheetHidesBackPoint();
  TestSilhouetteKeepsBackPoint();
  TestInFrontOfIntervalIsRecomputed();
  TestEllipse();
  TestNearDecisions();
  TestComparison();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
