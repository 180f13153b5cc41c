// SPDX-License-Identifier: BSD-3-Clause
// The surface buffer and what VTK's fragment template reads from it; see vtkSurfaceBufferImpl.glsl.
uniform ivec2 psOrigin;    // of the surface buffer, which has a rim around the viewport, in the framebuffer
ivec2 psOffset = ivec2(0);  // from this fragment to the pixel that is shaded
uniform ivec2 psBegin;     // pixels outside of [begin, end) are not to be read
uniform ivec2 psEnd;
uniform mat4 psVCDC;       // from the eye to clip coordinates
uniform mat4 psEyeToView;  // to the view coordinates of VTK's shaders
uniform mat3 psNormalToView;
uniform bool psHasCoverage; // the normal's length is the share of the pixel that is covered
float psCoverage;
float psFragCoordZ;        // stands for gl_FragCoord.z
float psFragCoordW;        // stands for gl_FragCoord.w
bool psFrontFacing;        // stands for gl_FrontFacing
uniform ivec2 psPoints;    // from the first id of this cloud's to the one past the last
int psPoint;               // stands for gl_PrimitiveID; -1 where there is no surface
vec4 psVertexVC;
#ifdef HAS_DUPLICATES
uniform samplerBuffer psDuplicates; // see vtkDuplicatePoints
uniform float psRecess;             // how far behind its place a pixel of theirs is drawn
uniform bool psLeavesDuplicates;    // draw none of these pixels
#endif

// Whether a normal that points a little away from the viewer leans to where the surface ends or
// recedes: then it is that of the front, past an outline, and not that of the back.
bool psLeansOutward(ivec2 pixel, vec4 geometry)
{
  vec2 side = normalize(geometry.xy + vec2(1e-20, 0.0)) * sign(vec2(psVCDC[0].x, psVCDC[1].y));
  ivec2 offset = ivec2(round(1.5 * side));
  float ahead = texelFetch(psSurface, clamp(pixel + offset, psBegin, psEnd - 1), 0).w;
  float behind = texelFetch(psSurface, clamp(pixel - offset, psBegin, psEnd - 1), 0).w;
  return (ahead > 0.0 ? ahead : 3.4e38) >= (behind > 0.0 ? behind : 3.4e38);
}
//PointSurface::Lit::Dec
