//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// The projection of a disc: an ellipse, and the rectangle around it; see vtkSurfaceSplatParameters.
layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

in vec4 disc[];
in vec3 discNormal[];
in vec4 discColor[];
flat in uint discId[];

uniform mat4 VCDCMatrix;
uniform vec2 targetSize;    // in pixels
uniform float pixelSize;    // in eye units, times w
uniform float blendRadius;
uniform float depthTolerance;

flat out vec2 center;       // in pixels
flat out vec3 ellipse;      // e = x dx^2 + y dx dy + z dy^2
flat out vec3 plane;        // depth at the centre, its slope
flat out float tolerance;   // of depth
flat out float isBack;
flat out float facesViewer; // enough for margins that cover
flat out vec3 normal;
flat out vec4 color;
flat out uint id;

void main()
{
  float radius = disc[0].w;
  if (!(radius > 0.0))
  {
    return;
  }
  bool parallel = VCDCMatrix[2][3] == 0.0;
  vec3 position = disc[0].xyz;
  normal = discNormal[0];
  vec4 clip = VCDCMatrix * vec4(position, 1.0);
  vec2 ndc = clip.xy / clip.w;
  float facing = parallel ? normal.z : -dot(position, normal) / length(position);
  isBack = facing >= 0.0 ? 0.0 : 1.0;
  facesViewer = facing > MARGIN_COSINE ? 1.0 : 0.0;
  radius = parallel ? radius : min(radius, -LARGEST_SHARE_OF_DEPTH * position.z / max(length(normal.xy), 1e-20));
  tolerance = depthTolerance * radius + TOLERANCE_PIXELS * pixelSize * clip.w;

  // a step of the radius along an axis of the eye, in pixels
  mat4 rows = transpose(VCDCMatrix);
  vec2 scale = 0.5 * radius / clip.w * targetSize;
  vec3 x = scale.x * (rows[0].xyz - ndc.x * rows[3].xyz);
  vec3 y = scale.y * (rows[1].xyz - ndc.y * rows[3].xyz);
  vec2 n = vec2(dot(x, normal), dot(y, normal));
  vec3 v = vec3(dot(x, x), dot(x, y), dot(y, y)) - vec3(n.x * n.x, n.x * n.y, n.y * n.y) +
    vec3(LOW_PASS_VARIANCE, 0.0, LOW_PASS_VARIANCE);
  float determinant = v.x * v.z - v.y * v.y;
  // covariances of the place on the screen with the depth
  vec2 withDepth = radius * (normal.z * n - vec2(x.z, y.z));
  center = 0.5 * targetSize * (ndc + 1.0);
  ellipse = vec3(v.z, -2.0 * v.y, v.x) / determinant;
  plane = vec3(-position.z,
    vec2(withDepth.x * v.z - withDepth.y * v.y, withDepth.y * v.x - withDepth.x * v.y) / determinant);
  color = discColor[0];
  id = discId[0];

  vec2 reach = blendRadius * sqrt(v.xz);
  vec2 low = max(2.0 * (center - reach) / targetSize - 1.0, -1.0);
  vec2 high = min(2.0 * (center + reach) / targetSize - 1.0, 1.0);
  if (any(greaterThanEqual(low, high)))
  {
    return;
  }
  // what is flat is undefined after each vertex that is emitted
  vec2 c = center;
  vec3 e = ellipse, p = plane, m = normal;
  float t = tolerance, b = isBack, f = facesViewer;
  vec4 rgba = color;
  uint i = id;
  for (int corner = 0; corner < 4; ++corner)
  {
    center = c;
    ellipse = e;
    plane = p;
    normal = m;
    tolerance = t;
    isBack = b;
    facesViewer = f;
    color = rgba;
    id = i;
    gl_Position = vec4(mix(low, high, vec2(corner & 1, corner >> 1)), 0.0, 1.0);
    EmitVertex();
  }
  EndPrimitive();
}
