// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDirectReconstructionOpenGL
 * @brief   the steps from the nearest and the farthest points of the image buffer's cells to a
 *          surface buffer
 *
 * Average, normals and splats (Kawata and Kanai, sections 3.2 to 3.4), and coarser levels of cells
 * where points are sparse. The splats of all levels lie in one image, side by side.
 */
#ifndef vtkDirectReconstructionOpenGL_h
#define vtkDirectReconstructionOpenGL_h

#include "vtkSurfaceTarget.h"

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkDuplicatePoints;
class vtkOpenGLRenderWindow;
class vtkScreenPass;
class vtkShaderProgram;
class vtkWindow;
struct vtkDirectParameters;

class vtkDirectReconstructionOpenGL
{
public:
  vtkDirectReconstructionOpenGL();
  ~vtkDirectReconstructionOpenGL();

  /**
   * Makes `splats`, the image of them, and fills `surface` with them within the parameters'
   * rectangle. The projected targets have sub-pixel centres and centre depths, and the layers Id
   * and Color where `surface` has them. The `copies`, active or nullptr, tell which points are
   * copies of another process' ones: their splats are averaged with those of others and cover no
   * pixel by themselves. They need the layer Id.
   */
  void Run(vtkOpenGLRenderWindow* window, const vtkDirectParameters& parameters,
    vtkSurfaceTarget& nearest, vtkSurfaceTarget& farthest, vtkDuplicatePoints* copies,
    vtkSurfaceTarget& splats, vtkSurfaceTarget& surface);

  ///@{
  /**
   * For other shaders that read splats (from samplers with the prefix "in"): GLSL of what they show
   * at a place, and its uniforms; pixels have `samples` samples of the surface buffer along a side.
   */
  static std::string GetSplatDeclarations();
  static void SetSplatUniforms(
    vtkShaderProgram* program, const vtkDirectParameters& parameters, int samples);
  ///@}

  /**
   * Passes over images in the last run.
   */
  int GetPasses() const { return this->Passes; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  vtkDirectReconstructionOpenGL(const vtkDirectReconstructionOpenGL&) = delete;
  void operator=(const vtkDirectReconstructionOpenGL&) = delete;

  using Layers = std::vector<vtkSurfaceTarget::Layer>;
  enum Kind
  {
    LoadPass,
    MergePass,
    NormalsPass,
    PartNormalsPass, // of a cloud with copies of other processes' points
    SplatsPass,
    NumberOfKinds
  };

  void Allocate(
    vtkOpenGLRenderWindow* window, const vtkDirectParameters& parameters, const Layers& layers);
  void Load(vtkOpenGLRenderWindow* window, const vtkDirectParameters& parameters,
    vtkSurfaceTarget& nearest, vtkSurfaceTarget& farthest);
  void Merge(vtkOpenGLRenderWindow* window, const vtkDirectParameters& parameters, int level,
    vtkSurfaceTarget& splats);
  void FitNormals(vtkOpenGLRenderWindow* window, const vtkDirectParameters& parameters, int level,
    vtkDuplicatePoints* copies, vtkSurfaceTarget& splats);
  void DrawSplats(vtkOpenGLRenderWindow* window, const vtkDirectParameters& parameters,
    vtkSurfaceTarget& splats, vtkSurfaceTarget& surface);
  vtkScreenPass& GetPass(Kind kind, const Layers& input, const Layers& output);

  std::vector<std::unique_ptr<vtkSurfaceTarget>> Cells; // of each level
  std::map<Layers, std::unique_ptr<vtkScreenPass>> Programs[NumberOfKinds];
  int Passes = 0;
};

#endif
