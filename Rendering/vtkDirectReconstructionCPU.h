// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDirectReconstructionCPU
 * @brief   the steps from the nearest and the farthest points of the image buffer's cells to a
 *          surface buffer, by the processor
 *
 * The same as vtkDirectReconstructionOpenGL: average, normals and splats (Kawata and Kanai,
 * sections 3.2 to 3.4), threaded by vtkSMPTools. The result does not depend on the number of
 * threads.
 */
#ifndef vtkDirectReconstructionCPU_h
#define vtkDirectReconstructionCPU_h

#include <cstddef>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkSurfaceImage;
class vtkSurfaceTarget;
struct vtkDirectParameters;
struct vtkSurfacePixels;

class vtkDirectReconstructionCPU
{
public:
  /// A cell of the image buffer or of a coarser level.
  struct Cell
  {
    float Nearest[3];  ///< in eye coordinates; where there is no point, z is 0
    float Farthest[3]; ///< of those within gamma behind that
    float Color[4];
    unsigned int Id;
    unsigned char Open;   ///< points below are not yet in a splat
    unsigned char IsCopy; ///< its nearest point is another process' one, which makes this splat too
    unsigned char Splats; ///< what follows is set, and makes a splat
    float Normal[3];
    float Depth;     ///< of the mean of the two points
    float Place[2];  ///< of the mean, in pixels of the surface buffer
    float Radius[2]; ///< of the splat, in pixels
    bool IsOccupied() const { return this->Nearest[2] != 0.0f; }
  };

  ///@{
  /**
   * Makes the normals of the cells, then the `pixels` of the parameters' rectangle. The images are
   * projections of the points with sub-pixel centres and centre depths, the nearest ones and the
   * farthest ones behind them. The `copies`, empty or a byte for each point that the images have
   * ids of, are not 0 for copies of another process' points: their splats are averaged with those
   * of others and cover no pixel by themselves.
   */
  void FitNormals(const vtkDirectParameters& parameters, vtkSurfaceImage& nearest,
    vtkSurfaceImage& farthest, const std::vector<unsigned char>& copies);
  void DrawSplats(
    const vtkDirectParameters& parameters, bool ids, bool colors, vtkSurfacePixels& pixels);
  ///@}

  /**
   * Copies the splats to an image of them as vtkDirectReconstructionOpenGL makes it, with the layer
   * Color or without. Returns how many bytes that are.
   */
  size_t UploadSplats(vtkOpenGLRenderWindow* window, const vtkDirectParameters& parameters,
    bool colors, vtkSurfaceTarget& splats);

private:
  std::vector<std::vector<Cell>> Levels; // the cells of each level's rectangle
};

#endif
