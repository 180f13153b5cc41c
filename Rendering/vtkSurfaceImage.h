// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceImage
 * @brief   the layers of vtkSurfaceTarget in memory, as the CPU form of a step works on them
 *
 * Shape, Interval and Color lie in planes of one float a pixel, row by row: all planes of a row,
 * then the next row, so that neighbours in an image are neighbours in memory and a loop along a
 * row runs over plain arrays. Pixels are counted as in the viewport; only those of a rectangle are
 * worked on, and a rim of a block around it reads as invalid. A block is a run of pixels of a row
 * with a flag, so that steps pass over what is empty.
 */
#ifndef vtkSurfaceImage_h
#define vtkSurfaceImage_h

#include "vtkSurfaceTarget.h" // for Layer

#include <array>
#include <vector>

struct vtkSurfacePixels;

class vtkSurfaceImage
{
public:
  enum Plane
  {
    NormalX, ///< Shape
    NormalY,
    NormalZ,
    Radius,    ///< in eye units, 0 where the pixel is invalid
    IntervalX, ///< Interval
    IntervalY,
    CenterX,
    CenterY,
    Red, ///< Color
    Green,
    Blue,
    Alpha,
    NumberOfPlanes
  };
  static constexpr int NumberOfShapePlanes = Red; ///< of Shape and Interval
  static constexpr int BlockSize = 8;             ///< pixels in a block

  using Rectangle = std::array<int, 4>; ///< x, y, x end, y end

  /**
   * Makes the image `width` x `height`, with the layers Shape and Interval, and Id and Color if
   * asked, and everything around `rectangle` invalid. What is inside is undefined.
   */
  void Allocate(int width, int height, const Rectangle& rectangle, bool ids, bool colors);

  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }
  const Rectangle& GetRectangle() const { return this->Bounds; }
  int GetNumberOfPlanes() const { return this->Planes; }
  bool HasIds() const { return this->WithIds; }
  bool HasColors() const { return this->Planes == NumberOfPlanes; }

  ///@{
  /**
   * Blocks that hold the rectangle's columns: [begin, end).
   */
  int GetBlockBegin() const { return this->Bounds[0] / BlockSize; }
  int GetBlockEnd() const { return (this->Bounds[2] + BlockSize - 1) / BlockSize; }
  ///@}

  ///@{
  /**
   * Of the pixel (0, y): one plane, the ids + 1; of the block (0, y): whether it may hold a valid
   * pixel. Rows from -1 to height, pixels from -BlockSize to width + BlockSize exist.
   */
  float* GetRow(int y, int plane)
  {
    return &this->Values[(static_cast<size_t>(y + 1) * this->Planes + plane) * this->Stride +
      BlockSize];
  }
  unsigned int* GetIds(int y)
  {
    return &this->Ids[static_cast<size_t>(y + 1) * this->Stride + BlockSize];
  }
  unsigned char* GetOccupied(int y)
  {
    return &this->Occupied[static_cast<size_t>(y + 1) * (this->Stride / BlockSize) + 1];
  }
  ///@}

  /**
   * Floats from a pixel's place in a plane to its place in the next one.
   */
  size_t GetPlaneStride() const { return static_cast<size_t>(this->Stride); }

  /**
   * Makes blocks [begin, end) of a row invalid.
   */
  void ClearBlocks(int y, int begin, int end);

  /**
   * Makes a surface buffer of the projected points as they are: their normals, least depths, ids
   * and colours.
   */
  void ReadSurface(vtkSurfacePixels& pixels);

  ///@{
  /**
   * Copies a layer, from the lower left pixel on: four floats or one id + 1 a pixel, 0 where the
   * pixel is invalid.
   */
  std::vector<float> ReadFloats(vtkSurfaceTarget::Layer layer);
  std::vector<unsigned int> ReadIds();
  ///@}

private:
  int Width = 0;
  int Height = 0;
  int Stride = 0; // pixels from a row of a plane to the next plane
  int Planes = 0;
  bool WithIds = false;
  Rectangle Bounds{};
  std::vector<float> Values;
  std::vector<unsigned int> Ids;
  std::vector<unsigned char> Occupied;
};

#endif
