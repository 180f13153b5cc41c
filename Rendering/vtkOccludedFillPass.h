// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOccludedFillPass
 * @brief   fills pixels that show a hidden surface through a hole in the one before it
 *
 * Rosenthal and Linsen 2008, section 5: a pixel that is farther back than LayerDistance behind its
 * neighbours takes colour, normal and depth of the nearest of them, unless five in a row of the
 * eight around it are as far back as it is. To be run after vtkBackgroundFillPass, for points of a
 * dense cloud.
 *
 * @sa vtkImageSpacePass vtkBackgroundFillPass vtkImageSpacePointMapper
 */
#ifndef vtkOccludedFillPass_h
#define vtkOccludedFillPass_h

#include "vtkMaskFillPass.h"

class VTKPOINTSURFACE_EXPORT vtkOccludedFillPass : public vtkMaskFillPass
{
public:
  static vtkOccludedFillPass* New();
  vtkTypeMacro(vtkOccludedFillPass, vtkMaskFillPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Distance between two layers of surface, along the view direction in world units; the paper has
   * 0.0001 times the distance of the far plane. 0, the default: ten times the width of a pixel.
   */
  vtkSetClampMacro(LayerDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LayerDistance, double);
  ///@}

protected:
  vtkOccludedFillPass() = default;
  ~vtkOccludedFillPass() override = default;

  void SetOptions(vtkMaskFillOptions& options) const override;

  double LayerDistance = 0.0;

private:
  vtkOccludedFillPass(const vtkOccludedFillPass&) = delete;
  void operator=(const vtkOccludedFillPass&) = delete;
};

#endif
