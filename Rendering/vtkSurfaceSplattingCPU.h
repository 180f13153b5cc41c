// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceSplattingCPU
 * @brief   the step from points to a surface buffer by splats, by the processor
 *
 * The same as vtkSurfaceSplattingOpenGL, by tiles of the image that fit into the processor's cache:
 * splats are made and sorted into the tiles that they reach, then each tile goes through its splats
 * twice, once for the visible depths and once for what is blended there. Threaded by vtkSMPTools;
 * the result does not depend on the number of threads.
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

  /// The splats of one side that reach a tile, those of a group of points, in the points' order.
  struct List
  {
    std::vector<Splat> Splats;
    std::vector<std::array<float, 4>> Colors;
  };
  class Maker;
  class Tile;

  List& GetList(int group, int tile, int side)
  {
    return this->Lists[2 * (static_cast<size_t>(group) * this->Columns * this->Rows + tile) + side];
  }

  int Columns = 0; // of tiles
  int Rows = 0;
  int Groups = 0;
  std::vector<List> Lists;
};

#endif
