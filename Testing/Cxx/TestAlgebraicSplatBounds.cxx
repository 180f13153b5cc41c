// SPDX-License-Identifier: BSD-3-Clause
// The rectangle on the screen that a splat is drawn by: around the discs' rims, point by point, it
// is a pixel larger on each side and no more, in views that are hard: grazing, far off the axis,
// parallel, sheared, near the eye. It is the whole picture where the splat reaches the plane of the
// eye, and empty where all of it is behind a plane.
#include "PointSurfaceTestUtilities.h"

#include "vtkAlgebraicSplatBounds.h"
#include "vtkAlgebraicSplatVS.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPixelBufferObject.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <GL/gl.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

using namespace PointSurfaceTest;

namespace
{
Checks check;

constexpr int Size = 64;
constexpr double Near = 0.5;
constexpr double Far = 50.0;

using Vector = std::array<double, 3>;

/// In eye coordinates; u, v and n are of the length of the disc's radius.
struct Disc
{
  Vector Center, U, V, N;
  double Radius;
  std::array<float, 2> Heights;
};

struct View
{
  std::string Name;
  vtkNew<vtkCamera> Camera;
  vtkNew<vtkMatrix4x4> Matrix; // from eye to clip coordinates
};

class Random
{
public:
  Random() { this->Sequence->SetSeed(3); }
  double Get(double low, double high)
  {
    this->Sequence->Next();
    return low + (high - low) * this->Sequence->GetValue();
  }
  Vector GetDirection()
  {
    Vector d = { this->Get(-1, 1), this->Get(-1, 1), this->Get(-1, 1) };
    vtkMath::Normalize(d.data());
    return d;
  }

private:
  vtkNew<vtkMinimalStandardRandomSequence> Sequence;
};

Disc MakeDisc(const Vector& center, double radius, Vector n, Random& random)
{
  Disc disc;
  disc.Center = center;
  disc.Radius = radius;
  vtkMath::Normalize(n.data());
  vtkMath::Perpendiculars(n.data(), disc.U.data(), disc.V.data(), random.Get(0.0, 6.0));
  vtkMath::Cross(n.data(), disc.U.data(), disc.V.data());
  for (int i = 0; i < 3; ++i)
  {
    disc.N[i] = radius * n[i];
    disc.U[i] *= radius;
    disc.V[i] *= radius;
  }
  disc.Heights = { static_cast<float>(-random.Get(0.0, 0.4)),
    static_cast<float>(random.Get(0.0, 0.4)) };
  return disc;
}

/// What the rims of a disc's cylinder reach, by many of their points.
struct Extent
{
  double Low[2] = { 1e300, 1e300 }; // in pixels
  double High[2] = { -1e300, -1e300 };
  double LeastW = 1e300;      // of the cylinder
  double MostBefore = -1e300; // of a plane of the clipping range, in units of clip coordinates

  Extent(const Disc& disc, vtkMatrix4x4* matrix)
  {
    constexpr int Steps = 4000;
    double before[2] = { -1e300, -1e300 };
    for (float height : disc.Heights)
    {
      for (int i = 0; i < Steps; ++i)
      {
        const double angle = 2.0 * vtkMath::Pi() * i / Steps;
        double p[4] = { 0, 0, 0, 1 };
        for (int k = 0; k < 3; ++k)
        {
          p[k] = disc.Center[k] + std::cos(angle) * disc.U[k] + std::sin(angle) * disc.V[k] +
            height * disc.N[k];
        }
        matrix->MultiplyPoint(p, p);
        this->LeastW = std::min(this->LeastW, p[3]);
        before[0] = std::max(before[0], p[3] + p[2]);
        before[1] = std::max(before[1], p[3] - p[2]);
        for (int k = 0; k < 2; ++k)
        {
          const double pixel = 0.5 * Size * (p[k] / p[3] + 1.0);
          this->Low[k] = std::min(this->Low[k], pixel);
          this->High[k] = std::max(this->High[k], pixel);
        }
      }
    }
    this->MostBefore = std::min(before[0], before[1]);
  }
};

/// Draws a splat's primitive alone; what it covers are the pixels from [0], [1] to [2], [3].
class Drawing
{
public:
  Drawing()
  {
    this->Window->SetOffScreenRendering(1);
    this->Window->SetSize(Size, Size);
    this->Window->AddRenderer(this->Renderer);
    this->Window->Render();
    this->Context = vtkOpenGLRenderWindow::SafeDownCast(this->Window);
    this->Image->SetContext(this->Context);
    this->Image->Create2D(Size, Size, 4, VTK_FLOAT, false);
    this->Target->SetContext(this->Context);
  }
  ~Drawing()
  {
    this->VertexArray->ReleaseGraphicsResources();
    this->Image->ReleaseGraphicsResources(this->Window);
    this->Target->ReleaseGraphicsResources(this->Window);
  }

