// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointSurfaceMapperFactory
 * @brief   picks the mapper that measures best for a cloud
 *
 * The rules, the first that applies; what they rest on is in Testing/Benchmarks:
 *
 * 1. Points that are splats of vtkAlgebraicSplats: vtkAlgebraicSplatMapper, which alone traces
 *    them.
 * 2. Points without normals that are noisy, or more than 200,000: vtkDirectPointMapper, which needs
 *    none. In noise its normals are better than estimated ones, and it is at the first frame while
 *    others estimate, seconds earlier where points are many (RESULTS.md, direct.md). Fewer and
 *    clean points count as ones with normals, which the mapper estimates: that takes up to about a
 *    second, once, and frames then take less time, with a smaller error.
 * 3. Points with normals, where the surface is made by the processor (see BackendType of
 *    vtkPointSurfaceMapper): vtkSurfaceSplatMapper. Its error is the least in most scenes, or
 *    within some tenths of a dB of vtkPullPushMapper's, for a fifth more time than that one's with
 *    few points a pixel, and less with many (RESULTS.md).
 * 4. Where it is made by OpenGL: vtkPullPushMapper, since splats overlap many times. With few
 *    points a pixel they take some four times as long.
 *
 * Noisy: where of 400 points more than a tenth have neighbours that are off the quadric through
 * them by more than 0.35 of their mean spacing, root of the weighted mean square. Evenly spread
 * noise is found at about 0.3 spacings (standard deviation, along the normal), thin parts and
 * details that are as fine as the spacing, too; what lies on lines counts as noisy. Looking takes
 * some tenths of a second at most.
 *
 * Densities that vary: where an array "radius" says that the largest is over 10 times (rule 2) or
 * over 50 times (rule 3) the smallest, a thousandth of the points at either end left out, it is
 * vtkPullPushMapper, which takes 1000 to 1. There is no rule for points a pixel: both mappers of
 * clouds with normals leave out or average those that a pixel cannot tell apart. What is picked
 * stands beside what measures best in RESULTS.md. For points without normals that are others in
 * every frame take vtkDirectPointMapper: the rules are for those that stay.
 *
 * @sa vtkPointSurfaceMapper
 */
#ifndef vtkPointSurfaceMapperFactory_h
#define vtkPointSurfaceMapperFactory_h

#include "vtkObject.h"
#include "vtkPointSurfaceMapper.h" // for BackendType
#include "vtkPointSurfaceModule.h" // for export macro
#include "vtkWrappingHints.h"      // for VTK_NEWINSTANCE

class vtkDataObject;

class VTKPOINTSURFACE_EXPORT vtkPointSurfaceMapperFactory : public vtkObject
{
public:
  static vtkPointSurfaceMapperFactory* New();
  vtkTypeMacro(vtkPointSurfaceMapperFactory, vtkObject);

  /**
   * A new mapper for `cloud`, a vtkPointSet or a tree of them, which is not made its input: the
   * caller's to set up and to delete. `backend` is a BackendType of vtkPointSurfaceMapper, and is
   * set on the mapper. With Automatic (the default) a window of vtkRenderWindow::New() is opened
   * off screen, for some milliseconds, to see what runs OpenGL. A cloud that is null or has no
   * points is taken for one without normals.
   */
  static VTK_NEWINSTANCE vtkPointSurfaceMapper* NewMapper(
    vtkDataObject* cloud, int backend = vtkPointSurfaceMapper::Automatic);

protected:
  vtkPointSurfaceMapperFactory() = default;
  ~vtkPointSurfaceMapperFactory() override = default;

private:
  vtkPointSurfaceMapperFactory(const vtkPointSurfaceMapperFactory&) = delete;
  void operator=(const vtkPointSurfaceMapperFactory&) = delete;
};

#endif
