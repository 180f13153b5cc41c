// SPDX-License-Identifier: BSD-3-Clause
// The surface buffer and what VTK's fragment template reads from it; see vtkSurfaceBufferImpl.glsl.
uniform ivec2 psOrigin;    // of the viewport in the framebuffer
uniform mat4 psVCDC;
uniform bool psHasCoverage; // the normal's length is the share of the pixel that is covered
float psCoverage;
float psFragCoordZ;        // stands for gl_FragCoord.z
float psFragCoordW;        // stands for gl_FragCoord.w
bool psFrontFacing;        // stands for gl_FrontFacing
int psPoint;               // stands for gl_PrimitiveID; -1 where there is no surface
vec4 psVertexVC;
