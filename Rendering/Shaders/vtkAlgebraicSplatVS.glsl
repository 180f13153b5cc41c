//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// A splat's place in eye coordinates, and the rectangle around it on the screen.
uniform samplerBuffer splats; // see vtkAlgebraicSplatTracingOpenGL
uniform int stride;           // texels a splat
uniform int first;            // splat to be drawn
uniform mat3 toEye;
uniform vec3 origin;          // of the splats, in eye coordinates
uniform mat4 VCDCMatrix;
uniform vec2 pixel;           // the size of a pixel in normalised device coordinates
uniform vec4 planes[8];       // what is behind one of them is not seen, in eye coordinates
uniform int numberOfPlanes;

flat out vec3 center;
// From eye vectors to the splat's frame in units of its disc.
flat out vec3 toU;
flat out vec3 toV;
flat out vec3 toN;
flat out vec2 heights;
flat out float unit;   // of depth along the ray, of the size of the disc
flat out int firstTexel;
flat out int splat;

void main()
{
  splat = first + gl_InstanceID;
  firstTexel = splat * stride;
  vec4 place = texelFetch(splats, firstTexel);
  vec4 across = texelFetch(splats, firstTexel + 1);
  vec4 along = texelFetch(splats, firstTexel + 2);
  vec3 n = toEye * across.xyz;
  vec3 u = toEye * along.xyz;
  vec3 v = toEye * cross(across.xyz, along.xyz);
  center = origin + toEye * place.xyz;
  heights = vec2(across.w, along.w);
  float volume = dot(u, cross(v, n));
  toU = cross(v, n) / volume / place.w;
  toV = cross(n, u) / volume / place.w;
  toN = cross(u, v) / volume / place.w;
  unit = place.w * pow(abs(volume), 1.0 / 3.0);
  n *= place.w;
  u *= place.w;
  v *= place.w;

  // The cylinder that the patch lies in is around the discs at its two ends. A disc's x / w is
  // least and largest where a line of constant x / w touches it.
  vec2 low = vec2(1.0);
  vec2 high = vec2(-1.0);
  for (int i = 0; i < 2; ++i)
  {
    vec4 c = VCDCMatrix * vec4(center + heights[i] * n, 1.0);
    vec4 cu = VCDCMatrix * vec4(u, 0.0);
    vec4 cv = VCDCMatrix * vec4(v, 0.0);
    if (c.w <= 1.0001 * length(vec2(cu.w, cv.w)))
    {
      low = vec2(-1.0); // it is beside the eye, or behind
      high = vec2(1.0);
      break;
    }
    // of the distance 1: fourth powers of very large or small ones are not to be had in floats
    cu /= c.w;
    cv /= c.w;
    c /= c.w;
    float a = c.w * c.w - cu.w * cu.w - cv.w * cv.w;
    vec2 b = c.xy * c.w - cu.xy * cu.w - cv.xy * cv.w;
    vec2 root = sqrt(max(b * b - a * (c.xy * c.xy - cu.xy * cu.xy - cv.xy * cv.xy), 0.0));
    low = min(low, (b - root) / a - pixel);
    high = max(high, (b + root) / a + pixel);
  }
  for (int i = 0; i < numberOfPlanes; ++i)
  {
    float along = dot(planes[i].xyz, n);
    float farthest = dot(planes[i].xyz, center) + planes[i].w +
      max(heights.x * along, heights.y * along) +
      length(vec2(dot(planes[i].xyz, u), dot(planes[i].xyz, v)));
    if (farthest < 0.0)
    {
      low = high; // nothing of it is before the plane
    }
  }
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(mix(clamp(low, -1.0, 1.0), clamp(high, -1.0, 1.0), corner), 0.0, 1.0);
}
