// SPDX-License-Identifier: BSD-3-Clause
// Between window depth (0 to 1, not linear in perspective) and the distance from the eye along the
// view direction, for any projection.
uniform mat4 VCDC;      // from the eye to clip coordinates; see vtkEyeFrame
uniform mat4 eyeToView; // to the view coordinates that other passes take

float toDistance(float depth)
{
  float ndc = 2.0 * depth - 1.0;
  return (VCDC[3][2] - ndc * VCDC[3][3]) / (VCDC[2][2] - ndc * VCDC[2][3]);
}

// The same, and 0 for the background: where nothing has been drawn, and what a pass that interpolates
// depths (vtkEDLShading) has mixed of it with a trace of the surface beside it.
float toSurfaceDistance(float depth)
{
  float distance = toDistance(depth);
  bool isBackground = depth >= 1.0 || (depth > 1.0 - 1e-5 && distance > 0.99 * toDistance(1.0));
  return isBackground ? 0.0 : distance;
}

float toWindowDepth(float distance)
{
  float w = VCDC[3][3] - VCDC[2][3] * distance;
  return 0.5 * (VCDC[3][2] - VCDC[2][2] * distance) / w + 0.5;
}

// The position in view coordinates of a place on the screen, -1 to 1.
vec3 toPosition(vec2 place, float distance)
{
  float w = VCDC[3][3] - VCDC[2][3] * distance;
  vec2 xy = place * w + VCDC[2].xy * distance - VCDC[3].xy;
  float y = xy.y / VCDC[1][1];
  float x = (xy.x - VCDC[1][0] * y) / VCDC[0][0];
  return (eyeToView * vec4(x, y, -distance, 1.0)).xyz;
}
