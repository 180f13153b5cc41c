// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMaskFillCPU
 * @brief   the step that fills holes with the surface around them, by the processor
 *
 * The same as vtkMaskFillOpenGL. The new pixels of each row are put down apart until all of an
 * iteration are known; an iteration looks only at pixels that could not be filled by the last one,
 * and around those that were.
 */
#ifndef vtkMaskFillCPU_h
#define vtkMaskFillCPU_h

#include <cstddef>
#include <vector>

struct vtkMaskFillOptions;
struct vtkSurfacePixels;

class vtkMaskFillCPU
{
public:
  /**
   * Fills `pixels`. Returns the number of iterations that filled a pixel.
   */
  int Run(const vtkMaskFillOptions& options, vtkSurfacePixels& pixels);

private:
  struct Filled
  {
    size_t Pixel;
    float Surface[4];
    float Color[4];
    unsigned int Id;
  };

  static void Write(const Filled& filled, vtkSurfacePixels& pixels);
  static unsigned int FindOpenDirections(const vtkMaskFillOptions& options,
    const vtkSurfacePixels& pixels, int column, int row, float limit, unsigned int beyond);
  void FindCandidates(const vtkMaskFillOptions& options, const vtkSurfacePixels& pixels, int row);
  void AddNeighbors(const Filled& filled, int width, int row);
  void FindFillable(const vtkMaskFillOptions& options, const vtkSurfacePixels& pixels, int row);

  std::vector<std::vector<int>> Candidates; // columns of each row
  std::vector<unsigned char> Listed;        // of each pixel: whether it is among them
  std::vector<std::vector<Filled>> Rows;
};

#endif
