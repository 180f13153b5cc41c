# SPDX-License-Identifier: BSD-3-Clause
# The wheel (pip install .): the module against Kitware's vtk-sdk, laid out beside the package's Python sources, which
# scikit-build-core adds. vtk-sdk-python-wheel-helper is not of use here: it looks for vtk.module, which is for VTK's
# Remote/ folder and has VTK's namespace. What follows is what it does for a package that runs and is not built against.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(BUILD_SHARED_LIBS ON)
include(GNUInstallDirs) # for the defaults of VTK's module system

# The first one is enough for the second, which takes what else the SDK has; where a part of the SDK does not suit this
# system (OpenXR on Windows) the second finds nothing and does no harm.
find_package(VTK CONFIG REQUIRED COMPONENTS CommonCore Python)
find_package(VTK CONFIG QUIET)

# VTK's libraries lie in the package vtkmodules, ours in our package.
if (APPLE)
  set(CMAKE_INSTALL_RPATH "@loader_path/../vtkmodules/.dylibs" "@loader_path")
elseif (UNIX)
  set(CMAKE_INSTALL_RPATH "$ORIGIN/../vtkmodules" "$ORIGIN")
endif ()

# VTK's wheels for Linux on x86-64 have the C++ library's interface of before 2011.
add_library(PointSurfaceWheelInterface INTERFACE)
if (UNIX AND NOT APPLE AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64")
  target_compile_definitions(PointSurfaceWheelInterface INTERFACE _GLIBCXX_USE_CXX11_ABI=0)
endif ()

vtk_module_scan(
  MODULE_FILES "${CMAKE_CURRENT_SOURCE_DIR}/PointSurface.module"
  REQUEST_MODULES PointSurface::PointSurface
  PROVIDES_MODULES modules
  ENABLE_TESTS OFF)

# The module's folder is the top folder: its second visit gets a binary folder of its own.
function (pointsurface_build_wheel)
  set(CMAKE_BINARY_DIR "${CMAKE_BINARY_DIR}/module")
  set(POINTSURFACE_IN_MODULE_BUILD ON)
  vtk_module_build(
    MODULES ${modules}
    ARCHIVE_DESTINATION pointsurface/lib
    RUNTIME_DESTINATION pointsurface
    LIBRARY_DESTINATION pointsurface
    HIERARCHY_DESTINATION pointsurface/hierarchy
    LICENSE_DESTINATION pointsurface
    INSTALL_HEADERS OFF
    UTILITY_TARGET PointSurfaceWheelInterface)
endfunction ()
pointsurface_build_wheel()

vtk_module_wrap_python(
  MODULES ${modules}
  PYTHON_PACKAGE pointsurface
  SOABI "${Python3_SOABI}"
  BUILD_STATIC OFF
  INSTALL_HEADERS OFF
  UTILITY_TARGET PointSurfaceWheelInterface
  LIBRARY_DESTINATION .
  MODULE_DESTINATION .)

# Type stubs. VTK's module system would make them with the module as it was linked, to the SDK's libraries, which are
# hollow; the real ones are those of the package vtk.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
execute_process(
  COMMAND "${Python3_EXECUTABLE}" -c "import os, vtkmodules; print(os.path.dirname(vtkmodules.__file__))"
  OUTPUT_VARIABLE vtk_libraries
  OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
set(stubs "${CMAKE_BINARY_DIR}/stubs/vtkPointSurface.pyi")
file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/stubs")
file(WRITE "${CMAKE_BINARY_DIR}/pointsurface/__init__.py" "") # goes before a package that is installed already
if (UNIX AND NOT APPLE)
  set(with_vtk --modify "LD_LIBRARY_PATH=path_list_prepend:${vtk_libraries}")
endif ()
add_custom_command(
  OUTPUT "${stubs}"
  COMMAND "${CMAKE_COMMAND}" -E env ${with_vtk} --modify "PYTHONPATH=path_list_prepend:${CMAKE_BINARY_DIR}"
    "${Python3_EXECUTABLE}" -m vtkmodules.generate_pyi -p pointsurface -o "${CMAKE_BINARY_DIR}/stubs" vtkPointSurface
  DEPENDS vtkPointSurfacePython)
add_custom_target(PointSurfaceStubs ALL DEPENDS "${stubs}")
install(FILES "${stubs}" DESTINATION pointsurface)
