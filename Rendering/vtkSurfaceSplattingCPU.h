// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceSplattingCPU
 * @brief   the step from points to a surface buffer by splats, by the processor
 *
 * The same as vtkSurfaceSplattingOpenGL, by tiles of the image that fit into the processor's cache:
 * splats of the front are made and sorted into the tiles that they reach, each tile finds its
 * depths, what of the back is not hidden there is sorted too, and then each tile goes through its
 * splats again, for what is blended at the visible depths. Threaded by vtkSMPTools; the result does
 * not depend on the number of threads.
 */
#ifndef vtkSurfaceSplattingCPU_h
#define vtkSurfaceSplattingCPU_h

#include "vtkPointProjectionCPU.h"

#include <array>
#include <vector>

struct vtkSurfacePixels;
struct vtkSurfaceSplatParameters;

class vtkSurfaceSplattingCPU
{
public:
  vtkSurfaceSplattingCPU();
  ~vtkSurfaceSplattingCPU();

  /**
   * Makes the splats of the clouds' points, and then the `pixels` of the parameters' rectangle,
   * with ids and colours if asked.
   */
  void MakeSplats(const vtkSurfaceSplatParameters& parameters,
    const std::vector<vtkPointProjectionCPU::Cloud>& clouds, bool colors);
  void DrawSplats(
    const vtkSurfaceSplatParameters& parameters, bool ids, bool colors, vtkSurfacePixels& pixels);

  struct Splat;

private:
  vtkSurfaceSplattingCPU(const vtkSurfaceSplattingCPU&) = delete;
  void operator=(const vtkSurfaceSplattingCPU&) = delete;

  /// The pixels whose centres may lie in a splat, the last ones included.
  struct Box
  {
    int X0, Y0, X1, Y1;
  };

  /// What tells which tiles a splat goes into, and whether one of the back is hidden.
  struct Entry
  {
    Box Pixels;
    float Nearest;
    unsigned int Place;
  };

  /// The splats of a group of points in the points' order, and the places there of those that
  /// reach a tile: of the front and of the back.
  struct Group
  {
    std::vector<Splat> Splats; // with room for more
    size_t NumberOfSplats = 0;
    std::vector<std::array<float, 4>> Colors;
    std::vector<Entry> Backs;
    std::array<std::vector<std::vector<unsigned int>>, 2> Tiles;
    void Clear();
    void Reserve(int count);
  };
  class Maker;
  class Tile;

  void Sort(std::vector<std::vector<unsigned int>>& tiles, const Entry& entry) const;
  bool IsHidden(const Entry& back) const;
  void SortBacks(Group& group) const;
  bool IsEmpty(int tile, int side) const;
  float* GetFrontDepths(int tile);

  int Columns = 0; // of tiles
  int Rows = 0;
  std::vector<Group> Groups;
  std::vector<float> FrontDepths; // of the pixels of one tile after the other
  std::vector<float> Farthest;    // of them, in each part of the image
};

#endif
