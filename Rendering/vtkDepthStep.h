// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDepthStep
 * @brief   how far apart in depth two layers of surface are, in eye units; a linear function of
 * depth
 *
 * The same at every depth, or so many times the width of a pixel there. In GLSL a vec2:
 * depthStep.x * depth + depthStep.y.
 */
#ifndef vtkDepthStep_h
#define vtkDepthStep_h

struct vtkDepthStep
{
  float PerDepth = 0.0f;
  float Constant = 0.0f;

  float At(float depth) const { return this->PerDepth * depth + this->Constant; }
  const float* GetData() const { return &this->PerDepth; }
};

#endif
