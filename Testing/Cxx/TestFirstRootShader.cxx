// SPDX-License-Identifier: BSD-3-Clause
// vtkFirstRoot.glsl, run by OpenGL, against Sturm's theorem in a hundred digits: of each degree the
// polynomials of TestPolynomialRoots, as floats. With an argument, the number of random ones.
#include "PointSurfaceTestUtilities.h"

#include <cstdlib>
#include <iostream>

#if __has_include(<boost/multiprecision/cpp_bin_float.hpp>)

#include "PolynomialRootsOracle.h"
#include "vtkFirstRootShader.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <GL/gl.h>

using namespace PolynomialRootsTest;

namespace
{
constexpr int Width = 1024; // of the picture, a pixel of which is a polynomial

constexpr const char* Solve = R"(
uniform sampler2D coefficients; // of 1, t, t^2, t^3 of a polynomial, and that of t^4 beside
uniform int width;
uniform int height;
in vec2 texCoord;
out vec4 fragOutput0;
void main()
{
  ivec2 pixel = ivec2(texCoord * vec2(width, height));
  vec4 low = texelFetch(coefficients, ivec2(2 * pixel.x, pixel.y), 0);
  float high = texelFetch(coefficients, ivec2(2 * pixel.x + 1, pixel.y), 0).x;
  float root;
  bool found = firstRoot(Polynomial(low, high), root);
  fragOutput0 = vec4(found ? root : -1.0, 0.0, 0.0, 0.0);
}
)";

template <int Degree>
void SolveByShader(vtkOpenGLRenderWindow* window,
  const std::vector<vtkPolynomialRoots::Polynomial<Degree, float>>& polynomials,
  std::vector<float>& answers)
{
  const int height = static_cast<int>((polynomials.size() + Width - 1) / Width);
  std::vector<float> texels(static_cast<size_t>(8) * Width * height, 0.0f);
  for (size_t i = 0; i < polynomials.size(); ++i)
  {
    std::copy(polynomials[i].begin(), polynomials[i].end(), texels.begin() + 8 * i);
  }
  vtkNew<vtkTextureObject> coefficients;
  coefficients->SetContext(window);
  coefficients->Create2DFromRaw(2 * Width, height, 4, VTK_FLOAT, texels.data());
  vtkNew<vtkTextureObject> roots;
  roots->SetContext(window);
  roots->Create2D(Width, height, 4, VTK_FLOAT, false);

  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  vtkNew<vtkOpenGLFramebufferObject> target;
  target->SetContext(window);
  target->Bind();
  target->AddColorAttachment(0, roots);
  target->ActivateDrawBuffer(0);
  target->Start(Width, height);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_SCISSOR_TEST);
  const std::string shader = std::string("//VTK::System::Dec\n") +
    vtkFirstRootShader::GetExtensions() + "#define ORDER " + std::to_string(Degree) + "\n" +
    vtkFirstRootShader::GetText() + Solve;
  vtkOpenGLQuadHelper quad(window, nullptr, shader.c_str(), "");
  if (quad.Program && quad.Program->GetCompiled())
  {
    coefficients->Activate();
    quad.Program->SetUniformi("coefficients", coefficients->GetTextureUnit());
    quad.Program->SetUniformi("width", Width);
    quad.Program->SetUniformi("height", height);
    quad.Render();
    coefficients->Deactivate();
  }
  target->RemoveColorAttachment(0);
  state->PopFramebufferBindings();

  vtkPixelBufferObject* pixels = roots->Download();
  std::vector<float> picture(static_cast<size_t>(4) * Width * height);
  unsigned int size[2] = { Width, static_cast<unsigned int>(height) };
  vtkIdType steps[2] = { 0, 0 };
  pixels->Download2D(VTK_FLOAT, picture.data(), size, 4, steps);
  pixels->Delete();
  for (size_t i = 0; i < answers.size(); ++i)
  {
    answers[i] = picture[4 * i];
  }
  quad.ReleaseGraphicsResources(window);
}

template <int Degree>
void TestDegree(vtkOpenGLRenderWindow* window, PointSurfaceTest::Checks& check, int count)
{
  for (bool hard : { false, true })
  {
    const Limits limits = GetLimits(hard, true);
    const Tally tally =
      Judge<Degree, float>(Make<Degree>(hard, count), limits.Resolution, limits.Tolerance,
        [&](const auto& polynomials, auto& answers)
        { SolveByShader<Degree>(window, polynomials, answers); });
    Print(GetName(Degree, hard) + "shader", tally);
    const std::string what =
      "degree " + std::to_string(Degree) + (hard ? ", hard: " : ", random: ");
    check(tally.Faulty == 0, what + "all roots are numbers in [0, 1]");
    check(tally.Invented == 0, what + "no roots where there are none");
    check.AtMost(hard ? tally.MissedSeparated : tally.Missed, hard ? 0.0 : 1e-6 * tally.Solved,
      what + "missed");
    check.AtMost(tally.LargestError, limits.Tolerance, what + "error");
  }
}
} // anonymous namespace

int TestFirstRootShader(int argc, char* argv[])
{
  const int given = argc > 1 ? std::atoi(argv[1]) : 0; // vtkTesting's own arguments are no numbers
  const int count = given > 0 ? given : 20000;
  PointSurfaceTest::Checks check;
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(16, 16);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  window->Render();
  auto* context = vtkOpenGLRenderWindow::SafeDownCast(window);
  check(context != nullptr, "a window of OpenGL");
  if (context)
  {
    PrintHead();
    TestDegree<2>(context, check, count);
    TestDegree<3>(context, check, count);
    TestDegree<4>(context, check, count);
  }
  return check.GetResult();
}

#else

int TestFirstRootShader(int, char*[])
{
  std::cout << "skipped: Boost.Multiprecision is absent" << std::endl;
  return EXIT_SUCCESS;
}

#endif
