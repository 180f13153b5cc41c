// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceTarget.h"

#include "vtkPointSurfaceCompat.h"
#include "vtkSurfacePixels.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <sstream>

namespace
{
const char* const LayerNames[vtkSurfaceTarget::NumberOfLayers] = { "Shape", "Interval", "Surface",
  "Id", "Color", "Nearness", "Sum", "Weight", "Change" };
const char* const OutputNames[vtkSurfaceTarget::NumberOfLayers] = { "OUT_SHAPE", "OUT_INTERVAL",
  "OUT_SURFACE", "OUT_ID", "OUT_COLOR", "OUT_NEARNESS", "OUT_SUM", "OUT_WEIGHT", "OUT_CHANGE" };

bool IsInteger(vtkSurfaceTarget::Layer layer)
{
  return layer == vtkSurfaceTarget::Id;
}
}

vtkSurfaceTarget::vtkSurfaceTarget() = default;
vtkSurfaceTarget::~vtkSurfaceTarget() = default;

bool vtkSurfaceTarget::Has(Layer layer) const
{
  return std::find(this->Layers.begin(), this->Layers.end(), layer) != this->Layers.end();
}

//------------------------------------------------------------------------------
void vtkSurfaceTarget::Allocate(vtkOpenGLRenderWindow* window, int width, int height,
  const std::vector<Layer>& layers, bool depthBuffer)
{
  if (this->Width == width && this->Height == height && this->Layers == layers)
  {
    return;
  }
  this->ReleaseGraphicsResources(window);
  this->Width = width;
  this->Height = height;
  this->Layers = layers;
  for (Layer layer : layers)
  {
    vtkTextureObject* texture = this->GetTexture(layer);
    texture->SetContext(window);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    texture->SetWrapS(vtkTextureObject::ClampToEdge);
    texture->SetWrapT(vtkTextureObject::ClampToEdge);
    if (IsInteger(layer))
    {
      texture->SetInternalFormat(GL_R32UI);
      texture->SetFormat(GL_RED_INTEGER);
      texture->SetDataType(GL_UNSIGNED_INT);
      texture->Allocate2D(width, height, 1, VTK_UNSIGNED_INT);
    }
    else
    {
      texture->Allocate2D(width, height, 4, VTK_FLOAT);
    }
  }

  this->Framebuffer->SetContext(window);
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  this->Framebuffer->Bind();
  for (size_t i = 0; i < layers.size(); ++i)
  {
    this->Framebuffer->AddColorAttachment(
      static_cast<unsigned int>(i), this->GetTexture(layers[i]));
  }
  if (depthBuffer)
  {
    this->DepthBuffer->SetContext(window);
    this->DepthBuffer->AllocateDepth(width, height, vtkTextureObject::Float32);
    this->Framebuffer->AddDepthAttachment(this->DepthBuffer);
  }
  const char* fault = nullptr;
  if (!vtkOpenGLFramebufferObject::GetFrameBufferStatus(GL_FRAMEBUFFER, fault))
  {
    vtkGenericWarningMacro("A surface target of " << width << " x " << height
                                                  << " pixels cannot be drawn to: " << fault);
  }
  state->PopFramebufferBindings();
}

void vtkSurfaceTarget::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Framebuffer->ReleaseGraphicsResources(window);
  for (auto& texture : this->Textures)
  {
    texture->ReleaseGraphicsResources(window);
  }
  this->DepthBuffer->ReleaseGraphicsResources(window);
  this->Width = this->Height = 0;
  this->Layers.clear();
}

//------------------------------------------------------------------------------
void vtkSurfaceTarget::ShareDepthBuffer(vtkOpenGLRenderWindow* window, vtkSurfaceTarget& owner)
{
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  this->Framebuffer->Bind();
  this->Framebuffer->AddDepthAttachment(owner.DepthBuffer);
  state->PopFramebufferBindings();
}

void vtkSurfaceTarget::BindForWriting(vtkOpenGLRenderWindow* window)
{
  this->BindForWriting(window, this->Layers);
}

