// SPDX-License-Identifier: BSD-3-Clause
// The one list of mappers that the C++ tests of every mapper run over; a new mapper is added here
// (and in Testing/Python/scenes.py).
#ifndef PointSurfaceTestMappers_h
#define PointSurfaceTestMappers_h

#include "vtkAlgebraicSplatMapper.h"
#include "vtkAlgebraicSplats.h"
#include "vtkDirectPointMapper.h"
#include "vtkImageSpacePointMapper.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPullPushMapper.h"
#include "vtkSmartPointer.h"
#include "vtkSurfaceSplatMapper.h"

#include <functional>
#include <string>
#include <vector>

namespace PointSurfaceTest
{
struct MapperClass
{
  std::string Name;
  std::function<vtkSmartPointer<vtkPointSurfaceMapper>()> Make;
  bool UsesNormals = true;     ///< of the points
  bool UsesRadii = true;       ///< of the points, and estimates them
  bool FillsSmallGaps = false; ///< of few pixels, as dense clouds have, and no others
  bool DrawsSplats = false;
  bool Thins = false; ///< draws fewer points where pixels cannot tell them apart

  /// What the mapper draws, of a cloud: as many points, in the same order.
  vtkSmartPointer<vtkPolyData> MakeInput(vtkPolyData* cloud) const
  {
    if (!this->DrawsSplats)
    {
      return cloud;
    }
    vtkNew<vtkAlgebraicSplats> splats;
    splats->SetInputData(cloud);
    splats->SetSelectionToAllPoints();
    splats->SetNumberOfNeighbors(16);
    splats->SetOrder(2);
    splats->Update();
    return splats->GetOutput();
  }
};

template <typename Mapper>
MapperClass MapperClassOf(const std::string& name)
{
  MapperClass result;
  result.Name = name;
  result.Make = []() { return vtkSmartPointer<Mapper>::New(); };
  return result;
}

inline std::vector<MapperClass> GetMapperClasses()
{
  auto direct = MapperClassOf<vtkDirectPointMapper>("vtkDirectPointMapper");
  direct.UsesNormals = false;
  direct.UsesRadii = false;
  auto splats = MapperClassOf<vtkAlgebraicSplatMapper>("vtkAlgebraicSplatMapper");
  splats.UsesRadii = false;
  splats.DrawsSplats = true;
  auto imageSpace = MapperClassOf<vtkImageSpacePointMapper>("vtkImageSpacePointMapper");
  imageSpace.FillsSmallGaps = true;
  auto pullPush = MapperClassOf<vtkPullPushMapper>("vtkPullPushMapper");
  pullPush.Thins = true;
  auto surfaceSplats = MapperClassOf<vtkSurfaceSplatMapper>("vtkSurfaceSplatMapper");
  surfaceSplats.Thins = true;
  return { pullPush, imageSpace, direct, splats, surfaceSplats };
}
} // namespace PointSurfaceTest

#endif
