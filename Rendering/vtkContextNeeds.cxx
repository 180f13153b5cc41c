// SPDX-License-Identifier: BSD-3-Clause
#include "vtkContextNeeds.h"

#include "vtkPointSurfaceCompat.h"

#include <vector>

namespace
{
struct Format
{
  GLenum Internal;
  GLenum External;
  GLenum Type;
  const char* Name;
};

constexpr Format Floats = { GL_RGBA32F, GL_RGBA, GL_FLOAT,
  "textures of 32-bit floats (GL_RGBA32F)" };
constexpr Format Integers = { GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT,
  "textures of 32-bit integers (GL_R32UI)" };
constexpr Format Depths = { GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT,
  "depth textures of 32-bit floats (GL_DEPTH_COMPONENT32F)" };

bool TakeErrors()
{
  bool found = false;
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) // a lost context never runs out
  {
    found = true;
  }
  return found;
}

/// Textures of one pixel and a framebuffer with them; what was bound before is bound again at last.
class Trial
{
public:
  Trial()
  {
    TakeErrors();
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &this->BoundTexture);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &this->BoundForDrawing);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &this->BoundForReading);
    glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &this->BoundForUnpacking);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0); // or textures would be filled from it
    glGenFramebuffers(1, &this->Framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
  }

  ~Trial()
  {
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(this->BoundTexture));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(this->BoundForDrawing));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(this->BoundForReading));
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(this->BoundForUnpacking));
    glDeleteFramebuffers(1, &this->Framebuffer);
    glDeleteTextures(static_cast<GLsizei>(this->Textures.size()), this->Textures.data());
    TakeErrors();
  }

  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  bool CanMake(const Format& format)
  {
    this->Textures.push_back(0);
    glGenTextures(1, &this->Textures.back());
    glBindTexture(GL_TEXTURE_2D, this->Textures.back());
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.Internal), 1, 1, 0, format.External,
      format.Type, nullptr);
    return !TakeErrors();
  }

  /// Whether a further texture can be drawn to, together with all before.
  bool CanDrawTo(const Format& format, GLenum attachment)
  {
    const bool made = this->CanMake(format);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, this->Textures.back(), 0);
    const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    return !TakeErrors() && made && complete;
  }

private:
  GLint BoundTexture = 0;
  GLint BoundForDrawing = 0;
  GLint BoundForReading = 0;
  GLint BoundForUnpacking = 0;
  GLuint Framebuffer = 0;
  std::vector<GLuint> Textures;
};

std::string TooFew(const char* what, int has, vtkIdType wanted)
{
  return std::string("has ") + what + " of up to " + std::to_string(has) + ", not " +
    std::to_string(wanted);
}
}

std::string vtkContextNeeds::FindLackOfTextures()
{
  Trial trial;
  for (const Format& format : { Floats, Integers })
  {
    if (!trial.CanMake(format))
    {
      return std::string("has no ") + format.Name;
    }
  }
  return "";
}

std::string vtkContextNeeds::FindLackOfTargets()
{
  Trial trial;
  const struct
  {
    const Format& Of;
    GLenum Attachment;
  } parts[] = { { Floats, GL_COLOR_ATTACHMENT0 }, { Integers, GL_COLOR_ATTACHMENT1 },
    { Depths, GL_DEPTH_ATTACHMENT } };
  for (const auto& part : parts)
  {
    if (!trial.CanDrawTo(part.Of, part.Attachment))
    {
      return std::string("cannot draw to ") + part.Of.Name;
    }
  }
  if (!trial.CanDrawTo(Floats, GL_COLOR_ATTACHMENT2) ||
    !trial.CanDrawTo(Floats, GL_COLOR_ATTACHMENT3))
  {
    return "cannot draw to four textures at once";
  }
  return "";
}

std::string vtkContextNeeds::FindLackOfPointSize(int size)
{
  GLfloat range[2] = { 1.0f, 1.0f };
  glGetFloatv(GL_POINT_SIZE_RANGE, range);
  TakeErrors();
  return range[1] < static_cast<GLfloat>(size)
    ? TooFew("points (GL_POINT_SIZE_RANGE)", static_cast<int>(range[1]), size) + " pixels"
    : "";
}

std::string vtkContextNeeds::FindLackOfTextureBuffers(vtkIdType texels)
{
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &largest);
  TakeErrors();
  return largest < texels
    ? TooFew("texture buffers (GL_MAX_TEXTURE_BUFFER_SIZE)", largest, texels) + " texels"
    : "";
}
