// SPDX-License-Identifier: BSD-3-Clause
// The one list of mappers that the C++ tests of every mapper run over; a new mapper is added here
// (and in Testing/Python/scenes.py).
#ifndef PointSurfaceTestMappers_h
#define PointSurfaceTestMappers_h

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
  bool UsesNormals = true; ///< of the points
  bool UsesRadii = true;
};

template <typename Mapper>
MapperClass MapperClassOf(const std::string& name, bool usesNormals = true, bool usesRadii = true)
{
  return { name, []() { return vtkSmartPointer<Mapper>::New(); }, usesNormals, usesRadii };
}

inline std::vector<MapperClass> GetMapperClasses()
{
  return {
    MapperClassOf<vtkPullPushMapper>("vtkPullPushMapper"),
    MapperClassOf<vtkSurfaceSplatMapper>("vtkSurfaceSplatMapper"),
  };
}
} // namespace PointSurfaceTest

#endif
