# SPDX-License-Identifier: BSD-3-Clause
# Module/PCL, a module of its own that is built where PCL is at hand: POINTSURFACE_PCL. In a function, as PCL's
# configuration sets many variables, those of VTK among them.
function (pointsurface_find_pcl)
  set(components common kdtree search features surface io)
  find_package(PCL 1.13 QUIET COMPONENTS ${components})
  set(libraries)
  foreach (component IN LISTS components)
    string(TOUPPER "${component}" component)
    list(APPEND libraries "${PCL_${component}_LIBRARY}")
  endforeach ()
  set(PCL_FOUND "${PCL_FOUND}" PARENT_SCOPE)
  set(PCL_INCLUDE_DIRS "${PCL_INCLUDE_DIRS}" PARENT_SCOPE)
  set(pcl_libraries "${libraries}" PARENT_SCOPE)
endfunction ()

if (NOT DEFINED POINTSURFACE_PCL OR POINTSURFACE_PCL)
  pointsurface_find_pcl()
  option(POINTSURFACE_PCL "Build what needs the Point Cloud Library: .pcd files, conversions, filters" "${PCL_FOUND}")
  if (POINTSURFACE_PCL AND NOT PCL_FOUND)
    message(FATAL_ERROR "POINTSURFACE_PCL is ON, and PCL 1.13 or newer (Debian: libpcl-dev) is not found.")
  endif ()
endif ()