void vtkSurfaceTarget::BindForWriting(
  vtkOpenGLRenderWindow* window, const std::vector<Layer>& layers)
{
  this->WrittenLayers = layers;
  const unsigned int count = static_cast<unsigned int>(layers.size());
  this->Framebuffer->Bind();
  this->Framebuffer->ActivateDrawBuffers(count);
  // vtkOpenGLState takes draw buffers 1 and up from the framebuffer that was bound before (it
  // re-reads only the first at a bind), so that the call above can do nothing inside of a pass
  // that has several of its own.
  std::vector<GLenum> buffers(count);
  for (unsigned int i = 0; i < count; ++i)
  {
    buffers[i] = GL_COLOR_ATTACHMENT0 + i;
  }
  glDrawBuffers(static_cast<GLsizei>(count), buffers.data());
  window->GetState()->vtkglViewport(0, 0, this->Width, this->Height);
}

void vtkSurfaceTarget::Clear(
  vtkOpenGLRenderWindow* window, const std::array<int, 4>& rectangle, float depth)
{
  // To software a rectangle is something to draw, and all of a target is not.
  vtkOpenGLState* state = window->GetState();
  const bool isMost = 3 * rectangle[2] * rectangle[3] > 2 * this->Width * this->Height;
  state->vtkglScissor(rectangle[0], rectangle[1], rectangle[2], rectangle[3]);
  state->SetEnumState(GL_SCISSOR_TEST, !isMost);
  const GLfloat zero[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
  const GLuint none[4] = { 0, 0, 0, 0 };
  for (size_t i = 0; i < this->WrittenLayers.size(); ++i)
  {
    if (IsInteger(this->WrittenLayers[i]))
    {
      glClearBufferuiv(GL_COLOR, static_cast<GLint>(i), none);
    }
    else
    {
      glClearBufferfv(GL_COLOR, static_cast<GLint>(i), zero);
    }
  }
  glClearBufferfv(GL_DEPTH, 0, &depth);
  state->vtkglEnable(GL_SCISSOR_TEST);
}

//------------------------------------------------------------------------------
void vtkSurfaceTarget::Activate()
{
  for (Layer layer : this->Layers)
  {
    this->GetTexture(layer)->Activate();
  }
}

void vtkSurfaceTarget::SetSamplers(vtkShaderProgram* program, const std::string& prefix)
{
  for (Layer layer : this->Layers)
  {
    const std::string name = prefix + LayerNames[layer];
    program->SetUniformi(name.c_str(), this->GetTexture(layer)->GetTextureUnit());
  }
}

void vtkSurfaceTarget::Deactivate()
{
  for (Layer layer : this->Layers)
  {
    this->GetTexture(layer)->Deactivate();
  }
}

//------------------------------------------------------------------------------
std::string vtkSurfaceTarget::GetInputDeclarations(
  const std::vector<Layer>& layers, const std::string& prefix)
{
  std::string text;
  for (Layer layer : layers)
  {
    text += std::string("uniform ") + (IsInteger(layer) ? "usampler2D " : "sampler2D ") + prefix +
      LayerNames[layer] + ";\n";
    text += layer == Id ? "#define HAS_ID\n" : layer == Color ? "#define HAS_COLOR\n" : "";
  }
  return text;
}

std::string vtkSurfaceTarget::GetOutputDeclarations(const std::vector<Layer>& layers)
{
  // vtkOpenGLShaderCache renames gl_FragData[i] to fragOutput<i> and binds that to location i; it
  // would declare all of them as vec4, so they are declared here.
  std::ostringstream text;
  for (size_t i = 0; i < layers.size(); ++i)
  {
    text << "out " << (IsInteger(layers[i]) ? "uint" : "vec4") << " fragOutput" << i << ";\n"
         << "#define " << OutputNames[layers[i]] << " gl_FragData[" << i << "]\n";
  }
  auto has = [&](Layer layer)
  { return std::find(layers.begin(), layers.end(), layer) != layers.end(); };
  text << "#define WRITE_ID(value)" << (has(Id) ? " OUT_ID = value\n" : "\n")
       << "#define WRITE_COLOR(value)" << (has(Color) ? " OUT_COLOR = value\n" : "\n");
  return text.str();
}

//------------------------------------------------------------------------------
size_t vtkSurfaceTarget::Upload(vtkOpenGLRenderWindow* window, const vtkSurfacePixels& pixels,
  const std::vector<std::array<int, 4>>& rectangles)
{
  const auto& r = pixels.Rectangle;
  const size_t width = r[2] - r[0];
  size_t bytes = 0;
  for (Layer layer : this->Layers)
  {
    for (const auto& rectangle : rectangles)
    {
      const size_t first = (rectangle[1] - r[1]) * width + rectangle[0] - r[0];
      const void* values = layer == Id ? static_cast<const void*>(&pixels.Id[first])
        : layer == Color               ? &pixels.Color[4 * first]
                                       : &pixels.Surface[4 * first];
      bytes += this->Upload(window, layer, rectangle, values, static_cast<int>(width));
    }
  }
  return bytes;
}

size_t vtkSurfaceTarget::Upload(vtkOpenGLRenderWindow* window, Layer layer,
  const std::array<int, 4>& rectangle, const void* values, int stride)
{
  const int width = rectangle[2] - rectangle[0];
  const int height = rectangle[3] - rectangle[1];
  const bool integer = IsInteger(layer);
  vtkTextureObject* texture = this->GetTexture(layer);
  vtkOpenGLState* state = window->GetState();
  state->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  state->vtkglPixelStorei(GL_UNPACK_ROW_LENGTH, stride);
  texture->Activate();
  glTexSubImage2D(GL_TEXTURE_2D, 0, rectangle[0], rectangle[1], width, height,
    integer ? GL_RED_INTEGER : GL_RGBA, integer ? GL_UNSIGNED_INT : GL_FLOAT, values);
  texture->Deactivate();
  state->vtkglPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  return static_cast<size_t>(width) * height * (integer ? sizeof(unsigned int) : 4 * sizeof(float));
}

//------------------------------------------------------------------------------
void vtkSurfaceTarget::Read(
  vtkOpenGLRenderWindow* window, Layer layer, const std::array<int, 4>& rectangle, void* pixels)
{
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  this->Framebuffer->Bind();
  const auto attachment =
    std::find(this->Layers.begin(), this->Layers.end(), layer) - this->Layers.begin();
  this->Framebuffer->ActivateReadBuffer(static_cast<unsigned int>(attachment));
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, 1);
  state->vtkglPixelStorei(GL_PACK_ROW_LENGTH, this->Width);
  state->vtkglPixelStorei(GL_PACK_SKIP_PIXELS, rectangle[0]);
  state->vtkglPixelStorei(GL_PACK_SKIP_ROWS, rectangle[1]);
  glReadPixels(rectangle[0], rectangle[1], rectangle[2], rectangle[3],
    IsInteger(layer) ? GL_RED_INTEGER : GL_RGBA, IsInteger(layer) ? GL_UNSIGNED_INT : GL_FLOAT,
    pixels);
  for (GLenum option : { GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS })
  {
    state->vtkglPixelStorei(option, 0);
  }
  state->PopFramebufferBindings();
}

std::vector<float> vtkSurfaceTarget::ReadFloats(
  vtkOpenGLRenderWindow* window, Layer layer, const std::vector<std::array<int, 4>>& rectangles)
{
  std::vector<float> pixels(static_cast<size_t>(this->Width) * this->Height * 4, 0.0f);
  for (const auto& rectangle : rectangles)
  {
    this->Read(window, layer, rectangle, pixels.data());
  }
  return pixels;
}

std::vector<unsigned int> vtkSurfaceTarget::ReadIds(
  vtkOpenGLRenderWindow* window, const std::vector<std::array<int, 4>>& rectangles)
{
  std::vector<unsigned int> pixels(static_cast<size_t>(this->Width) * this->Height, 0);
  for (const auto& rectangle : rectangles)
  {
    this->Read(window, Id, rectangle, pixels.data());
  }
  return pixels;
}
