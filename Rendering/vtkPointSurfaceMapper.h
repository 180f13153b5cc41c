// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointSurfaceMapper
 * @brief   draws a point cloud as the closed, lit surface that it stands for
 *
 * The abstract base of the mappers of this module. It owns what they share: the upload of the
 * points, the surface buffer (for each pixel the eye depth, the eye-space normal, the colour and
 * the id of a point), shading through VTK's own shader template, and statistics. A subclass says
 * how the surface buffer is made from the points.
 *
 * A mapper takes the place of vtkPolyDataMapper: lights, materials, lookup tables, depth against
 * other props come from VTK. The input is a vtkPolyData; its points are drawn, whether they are
 * in cells or not.
 *
 * Input that cannot be drawn as it is gets a warning that names the array, the value and the
 * remedy, and a frame all the same: points with a coordinate that is not finite are left out;
 * normals that are zero or not finite are taken as facing the viewer; radii that are not positive
 * and finite become the mean of the others.
 *
 * @sa vtkPullPushMapper vtkPointSpacing vtkIsosurfacePoints
 */
#ifndef vtkPointSurfaceMapper_h
#define vtkPointSurfaceMapper_h

#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPointSurfaceModule.h" // for export macro

class vtkImageData;

class VTKPOINTSURFACE_EXPORT vtkPointSurfaceMapper : public vtkOpenGLPolyDataMapper
{
public:
  vtkTypeMacro(vtkPointSurfaceMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Name of the point array (one component) with the radius of each point, in the units of the
   * points' coordinates. Default: none. Which radius is used: this array if it is named; else
   * Radius if that is over 0; else an array named "radius", as vtkIsosurfacePoints and
   * vtkPointSpacing make it; else an estimate from the data, made once (vtkPointSpacing).
   */
  vtkSetStringMacro(RadiusArray);
  vtkGetStringMacro(RadiusArray);
  ///@}

  ///@{
  /**
   * One radius for all points, in the units of their coordinates; 0 (the default) means that there
   * is none. See RadiusArray for the order in which sources of the radius are tried. A radius that
   * is too small leaves holes; one that is twice too large costs little: 1.5 to 2 times the mean
   * spacing is a good value.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Factor on all radii, wherever they come from. Over 0; default 1. Uploads nothing.
   */
  vtkSetClampMacro(RadiusScale, double, 1e-6, 1e6);
  vtkGetMacro(RadiusScale, double);
  ///@}

  ///@{
  /**
   * What the last frame cost: the number of points sent to projection; the rectangle of the
   * viewport that was worked on (x, y, width, height in pixels from the viewport's lower left
   * corner); bytes of point data uploaded; how often a surface buffer was made (0 when the one of
   * an earlier frame still held); and milliseconds per stage by OpenGL's timer. Asking for
   * milliseconds waits for the frame to finish.
   */
  vtkGetMacro(LastFramePointsDrawn, vtkIdType);
  vtkGetVector4Macro(LastFrameRectangle, int);
  vtkGetMacro(LastFrameUploadedBytes, vtkIdType);
  vtkGetMacro(LastFrameReconstructions, int);
  ///@}

  /**
   * Copies the surface buffer that the last frame was shaded from into `buffer`: an image with a
   * pixel for each pixel of the viewport, the origin at its lower left. Point arrays: "Normals"
   * (float, 3 components, eye space, unit length, 0 where there is no surface), "Depth" (float,
   * distance from the eye along the view direction in world units, 0 where there is no surface),
   * "Colors" (float, 4 components, 0 to 1; only if the cloud has colours). Returns false, with an
   * error, when nothing has been rendered.
   */
  virtual bool ReadSurfaceBuffer(vtkImageData* buffer);

protected:
  vtkPointSurfaceMapper();
  ~vtkPointSurfaceMapper() override;

  char* RadiusArray = nullptr;
  double Radius = 0.0;
  double RadiusScale = 1.0;

  vtkIdType LastFramePointsDrawn = 0;
  int LastFrameRectangle[4] = { 0, 0, 0, 0 };
  vtkIdType LastFrameUploadedBytes = 0;
  int LastFrameReconstructions = 0;

private:
  vtkPointSurfaceMapper(const vtkPointSurfaceMapper&) = delete;
  void operator=(const vtkPointSurfaceMapper&) = delete;
};

#endif
