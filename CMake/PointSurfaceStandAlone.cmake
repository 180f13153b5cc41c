# SPDX-License-Identifier: BSD-3-Clause
# The project on its own: finds VTK, builds the module, wraps it for Python, adds tests and install rules.
include(CTest)
include(GNUInstallDirs)

if (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif ()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_BINDIR}")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
option(BUILD_SHARED_LIBS "Build a shared library" ON)
option(POINTSURFACE_WRAP_PYTHON "Build the Python package pointsurface" ON)

set(vtk_modules CommonCore CommonDataModel CommonExecutionModel CommonMath CommonSystem FiltersCore FiltersPoints
  ParallelCore RenderingCore RenderingOpenGL2 RenderingUI eigen)
find_package(VTK 9.1 REQUIRED
  COMPONENTS ${vtk_modules}
  OPTIONAL_COMPONENTS Python WrappingPythonCore FiltersGeneral FiltersGeometry FiltersSources IOImage
    IOXML ImagingCore ImagingHybrid InteractionStyle RenderingFreeType TestingCore TestingRendering)

file(STRINGS PointSurface.module module REGEX "^[^#]")
file(STRINGS vtk.module remote_module REGEX "^[^#]")
string(REPLACE "PointSurface::" "VTK::" module "${module}")
if (NOT module STREQUAL remote_module)
  message(FATAL_ERROR "PointSurface.module and vtk.module differ in more than the namespace: change both alike.")
endif ()
set(module_files "${CMAKE_CURRENT_SOURCE_DIR}/PointSurface.module")
set(requested_modules PointSurface::PointSurface)
include(PointSurfacePCL)
if (POINTSURFACE_PCL)
  list(APPEND module_files "${CMAKE_CURRENT_SOURCE_DIR}/Module/PCL/PointSurfacePCL.module")
  list(APPEND requested_modules PointSurface::PointSurfacePCL)
endif ()
vtk_module_scan(
  MODULE_FILES ${module_files}
  REQUEST_MODULES ${requested_modules}
  PROVIDES_MODULES modules
  ENABLE_TESTS "${BUILD_TESTING}")

set(package_destination "${CMAKE_INSTALL_LIBDIR}/cmake/PointSurface")
set(POINTSURFACE_TEST_OUTPUT "${CMAKE_BINARY_DIR}/Testing/Temporary")

# The module's folder is the top folder: its second visit gets a binary folder of its own.
function (pointsurface_build)
  set(ExternalData_BINARY_ROOT "${CMAKE_BINARY_DIR}/ExternalData")
  set(ExternalData_OBJECT_STORES "${CMAKE_BINARY_DIR}/ExternalData/Objects")
  set(POINTSURFACE_BINARY_DIR "${CMAKE_BINARY_DIR}")
  set(CMAKE_BINARY_DIR "${CMAKE_BINARY_DIR}/module")
  set(POINTSURFACE_IN_MODULE_BUILD ON)
  vtk_module_build(
    MODULES ${modules}
    PACKAGE PointSurface
    VERSION "${PointSurface_VERSION}"
    SOVERSION "${PointSurface_VERSION_MAJOR}.${PointSurface_VERSION_MINOR}"
    INSTALL_EXPORT PointSurface
    CMAKE_DESTINATION "${package_destination}"
    HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/pointsurface"
    TEST_DATA_TARGET PointSurfaceData
    TEST_OUTPUT_DIRECTORY "${POINTSURFACE_TEST_OUTPUT}"
    ENABLE_WRAPPING "${POINTSURFACE_WRAP_PYTHON}")
  if (BUILD_TESTING)
    ExternalData_Add_Target(PointSurfaceData)
  endif ()
endfunction ()
pointsurface_build()

if (POINTSURFACE_WRAP_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development)
  add_subdirectory(Python)
endif ()

# find_package(PointSurface)
include(CMakePackageConfigHelpers)
configure_package_config_file(CMake/PointSurfaceConfig.cmake.in PointSurfaceConfig.cmake
  INSTALL_DESTINATION "${package_destination}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(PointSurfaceConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/PointSurfaceConfig.cmake"
  "${CMAKE_CURRENT_BINARY_DIR}/PointSurfaceConfigVersion.cmake"
  DESTINATION "${package_destination}")

if (BUILD_TESTING)
  file(MAKE_DIRECTORY "${POINTSURFACE_TEST_OUTPUT}")
  set(shared_data "../shared/data")
  cmake_path(ABSOLUTE_PATH shared_data BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
  configure_file(CMake/PointSurfaceTestEnvironment.cmake.in TestEnvironment.cmake @ONLY)
  set_property(DIRECTORY PROPERTY TEST_INCLUDE_FILES "${CMAKE_CURRENT_BINARY_DIR}/TestEnvironment.cmake")
  if (POINTSURFACE_PCL)
    add_subdirectory(Testing/PCL)
  endif ()
  if (POINTSURFACE_WRAP_PYTHON)
    add_subdirectory(Testing/Python)
  endif ()
  include(PointSurfaceInstallTests)
endif ()

include(PointSurfaceReference)
