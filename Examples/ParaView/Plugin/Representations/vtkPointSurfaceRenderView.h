// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointSurfaceRenderView
 * @brief   "Render View with Lines": ParaView's render view, with lines drawn over the picture
 *
 * The passes are those of Rosenthal and Linsen 2008, section 8; they see depths and normals of the
 * picture, and so work for meshes too.
 *
 * @sa vtkSilhouettePass vtkFeatureLinePass
 */
#ifndef vtkPointSurfaceRenderView_h
#define vtkPointSurfaceRenderView_h

#include "vtkNew.h" // for vtkNew
#include "vtkPVRenderView.h"
#include "vtkPointSurfaceRepresentationsModule.h" // for export macro

class vtkFeatureLinePass;
class vtkSilhouettePass;

class VTKPOINTSURFACEREPRESENTATIONS_EXPORT vtkPointSurfaceRenderView : public vtkPVRenderView
{
public:
  static vtkPointSurfaceRenderView* New();
  vtkTypeMacro(vtkPointSurfaceRenderView, vtkPVRenderView);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum LinesType
  {
    NONE,
    SILHOUETTES,  ///< vtkSilhouettePass
    FEATURE_LINES ///< vtkFeatureLinePass
  };

  ///@{
  /**
   * Which lines are drawn; see LinesType. Default SILHOUETTES.
   */
  void SetLines(int lines);
  vtkGetMacro(Lines, int);
  ///@}

  ///@{
  /**
   * Colour of the lines, 0 to 1, default black, and their thickness in pixels, 1 to 16, default 2.
   */
  void SetLineColor(double r, double g, double b);
  void SetLineThickness(double thickness);
  ///@}

protected:
  vtkPointSurfaceRenderView();
  ~vtkPointSurfaceRenderView() override;

  int Lines = NONE;

private:
  vtkPointSurfaceRenderView(const vtkPointSurfaceRenderView&) = delete;
  void operator=(const vtkPointSurfaceRenderView&) = delete;

  vtkNew<vtkSilhouettePass> Silhouettes;
  vtkNew<vtkFeatureLinePass> FeatureLines;
};

#endif
