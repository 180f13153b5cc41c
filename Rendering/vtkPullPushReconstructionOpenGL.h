// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPullPushReconstructionOpenGL
 * @brief   the step from one-pixel projections to a surface buffer, by pull-push interpolation
 *
 * Builds the coarser levels of an image pyramid from the projected points (pull), then fills the
 * invalid and occluded pixels of each level from the coarser one (push) (Marroquim, Kraus,
 * Cavalcanti 2007, sections 3.2 and 3.3). The paper keeps both phases in two buffers and copies
 * between them; here each phase writes a pyramid of its own, so that no pixel is copied. Each level
 * is a texture of its own, not a level of one chain: no texture is then read while it is written,
 * for which OpenGL 3.2 has no barrier, and sizes are halved upwards, where a chain's are downwards.
 */
#ifndef vtkPullPushReconstructionOpenGL_h
#define vtkPullPushReconstructionOpenGL_h

#include "vtkSurfaceTarget.h"

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkScreenPass;
class vtkShaderProgram;
class vtkWindow;
struct vtkPullPushParameters;

class vtkPullPushReconstructionOpenGL
{
public:
  /// Of a tile, which is drawn as a point: pixels along a side.
  static constexpr int TileSize = 16;

  vtkPullPushReconstructionOpenGL();
  ~vtkPullPushReconstructionOpenGL();

  /**
   * Fills `surface` (layer Surface, and Id and Color where it is to have them) from `projected`
   * within the view's rectangle.
   */
  void Run(vtkOpenGLRenderWindow* window, const vtkPullPushParameters& parameters,
    vtkSurfaceTarget& projected, vtkSurfaceTarget& surface);

  /**
   * Takes what a surface covers less than half of away from projected points, see
   * vtkOutlineTrimCPU: makes `projected`, which becomes as large, with the same layers, of
   * `untrimmed`.
   */
  void Trim(vtkOpenGLRenderWindow* window, const vtkPullPushParameters& parameters,
    vtkSurfaceTarget& untrimmed, vtkSurfaceTarget& projected);

  /**
   * Passes over the screen of the last run.
   */
  int GetPasses() const { return this->Passes; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  vtkPullPushReconstructionOpenGL(const vtkPullPushReconstructionOpenGL&) = delete;
  void operator=(const vtkPullPushReconstructionOpenGL&) = delete;

  using Layers = std::vector<vtkSurfaceTarget::Layer>;

  void AllocatePyramid(
    vtkOpenGLRenderWindow* window, const vtkPullPushParameters& parameters, const Layers& layers);
  void Pull(vtkOpenGLRenderWindow* window, const vtkPullPushParameters& parameters,
    vtkSurfaceTarget& fine, int level);
  void Push(vtkOpenGLRenderWindow* window, const vtkPullPushParameters& parameters,
    vtkSurfaceTarget& fine, vtkSurfaceTarget& coarse, vtkSurfaceTarget& result, int level);
  void Fill(vtkOpenGLRenderWindow* window, const vtkPullPushParameters& parameters,
    vtkSurfaceTarget& surface);
  enum Kind
  {
    TrimPass,
    PullPass,
    PushPass,
    FillPass,
    CopyPass,
    NumberOfKinds
  };
  vtkScreenPass& GetPass(
    const vtkPullPushParameters& parameters, Kind kind, const Layers& input, const Layers& output);
  void DrawLevel(vtkOpenGLRenderWindow* window, const vtkPullPushParameters& parameters,
    vtkScreenPass& pass, int level);
  // The same tile by tile, without those that the coarser level has no surface for.
  void DrawTiles(vtkOpenGLRenderWindow* window, const vtkPullPushParameters& parameters,
    vtkScreenPass& pass, vtkShaderProgram* program, vtkSurfaceTarget& coarse, int level);

  int Passes = 0;
  std::vector<std::unique_ptr<vtkSurfaceTarget>> Pulled; // levels 1 and up, by level - 1
  vtkSurfaceTarget Filled; // level 0, where it is filled; its depth buffer marks what may be
  std::vector<std::unique_ptr<vtkSurfaceTarget>> Pushed; // the same; the coarsest is not used
  // By what a program is made for: constants, layers that it reads, layers that it writes.
  std::map<std::tuple<std::string, Layers, Layers>, std::unique_ptr<vtkScreenPass>>
    Programs[NumberOfKinds];
};

#endif
