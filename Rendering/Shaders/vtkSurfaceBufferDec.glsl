// SPDX-License-Identifier: BSD-3-Clause
// The surface buffer and what VTK's fragment template reads from it; see vtkSurfaceBufferImpl.glsl.
uniform ivec2 psOrigin;    // of the surface buffer, which has a rim around the viewport, in the framebuffer
uniform vec2 psTexel;      // one over the surface buffer's width and height
ivec2 psOffset = ivec2(0);  // from this fragment to the pixel that is shaded
uniform ivec2 psBegin;     // pixels outside of [begin, end) are not to be read
uniform ivec2 psEnd;
uniform mat4 psVCDC;       // from the eye to clip coordinates
in vec4 psRay;             // x and y in eye coordinates where z is 0, and what they grow by with z
uniform mat4 psEyeToView;  // to the view coordinates of VTK's shaders
uniform mat3 psNormalToView;
uniform int psHasCoverage; // whether the normal's length is the share of the pixel that is covered
uniform int psIsLesser;    // whether another surface, which has more of the pixel, is drawn over this one
uniform int psCoverSteps;  // samples of a pixel, of which alpha says how many are drawn to; 0 where it is blended by
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

// The value of a layer at a place in pixels of the surface buffer. Not by texelFetch, in which software minds levels of detail.
vec4 psFetch(sampler2D layer, vec2 place)
{
  return textureLod(layer, place * psTexel, 0.0);
}

// What becomes of alpha by the share of the pixel that the surface covers. What lies behind another one, which is drawn over
// it and has the rest of the pixel, takes as much more as that hides.
float psCover(float alpha)
{
  float covered = alpha * psCoverage;
  covered = psIsLesser != 0 ? covered / (1.0 - alpha + covered) : covered;
  if (psCoverSteps > 0 && covered < 1.0)
  {
    // the nearest number of samples, of two that are as near the larger one, whatever rounding errors there are; and a
    // little less: a little more may be taken for the next number
    covered = (floor(covered * float(psCoverSteps) + 0.501) - 0.25) / float(psCoverSteps);
  }
  return covered;
}

// Whether a normal that points a little away from the viewer leans to where the surface ends or
// recedes: then it is that of the front, past an outline, and not that of the back.
bool psLeansOutward(vec2 place, vec4 geometry)
{
  vec2 side = normalize(geometry.xy + vec2(1e-20, 0.0)) * sign(vec2(psVCDC[0].x, psVCDC[1].y));
  vec2 offset = round(1.5 * side);
  vec2 first = vec2(psBegin) + 0.5;
  vec2 last = vec2(psEnd) - 0.5;
  float ahead = psFetch(psSurface, clamp(place + offset, first, last)).w;
  float behind = psFetch(psSurface, clamp(place - offset, first, last)).w;
  return (ahead > 0.0 ? ahead : 3.4e38) >= (behind > 0.0 ? behind : 3.4e38);
}
//PointSurface::Lit::Dec
