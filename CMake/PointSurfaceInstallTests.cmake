# SPDX-License-Identifier: BSD-3-Clause
# The project as a user gets it: installed into a folder of its own, used from C++ by the project in Testing/Consumer,
# and imported by Python.
set(install_prefix "${CMAKE_BINARY_DIR}/Testing/Install")

add_test(NAME Installed-install
  COMMAND "${CMAKE_COMMAND}" --install "${CMAKE_BINARY_DIR}" --config "$<CONFIG>" --prefix "${install_prefix}")
set_tests_properties(Installed-install PROPERTIES FIXTURES_SETUP Installed)

add_test(NAME Installed-consumer
  COMMAND "${CMAKE_CTEST_COMMAND}"
    --build-and-test "${CMAKE_SOURCE_DIR}/Testing/Consumer" "${CMAKE_BINARY_DIR}/Testing/Consumer"
    --build-generator "${CMAKE_GENERATOR}"
    --build-makeprogram "${CMAKE_MAKE_PROGRAM}"
    --build-options "-DCMAKE_PREFIX_PATH=${install_prefix}" "-DCMAKE_BUILD_TYPE=$<CONFIG>"
      "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
    --test-command consumer)
set_tests_properties(Installed-consumer PROPERTIES FIXTURES_REQUIRED Installed)

if (POINTSURFACE_PCL)
  add_test(NAME Installed-examples
    COMMAND "${CMAKE_CTEST_COMMAND}"
      --build-and-test "${CMAKE_SOURCE_DIR}/Examples/Cxx" "${CMAKE_BINARY_DIR}/Testing/Examples"
      --build-generator "${CMAKE_GENERATOR}"
      --build-makeprogram "${CMAKE_MAKE_PROGRAM}"
      --build-options "-DCMAKE_PREFIX_PATH=${install_prefix}" "-DCMAKE_BUILD_TYPE=$<CONFIG>"
        "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}")
  set_tests_properties(Installed-examples PROPERTIES FIXTURES_REQUIRED Installed FIXTURES_SETUP Examples)
endif ()
if (POINTSURFACE_PCL AND POINTSURFACE_WRAP_PYTHON)
  add_test(NAME Installed-pcl-visualizer
    COMMAND "${Python3_EXECUTABLE}" "${CMAKE_SOURCE_DIR}/Testing/PCL/check_visualizer.py"
      "${CMAKE_BINARY_DIR}/Testing/Examples/pcl_visualizer" "${POINTSURFACE_TEST_OUTPUT}")
  set_tests_properties(Installed-pcl-visualizer PROPERTIES FIXTURES_REQUIRED "Installed;Examples")
endif ()

if (POINTSURFACE_WRAP_PYTHON)
  file(RELATIVE_PATH python_destination "${CMAKE_BINARY_DIR}" "${POINTSURFACE_PYTHONPATH}")
  add_test(NAME Installed-python
    COMMAND "${Python3_EXECUTABLE}" -c
      "import sys; from pointsurface import vtkPullPushMapper; sys.exit(not vtkPullPushMapper().IsA('vtkMapper'))")
  set_tests_properties(Installed-python PROPERTIES
    FIXTURES_REQUIRED Installed
    ENVIRONMENT "PYTHONPATH=${install_prefix}/${python_destination}")
endif ()

# The wheel: minutes on all cores, so nothing beside it. Skipped, in words, where there is no vtk-sdk.
if (POINTSURFACE_WRAP_PYTHON AND UNIX)
  add_test(NAME Wheel COMMAND "${CMAKE_SOURCE_DIR}/Scripts/test-wheel.sh")
  set_tests_properties(Wheel PROPERTIES
    SKIP_RETURN_CODE 77
    RUN_SERIAL ON
    TIMEOUT 2700)
endif ()