  std::array<int, 4> Draw(const Disc& disc, vtkMatrix4x4* matrix)
  {
    const double r = disc.Radius;
    std::vector<float> texels(16, 0.0f);
    for (int i = 0; i < 3; ++i)
    {
      texels[i] = static_cast<float>(disc.Center[i]);
      texels[4 + i] = static_cast<float>(disc.N[i] / r);
      texels[8 + i] = static_cast<float>(disc.U[i] / r);
    }
    texels[3] = static_cast<float>(r);
    texels[7] = disc.Heights[0];
    texels[11] = disc.Heights[1];
    vtkNew<vtkOpenGLBufferObject> buffer;
    buffer->Upload(texels, vtkOpenGLBufferObject::TextureBuffer);
    vtkNew<vtkTextureObject> splats;
    splats->SetContext(this->Context);
    splats->CreateTextureBuffer(4, 4, VTK_FLOAT, buffer);

    vtkOpenGLState* state = this->Context->GetState();
    state->PushFramebufferBindings();
    this->Target->Bind();
    this->Target->AddColorAttachment(0, this->Image);
    this->Target->ActivateDrawBuffer(0);
    this->Target->Start(Size, Size);
    for (unsigned int capability : { GL_BLEND, GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_CULL_FACE })
    {
      state->vtkglDisable(capability);
    }
    state->vtkglClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    state->vtkglClear(GL_COLOR_BUFFER_BIT);
    vtkShaderProgram* program = this->Context->GetShaderCache()->ReadyShaderProgram(
      vtkAlgebraicSplatVS,
      "//VTK::System::Dec\nout vec4 fragOutput0;\nvoid main() { fragOutput0 = vec4(1.0); }\n", "");
    if (program)
    {
      this->VertexArray->Bind();
      splats->Activate();
      program->SetUniformi("splats", splats->GetTextureUnit());
      program->SetUniformi("stride", 4);
      program->SetUniformi("first", 0);
      const float origin[3] = { 0, 0, 0 };
      program->SetUniform3f("origin", origin);
      float toEye[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
      program->SetUniformMatrix3x3("toEye", toEye);
      vtkNew<vtkMatrix4x4> transposed;
      vtkMatrix4x4::Transpose(matrix, transposed);
      program->SetUniformMatrix("VCDCMatrix", transposed);
      const float pixel[2] = { 2.0f / Size, 2.0f / Size };
      program->SetUniform2f("pixel", pixel);
      float planes[8][4] = {};
      for (int i = 0; i < 4; ++i)
      {
        planes[0][i] = static_cast<float>(matrix->GetElement(3, i) + matrix->GetElement(2, i));
        planes[1][i] = static_cast<float>(matrix->GetElement(3, i) - matrix->GetElement(2, i));
      }
      program->SetUniformi("numberOfPlanes", 2);
      program->SetUniform4fv("planes", 8, planes);
      glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
      splats->Deactivate();
      this->VertexArray->Release();
    }
    this->Target->RemoveColorAttachment(0);
    state->PopFramebufferBindings();

    vtkPixelBufferObject* pixels = this->Image->Download();
    std::vector<float> picture(static_cast<size_t>(4) * Size * Size);
    unsigned int size[2] = { Size, Size };
    vtkIdType steps[2] = { 0, 0 };
    pixels->Download2D(VTK_FLOAT, picture.data(), size, 4, steps);
    pixels->Delete();
    splats->ReleaseGraphicsResources(this->Window);
    std::array<int, 4> covered = { Size, Size, 0, 0 };
    for (int y = 0; y < Size; ++y)
    {
      for (int x = 0; x < Size; ++x)
      {
        if (picture[4 * (y * Size + x)] > 0.0f)
        {
          covered = { std::min(covered[0], x), std::min(covered[1], y), std::max(covered[2], x + 1),
            std::max(covered[3], y + 1) };
        }
      }
    }
    return covered;
  }

private:
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkOpenGLRenderWindow* Context = nullptr;
  vtkNew<vtkTextureObject> Image;
  vtkNew<vtkOpenGLFramebufferObject> Target;
  vtkNew<vtkOpenGLVertexArrayObject> VertexArray;
};

/// What was tried in a view, and how far off it was.
struct Tally
{
  int Around = 0;   // have a rectangle around them
  int Whole = 0;    // reach the plane of the eye
  int Behind = 0;   // are behind a plane
  double Off = 0.0; // of the rectangles' edges, in pixels
  double OffOnGPU = 0.0;
  int Wrong = 0; // neither whole nor empty where they ought to be
};

void Try(const Disc& disc, vtkMatrix4x4* matrix, Drawing& drawing, Tally& tally)
{
  const Extent extent(disc, matrix);
  const double scale = 1e-3 * disc.Radius;
  if (std::abs(extent.LeastW) < scale || std::abs(extent.MostBefore) < scale)
  {
    return; // rounding decides
  }
  const std::array<int, 4> drawn = drawing.Draw(disc, matrix);
  const bool isEmpty = drawn[0] >= drawn[2];
  if (extent.MostBefore < 0.0)
  {
    ++tally.Behind;
    tally.Wrong += isEmpty ? 0 : 1;
    return;
  }
  std::array<double, 16> transposed;
  for (int i = 0; i < 16; ++i)
  {
    transposed[i] = matrix->GetElement(i % 4, i / 4);
  }
  std::array<double, 4> bounds;
  const bool isAround = vtkAlgebraicSplatBounds::Get(
    transposed, disc.Center, disc.U, disc.V, disc.N, disc.Heights, bounds);
  if (extent.LeastW < 0.0)
  {
    ++tally.Whole;
    tally.Wrong += !isAround && drawn == std::array<int, 4>{ 0, 0, Size, Size } ? 0 : 1;
    return;
  }
  ++tally.Around;
  if (!isAround)
  {
    ++tally.Wrong;
    return;
  }
  for (int k = 0; k < 2; ++k)
  {
    const double low = 0.5 * Size * (bounds[k] + 1.0);
    const double high = 0.5 * Size * (bounds[2 + k] + 1.0);
    const double width = std::max(1.0, high - low); // rims are points, not all of the circle
    tally.Off = std::max({ tally.Off, std::abs(low - extent.Low[k]) / width,
      std::abs(high - extent.High[k]) / width });
  }
  // a pixel is covered if its centre is within the rectangle, which is larger by a pixel
  bool isOutside = false;
  for (int k = 0; k < 2; ++k)
  {
    isOutside = isOutside || extent.Low[k] - 1.0 > Size - 0.5 || extent.High[k] + 1.0 < 0.5;
  }
  if (isEmpty || isOutside)
  {
    tally.Wrong += isEmpty == isOutside ? 0 : 1;
    return;
  }
  for (int k = 0; k < 2; ++k)
  {
    const double low = std::max(0.0, std::ceil(extent.Low[k] - 1.5));
    const double high = std::min<double>(Size, std::floor(extent.High[k] + 1.5));
    // as whole numbers, but that a centre may be at the very edge
    tally.OffOnGPU =
      std::max({ tally.OffOnGPU, std::abs(drawn[k] - low), std::abs(drawn[2 + k] - high) });
  }
}
} // anonymous namespace

int TestAlgebraicSplatBounds(int, char*[])
{
  Drawing drawing;
  Random random;
  for (const std::string view :
    { "ahead", "grazing", "off the axis", "parallel", "off-centre window", "near the eye" })
  {
    const bool isGrazing = view == "grazing";
    const bool isNear = view == "near the eye";
    vtkNew<vtkCamera> camera;
    camera->SetViewAngle(view == "off the axis" ? 140.0 : 40.0);
    camera->SetParallelProjection(view == "parallel");
    camera->SetParallelScale(3.0);
    if (view == "off-centre window")
    {
      camera->SetWindowCenter(0.5, -0.4);
    }
    camera->SetClippingRange(Near, Far);
    vtkMatrix4x4* matrix = camera->GetProjectionTransformMatrix(1.0, -1.0, 1.0);
    Tally tally;
    for (int i = 0; i < 150; ++i)
    {
      const double z = isNear ? -random.Get(-0.8, 1.2) : -random.Get(3.0, 12.0);
      const double reach = view == "off the axis" ? -2.7 * z : view == "parallel" ? 3.0 : -0.4 * z;
      const Vector center = { random.Get(-1.0, 1.0) * (isNear ? 0.6 : reach),
        random.Get(-1.0, 1.0) * (isNear ? 0.6 : reach), z };
      Vector n = random.GetDirection();
      if (isGrazing) // at a right angle to the ray, within a degree
      {
        const double along =
          vtkMath::Dot(n.data(), center.data()) / vtkMath::Dot(center.data(), center.data());
        for (int k = 0; k < 3; ++k)
        {
          n[k] -= (along + random.Get(-0.01, 0.01) / 10.0) * center[k];
        }
      }
      Try(
        MakeDisc(center, random.Get(0.05, isNear ? 0.9 : 0.6), n, random), matrix, drawing, tally);
    }
    check.AtLeast(tally.Around, isNear ? 20 : 140, view + ": splats with a rectangle around them");
    if (isNear)
    {
      check.AtLeast(tally.Whole, 8, view + ": splats that reach the plane of the eye");
      check.AtLeast(tally.Behind, 20, view + ": splats behind a plane");
    }
    check(tally.Wrong == 0,
      view + ": whole or empty where it ought to be, " + std::to_string(tally.Wrong) + " are not");
    check.AtMost(tally.Off, 1e-4, view + ": edges off the rims, of the rectangle's width");
    check.AtMost(tally.OffOnGPU, 1.0, view + ": edges drawn off the rims and a pixel, in pixels");
  }
  return check.GetResult();
}
