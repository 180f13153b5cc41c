// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBackgroundFillPass
 * @brief   fills pixels of the background that are holes in a surface
 *
 * Rosenthal and Linsen 2008, section 4: a pixel of the background takes colour, normal and depth of
 * its nearest neighbour, unless five neighbours in a row of the eight around it are background.
 * Over vtkPolyDataMapper with points of one pixel this closes the surface of a dense cloud.
 *
 * @sa vtkImageSpacePass vtkOccludedFillPass vtkImageSpacePointMapper
 */
#ifndef vtkBackgroundFillPass_h
#define vtkBackgroundFillPass_h

#include "vtkMaskFillPass.h"

class VTKPOINTSURFACE_EXPORT vtkBackgroundFillPass : public vtkMaskFillPass
{
public:
  static vtkBackgroundFillPass* New();
  vtkTypeMacro(vtkBackgroundFillPass, vtkMaskFillPass);

protected:
  vtkBackgroundFillPass() = default;
  ~vtkBackgroundFillPass() override = default;

private:
  vtkBackgroundFillPass(const vtkBackgroundFillPass&) = delete;
  void operator=(const vtkBackgroundFillPass&) = delete;
};

#endif
