// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceBufferShading.h"

#include "vtkShaderProgram.h"
#include "vtkSurfaceBufferDec.h"
#include "vtkSurfaceBufferImpl.h"

#include <regex>

namespace
{
const char* const Marker = "//PointSurface::Fetch";

bool Contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// Drops the qualifiers of each "in type name;" but of our own: the varying becomes a global that
/// we set.
std::string VaryingsToGlobals(const std::string& text)
{
  static const std::regex varying(
    "(^|[;\\n])([ \\t]*)(?:(?:flat|smooth|noperspective|centroid)[ \\t]+)*in[ \\t]+"
    "(\\w+[ \\t]+(?!ps)\\w+(?:\\[\\d+\\])?[ \\t]*;)");
  // twice, since two on one line share the ';' between them
  return std::regex_replace(std::regex_replace(text, varying, "$1$2$3"), varying, "$1$2$3");
}

/// Assignments of the globals that this shader has.
std::string GetAssignments(const std::string& text)
{
  std::string assignments;
  auto assign = [&](const std::string& declaration, const std::string& value)
  {
    if (Contains(text, declaration + ";"))
    {
      const std::string name = declaration.substr(declaration.find(' ') + 1);
      assignments += "  " + name + " = " + value + ";\n";
    }
  };
  assign("vec4 vertexVCVSOutput", "psVertexVC");
  assign("vec3 normalVCVSOutput", "psNormalVC");
  assign("vec4 vertexColorVSOutput", "psColorOrTCoord");
  for (const char* name : { "tcoordVCVSOutput", "colorTCoordVCVSOutput" })
  {
    assign(std::string("vec2 ") + name, "psColorOrTCoord.xy");
    assign(std::string("float ") + name, "psColorOrTCoord.x");
  }
  assign("int vertexIDVSOutput", "psPoint");
  if (Contains(text, "float clipDistancesVSOutput[6];"))
  {
    assignments += "  for (int i = 0; i < numClipPlanes; ++i)\n"
                   "  { clipDistancesVSOutput[i] = dot(clipPlanes[i], psEye); }\n";
  }
  return assignments;
}
}

void vtkSurfaceBufferShading::Prepare(
  std::string& fragmentShader, const std::vector<vtkSurfaceTarget::Layer>& layers, bool duplicates)
{
  vtkShaderProgram::Substitute(fragmentShader, "//VTK::CustomUniforms::Dec",
    "//VTK::CustomUniforms::Dec\n" + vtkSurfaceTarget::GetInputDeclarations(layers, "ps") +
      (duplicates ? "#define HAS_DUPLICATES\n" : "") + vtkSurfaceBufferDec);
  vtkShaderProgram::Substitute(
    fragmentShader, "//VTK::PositionVC::Impl", std::string(Marker) + "\n  //VTK::PositionVC::Impl");
  vtkShaderProgram::Substitute(
    fragmentShader, "//VTK::Depth::Impl", "if (psPoint < 0) { discard; }\n  //VTK::Depth::Impl");
}

void vtkSurfaceBufferShading::Finish(std::string& fragmentShader)
{
  vtkShaderProgram::Substitute(
    fragmentShader, "//VTK::Depth::Impl", "gl_FragDepth = gl_FragCoord.z;");
  fragmentShader = VaryingsToGlobals(fragmentShader);
  vtkShaderProgram::Substitute(fragmentShader, "gl_FragCoord.z", "psFragCoordZ");
  vtkShaderProgram::Substitute(fragmentShader, "gl_FragCoord.w", "psFragCoordW");
  vtkShaderProgram::Substitute(fragmentShader, "gl_PrimitiveID", "psPoint");
  vtkShaderProgram::Substitute(fragmentShader, "gl_FrontFacing", "psFrontFacing");
  // the template's last line before passes and selection take over
  vtkShaderProgram::Substitute(fragmentShader, "if (gl_FragData[0].a <= 0.0)",
    "gl_FragData[0].a = psCover(gl_FragData[0].a);\n  if (gl_FragData[0].a <= 0.0)");
  vtkShaderProgram::Substitute(fragmentShader, "float clipDistancesVSOutput[6];",
    "float clipDistancesVSOutput[6];\nuniform vec4 clipPlanes[6];");
  vtkShaderProgram::Substitute(
    fragmentShader, Marker, vtkSurfaceBufferImpl + GetAssignments(fragmentShader));
}

void vtkSurfaceBufferShading::HandOnUniforms(
  std::string& vertexShader, std::string& fragmentShader, int vectors)
{
  static const std::regex uniform(
    "uniform[ \\t]+(float|int|vec[234]|ivec2|mat([34]))[ \\t]+(\\w+)[ \\t]*;");
  std::string text;
  std::string declarations;
  std::string assignments;
  std::smatch match;
  std::string rest = fragmentShader;
  while (std::regex_search(rest, match, uniform))
  {
    const std::string type = match[1];
    const std::string name = match[3];
    const std::string handed = "psFlat_" + name;
    const int taken = match[2].matched ? std::stoi(match[2]) : 1;
    const std::string after = match.suffix();
    text += match.prefix();
    if (taken <= vectors && std::regex_search(after, std::regex("\\b" + name + "\\b")))
    {
      vectors -= taken;
      declarations += match.str() + "\nflat out " + type + " " + handed + ";\n";
      assignments += "  " + handed + " = " + name + ";\n";
      text += "flat in " + type + " " + handed + ";\n#define " + name + " " + handed + "\n";
    }
    else
    {
      text += match.str();
    }
    rest = after;
  }
  fragmentShader = text + rest;
  vtkShaderProgram::Substitute(vertexShader, "//PointSurface::Uniforms::Dec", declarations);
  vtkShaderProgram::Substitute(vertexShader, "//PointSurface::Uniforms::Impl", assignments);
}

void vtkSurfaceBufferShading::CallFromMain(std::string& fragmentShader, const std::string& main)
{
  vtkShaderProgram::Substitute(fragmentShader, "void main()", "bool psGone;\nvoid psShade()");
  vtkShaderProgram::Substitute(fragmentShader, "discard;", "{ psGone = true; return; }");
  fragmentShader += main;
}
