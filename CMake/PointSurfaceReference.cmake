# SPDX-License-Identifier: BSD-3-Clause
# The reference of the API, from the doc comments, as HTML in Reference/html of the build tree: the target
# PointSurfaceReference, which is not a part of the build. It needs Doxygen. The test Reference makes it, and looks for
# public methods without words.
find_package(Doxygen QUIET)
if (NOT DOXYGEN_FOUND)
  if (BUILD_TESTING)
    add_test(NAME Reference COMMAND "${CMAKE_COMMAND}" -E echo "skipped: Doxygen is not installed")
    set_tests_properties(Reference PROPERTIES SKIP_REGULAR_EXPRESSION "skipped")
  endif ()
  return ()
endif ()
set(DOXYGEN_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/Reference")
set(DOXYGEN_PROJECT_NAME PointSurface)
set(DOXYGEN_FILE_PATTERNS *.h *.py)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_OPTIMIZE_OUTPUT_FOR_PYTHON NO)
set(DOXYGEN_PYTHON_DOCSTRING YES)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_IF_UNDOCUMENTED NO)
set(DOXYGEN_WARN_AS_ERROR NO)
set(DOXYGEN_DISTRIBUTE_GROUP_DOC YES)
set(DOXYGEN_GENERATE_XML YES) # for the test
# Doxygen 1.9.4 takes the definition of a function template that was declared before for one without a declaration.
set(DOXYGEN_EXCLUDE "${CMAKE_SOURCE_DIR}/Module/vtkPolynomialRoots.h")
# VTK's macros, as what they declare.
set(DOXYGEN_MACRO_EXPANSION YES)
set(DOXYGEN_EXPAND_ONLY_PREDEF YES)
set(DOXYGEN_PREDEFINED
  "VTKPOINTSURFACE_EXPORT="
  "VTKPOINTSURFACEPCL_EXPORT="
  "vtkTypeMacro(type,base)="
  "vtkSetMacro(name,type)=virtual void Set##name(type value)\;"
  "vtkGetMacro(name,type)=virtual type Get##name()\;"
  "vtkBooleanMacro(name,type)=virtual void name##On()\; virtual void name##Off()\;"
  "vtkSetClampMacro(name,type,low,high)=virtual void Set##name(type value)\;"
  "vtkSetStringMacro(name)=virtual void Set##name(const char* value)\;"
  "vtkGetStringMacro(name)=virtual char* Get##name()\;"
  "vtkSetVector3Macro(name,type)=virtual void Set##name(type x, type y, type z)\;"
  "vtkGetVector3Macro(name,type)=virtual type* Get##name()\;"
  "vtkGetVector4Macro(name,type)=virtual type* Get##name()\;"
  "vtkSetObjectMacro(name,type)=virtual void Set##name(type* value)\;"
  "vtkGetObjectMacro(name,type)=virtual type* Get##name()\;")
doxygen_add_docs(PointSurfaceReference
  "${CMAKE_SOURCE_DIR}/Module" "${CMAKE_SOURCE_DIR}/Module/PCL" "${CMAKE_SOURCE_DIR}/Rendering"
  "${CMAKE_SOURCE_DIR}/Python/pointsurface"
  "${CMAKE_SOURCE_DIR}/README.md"
  COMMENT "Making the reference in ${CMAKE_BINARY_DIR}/Reference/html")

if (BUILD_TESTING AND POINTSURFACE_WRAP_PYTHON)
  add_test(NAME Reference
    COMMAND "${Python3_EXECUTABLE}" "${CMAKE_SOURCE_DIR}/Testing/Python/check_reference.py"
      "${CMAKE_COMMAND}" "${CMAKE_BINARY_DIR}")
endif ()
