// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFirstRootShader
 * @brief   vtkFirstRoot.glsl as a shader has it: in floats, and in doubles where rounding decides
 *
 * GLSL: `bool firstRoot(Polynomial p, out float root)` for the degree ORDER. Where the context has
 * GL_ARB_gpu_shader_fp64, doubles tell whether a quadratic that all but touches zero has roots, and
 * find the first of several roots of cubics and quartics; most rays meet a splat once and are in
 * floats. Else all is in floats, and of roots that nearly touch a later one may be taken.
 */
#ifndef vtkFirstRootShader_h
#define vtkFirstRootShader_h

#include "vtkFirstRoot.h"

#include <string>

namespace vtkFirstRootShader
{
/// To stand right after the version.
inline const char* GetExtensions()
{
  return "#extension GL_ARB_gpu_shader_fp64 : enable\n";
}

inline std::string GetText()
{
  const std::string names[] = { "Real", "Real2", "Real3", "Real4", "Polynomial", "ROUNDING",
    "PRECISION" };
  auto compileFor = [&](const std::string(&values)[7])
  {
    std::string before;
    std::string after;
    for (int i = 0; i < 7; ++i)
    {
      before += "#define " + names[i] + " " + values[i] + "\n";
      after += "#undef " + names[i] + "\n";
    }
    return before + vtkFirstRoot + after;
  };
  return "#ifdef GL_ARB_gpu_shader_fp64\n#if ORDER > 2\n" +
    compileFor({ "double", "dvec2", "dvec3", "dvec4", "PolynomialOfDoubles", "4.5e-16", "1e-12" }) +
    "#endif\n#define USES_DOUBLES\n#endif\n" +
    compileFor({ "float", "vec2", "vec3", "vec4", "PolynomialOfFloats", "2.4e-7", "1.2e-7" }) +
    "#define Polynomial PolynomialOfFloats\n";
}
}

#endif
