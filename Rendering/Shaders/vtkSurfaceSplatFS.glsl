// SPDX-License-Identifier: BSD-3-Clause
// A pixel of a splat: in the first pass for the depth that is visible, in the second for what is
// blended there, in the third, which selection alone has, for the splat of the largest weight.
uniform mat4 VCDCMatrix;
uniform vec2 targetSize;        // in pixels
uniform int numberOfClippingPlanes;
uniform vec4 clippingPlanes[6]; // in eye coordinates
uniform float blendRadius;

flat in vec2 center;
flat in vec3 ellipse;
flat in vec3 plane;
flat in float tolerance;
flat in float isBack;
flat in float facesViewer;
flat in vec3 normal;
flat in vec4 color;
flat in uint id;

// The place in eye coordinates that a pixel has at a depth.
vec4 getPosition(float depth)
{
  vec2 ndc = 2.0 * gl_FragCoord.xy / targetSize - 1.0;
  float w = VCDCMatrix[3][3] - VCDCMatrix[2][3] * depth;
  float y = (ndc.y * w + VCDCMatrix[2].y * depth - VCDCMatrix[3].y) / VCDCMatrix[1].y;
  float x = (ndc.x * w - VCDCMatrix[1].x * y + VCDCMatrix[2].x * depth - VCDCMatrix[3].x) / VCDCMatrix[0].x;
  return vec4(x, y, -depth, 1.0);
}

void main()
{
  vec2 d = gl_FragCoord.xy - center;
  float e = ellipse.x * d.x * d.x + d.y * (ellipse.y * d.x + ellipse.z * d.y);
  float depth = plane.x + dot(plane.yz, d);
  for (int i = 0; i < numberOfClippingPlanes; ++i)
  {
    if (dot(clippingPlanes[i], getPosition(depth)) < 0.0)
    {
      discard;
    }
  }
  // a back is only seen where it is before the front by more than the tolerance
  float key = depth + isBack * tolerance;
#ifdef OUT_NEARNESS
  float isDisc = e < CORE_LIMIT ? 1.0 : 0.0;
  float isFront = 1.0 - isBack;
  if (!(e < blendRadius * blendRadius) || isDisc + isFront == 0.0)
  {
    discard;
  }
  // of the front's discs, of the back's, of the front with all margins, with those that face the viewer
  OUT_NEARNESS = vec4(isDisc * isFront, isDisc * isBack, isFront, facesViewer) / key;
#else
  vec4 visible = texelFetch(inNearness, ivec2(gl_FragCoord.xy), 0);
  // a back before the front's discs, or nothing, is seen through a gap between them, if it is not
  // before their margins too
  float front = visible.y > visible.x ? max(visible.x, visible.z)
    : visible.x == 0.0                ? visible.w
                                      : visible.x;
  bool showsBack = visible.y > front;
  float nearness = showsBack ? visible.y : front;
  float root = 1.0 - e / (blendRadius * blendRadius);
  if (!(root > 0.0) || !(nearness > 0.0) || showsBack != (isBack > 0.5) ||
    !(key <= 1.0 / nearness + tolerance))
  {
    discard;
  }
  float weight = root * root * root * root;
#ifdef OUT_ID
  OUT_ID = id;
  gl_FragDepth = 1.0 - weight;
#else
  OUT_SUM = weight * vec4(normal, depth);
  OUT_WEIGHT = vec4(weight, 0.0, 0.0, 0.0);
#ifdef OUT_COLOR
  OUT_COLOR = weight * color;
#endif
#endif
#endif
}
