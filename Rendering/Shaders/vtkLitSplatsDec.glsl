// SPDX-License-Identifier: BSD-3-Clause
// Of the shading of splats; see vtkLitSplatsImpl.glsl.
bool psLightsSplat = false; // or the pixel
ivec2 psSplat;              // the texel of the splat that is lit
vec4 psLit = vec4(0.0);     // sum of lit colours
float psWeight = 0.0;       // and of their weights
