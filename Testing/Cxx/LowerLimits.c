/* SPDX-License-Identifier: BSD-3-Clause */
/* Loaded before OpenGL's library (LD_PRELOAD) this tells of smaller limits than there are: the
 * largest point by POINTSURFACE_TEST_POINT_SIZE, the largest texture buffer by
 * POINTSURFACE_TEST_TEXTURE_BUFFER_SIZE. */
#include <GL/gl.h>
#include <GL/glext.h>
#include <dlfcn.h>
#include <stdlib.h>

/* Not RTLD_NEXT: Python keeps what its modules bring to themselves. */
static void* find(const char* name)
{
  void* library = dlopen("libGL.so.1", RTLD_LAZY);
  return library ? dlsym(library, name) : NULL;
}

void glGetFloatv(GLenum name, GLfloat* values)
{
  const char* size = getenv("POINTSURFACE_TEST_POINT_SIZE");
  ((void (*)(GLenum, GLfloat*))find("glGetFloatv"))(name, values);
  if (name == GL_POINT_SIZE_RANGE && size)
  {
    values[1] = (GLfloat)atof(size);
  }
}

void glGetIntegerv(GLenum name, GLint* values)
{
  const char* size = getenv("POINTSURFACE_TEST_TEXTURE_BUFFER_SIZE");
  ((void (*)(GLenum, GLint*))find("glGetIntegerv"))(name, values);
  if (name == GL_MAX_TEXTURE_BUFFER_SIZE && size)
  {
    *values = atoi(size);
  }
}
