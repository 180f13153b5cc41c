// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkImageSpacePass
 * @brief   a filter of what a delegate pass has drawn: its colours, depths and normals
 *
 * The abstract base of the image-space passes (after Rosenthal and Linsen 2008). The delegate draws
 * into images of the viewport's size; window depths become distances from the eye; the subclass
 * filters; colours and window depths go to where the delegate would have drawn, so that passes
 * chain in any order, with vtkEDLShading, vtkSSAOPass and vtkOpenGLFXAAPass too. Perspective and
 * parallel projection, any viewport.
 *
 * Normals are those that mappers of polygonal data shade with. From a pass of this kind that is
 * the delegate they come too, and to a vtkSSAOPass around they go; where none come (from another
 * pass, a volume, vtkPointGaussianMapper), they are taken from the depths.
 *
 * FXAA that the renderer is asked for (vtkRenderer::UseFXAA) is done to what the outermost pass of
 * this kind draws, where no pass of another kind is around it.
 *
 * What VTK's own passes cannot do, whatever they are chained with:
 * - vtkSSAOPass has no positions and normals, and occludes at random or not at all, with
 *   vtkEDLShading as its delegate, or with vtkOpenGLFXAAPass over mappers. With a pass of this kind
 *   between them it has.
 * - vtkOpenGLFXAAPass works on its viewport's place in the window, also where it draws to another
 *   pass: in a viewport off the window's origin it is to be the outermost. So does vtkSSAOPass
 *   before VTK 9.7 where it is the outermost, or has FXAA alone around it: a pass of this kind has
 *   to be around it there.
 * - vtkEDLShading knows perspective alone.
 *
 * A distance between layers of surface is along the view direction in world units; 0, the default
 * of every pass, is ten times the width of a pixel at the depth where it is, whatever the scale and
 * the camera are.
 *
 * @sa vtkBackgroundFillPass vtkOccludedFillPass vtkSurfaceSmoothingPass vtkDepthAntialiasingPass
 * vtkSilhouettePass vtkFeatureLinePass
 */
#ifndef vtkImageSpacePass_h
#define vtkImageSpacePass_h

#include "vtkImageProcessingPass.h"
#include "vtkPointSurfaceModule.h" // for export macro

#include <array>  // for std::array
#include <memory> // for std::unique_ptr

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkSurfaceTarget;
struct vtkDepthStep;

class VTKPOINTSURFACE_EXPORT vtkImageSpacePass : public vtkImageProcessingPass
{
public:
  vtkTypeMacro(vtkImageSpacePass, vtkImageProcessingPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Render(const vtkRenderState* s) override;
  void ReleaseGraphicsResources(vtkWindow* w) override;

  // What mappers call while the delegate draws; see vtkOpenGLRenderPass.
  bool PreReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool PostReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject* vao = nullptr) override;

  /**
   * Milliseconds that Filter() took in the last frame, by OpenGL's timer; waits until the frame is
   * finished.
   */
  double GetLastFrameMilliseconds();

protected:
  vtkImageSpacePass();
  ~vtkImageSpacePass() override;

  /**
   * Filters `image`, with layers Surface (normal, and depth along the view direction in world
   * units, 0 for the background) and Color, with `spare` of the same layers to work in. The result
   * is in `image`; the two may change places. OpenGL's state is without blending and depth test.
   */
  virtual void Filter(
    vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare) = 0;

  /**
   * A distance between layers in world units as the steps take it; 0 is ten times the width of a
   * pixel.
   */
  vtkDepthStep GetDepthStep(double distance) const;

  /**
   * The whole viewport: x, y, x end, y end.
   */
  const std::array<int, 4>& GetRectangle() const;

private:
  vtkImageSpacePass(const vtkImageSpacePass&) = delete;
  void operator=(const vtkImageSpacePass&) = delete;

  void ExamineContext(vtkOpenGLRenderWindow* window);
  // `origin` is that of the viewport in the framebuffer that is drawn to.
  void DrawDelegate(const vtkRenderState* s, vtkOpenGLRenderWindow* window, const int origin[2]);
  void ReadImage(vtkOpenGLRenderWindow* window, vtkSurfaceTarget& image);
  void WriteImage(
    vtkOpenGLRenderWindow* window, int outputs, const int origin[2], vtkSurfaceTarget& image);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
