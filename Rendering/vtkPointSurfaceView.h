// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointSurfaceView
 * @brief   all of a view of a cloud that a surface buffer is a function of, by value
 *
 * VTK has no frame counter, and a light, an eye of a stereo pair or a tile each have a camera of
 * their own; so two frames have the same surface buffer if and only if their views are equal.
 * Matrices are VTK's with row vectors, as GLSL reads them (M[column][row] = Data[4 column + row]).
 * Eye coordinates are those of vtkEyeFrame: the eye is at the origin and looks along -z.
 */
#ifndef vtkPointSurfaceView_h
#define vtkPointSurfaceView_h

#include "vtkType.h"

#include <algorithm>
#include <array>
#include <vector>

class vtkMatrix4x4;
class vtkSpatialOrder;

struct vtkPointSurfaceView
{
  /// Faces that are dropped, as in vtkProperty.
  enum Culling
  {
    NoCulling,
    BackfaceCulling,
    FrontfaceCulling
  };

  std::array<double, 16> ModelToEye{}; ///< from the points' coordinates to the eye
  std::array<double, 16> MCVC{}; ///< from uploaded coordinates (VBO shift and scale) to the eye
  std::array<double, 16> VCDC{}; ///< from the eye to clip coordinates
  std::array<double, 9> Normal{};
  /// Of the image that the steps work on, in samples, which they call pixels: the viewport and a
  /// rim around it. VCDC is of the whole image too.
  std::array<int, 2> Size{};
  int Supersampling = 1;      ///< samples along each side of a pixel of the viewport
  bool SmoothOutline = false; ///< whether the normals' length is to be a coverage without samples
  std::array<std::array<double, 4>, 6> ClippingPlanes{}; ///< in eye coordinates
  int NumberOfClippingPlanes = 0;
  int Cull = NoCulling;
  /// What is drawn of the points' list: from a position to the one past the last.
  std::vector<std::array<vtkIdType, 2>> Ranges;
  double RadiusScale = 1.0; ///< from the radii's units to eye units
  vtkMTimeType DataTime = 0;
  vtkMTimeType MapperTime = 0;

  // What follows from the above and the cloud's bounds.
  int Rim = 0;                         ///< pixels whose points' discs may reach into the viewport
  std::array<int, 4> Rectangle{};      ///< x, y, width, height in samples: nothing is drawn outside
  std::array<double, 2> DepthRange{};  ///< eye depth between which all points lie
  double LargestRadius = 0.0;          ///< in eye units
  double MeanRadius = 0.0;             ///< in eye units
  double TypicalRadius = 0.0;          ///< in pixels, amid the cloud
  double Diagonal = 0.0;               ///< of the cloud's bounding box, in eye units
  std::array<double, 3> Center{};      ///< of that box, in eye coordinates
  std::array<double, 2> LargestDisc{}; ///< half its width and height in samples, nearest to the eye

  vtkIdType GetNumberOfPoints() const
  {
    vtkIdType count = 0;
    for (const auto& range : this->Ranges)
    {
      count += range[1] - range[0];
    }
    return count;
  }

  /// Makes the points' radii larger by a factor.
  void GrowRadii(double factor)
  {
    for (double* radius : { &this->RadiusScale, &this->LargestRadius, &this->MeanRadius,
           &this->TypicalRadius, &this->LargestDisc[0], &this->LargestDisc[1] })
    {
      *radius *= factor;
    }
  }

  /// Leaves out of the ranges what is outside of the image by more than `reach` (in eye units) and
  /// a few pixels, or outside of the clipping range, by chunks of the order that the points are in.
  void LeaveOutUnseen(const vtkSpatialOrder& order, double reach);

  bool IsParallel() const { return this->VCDC[11] == 0.0; }

  /// The largest factor by which a matrix (row vectors) stretches an axis.
  static double GetLargestStretch(vtkMatrix4x4* matrix);

  /// Sets what follows, but for the largest and the mean radius, from the bounds of the cloud in
  /// model coordinates. All else is set, size and VCDC for the viewport alone: a rim of `rim` of
  /// the largest radii is added to them where the cloud goes on outside. An image has `largestSize`
  /// samples along a side at most.
  void SetExtent(vtkMatrix4x4* modelToEye, const double bounds[6], double rim, int largestSize);

  /// The rectangle in pixels of the image: x, y, width, height.
  std::array<int, 4> GetPixelRectangle() const
  {
    std::array<int, 4> pixels;
    for (int k = 0; k < 2; ++k)
    {
      const int end = this->Rectangle[k] + this->Rectangle[2 + k];
      pixels[k] = this->Rectangle[k] / this->Supersampling;
      pixels[2 + k] = (end + this->Supersampling - 1) / this->Supersampling - pixels[k];
    }
    return pixels;
  }

  /// The part of it within the viewport, in pixels of the viewport: x, y, width, height.
  std::array<int, 4> GetViewportRectangle() const
  {
    const std::array<int, 4> pixels = this->GetPixelRectangle();
    std::array<int, 4> visible;
    for (int k = 0; k < 2; ++k)
    {
      const int size = this->Size[k] / this->Supersampling - 2 * this->Rim;
      const int begin = std::min(std::max(pixels[k] - this->Rim, 0), size);
      const int end = std::min(pixels[k] + pixels[2 + k] - this->Rim, size);
      visible[k] = begin;
      visible[2 + k] = std::max(end - begin, 0);
    }
    return visible;
  }

  bool operator==(const vtkPointSurfaceView& other) const
  {
    return this->MCVC == other.MCVC && this->VCDC == other.VCDC && this->Normal == other.Normal &&
      this->Size == other.Size && this->Supersampling == other.Supersampling &&
      this->SmoothOutline == other.SmoothOutline && this->ClippingPlanes == other.ClippingPlanes &&
      this->NumberOfClippingPlanes == other.NumberOfClippingPlanes && this->Cull == other.Cull &&
      this->Ranges == other.Ranges && this->RadiusScale == other.RadiusScale &&
      this->DataTime == other.DataTime && this->MapperTime == other.MapperTime;
  }

private:
  void AddRim(double width, int largestSize);
};

#endif
