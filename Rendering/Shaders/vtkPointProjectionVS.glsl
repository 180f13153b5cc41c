//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Project: each point goes to at most one pixel (Marroquim et al. 2007, section 3.1).
in vec4 vertexMC;
in vec3 normalMC;
in float radiusMC;
in vec4 scalarColor;
in vec2 colorTCoord;
in vec2 tcoord;

uniform mat4 MCVCMatrix;
uniform mat4 VCDCMatrix;
uniform mat3 normalMatrix;
uniform float uniformRadius; // 0: each point has its own
uniform float radiusScale;   // from the units of the radii to eye units
uniform int colorSource;     // 0 constantColor, 1 scalarColor, 2 colorTCoord, 3 tcoord
uniform vec4 constantColor;
uniform int firstId;
uniform int cull;            // 1 drops points that face away, 2 those that face the viewer
uniform vec2 depthRange;     // eye depths between which the cloud lies
uniform vec2 targetSize;     // in pixels
uniform bool subpixelCenters;
uniform bool centerDepths;   // see vtkPullFS.glsl
uniform bool onlyFarthest;   // only points within the tolerance behind the nearest one of a pixel
uniform float depthTolerance;
uniform sampler2D nearestInterval;
uniform int numberOfClippingPlanes;
uniform vec4 clippingPlanes[6]; // in eye coordinates

flat out vec4 shape;
flat out vec4 interval;
flat out vec4 color;
flat out uint id;

// Whether the point is to be seen: within the clipping range, on the kept side of all planes.
bool isVisible(vec4 position, vec4 clip)
{
  bool visible = clip.w > 0.0 && abs(clip.z) <= clip.w;
  for (int i = 0; i < numberOfClippingPlanes; ++i)
  {
    visible = visible && dot(clippingPlanes[i], position) >= 0.0;
  }
  return visible;
}

void main()
{
  bool parallel = VCDCMatrix[2][3] == 0.0;
  vec4 position = MCVCMatrix * vertexMC;
  vec3 toViewer = parallel ? vec3(0.0, 0.0, 1.0) : -normalize(position.xyz);

  // A zero normal says that none is known.
  vec3 normal = normalMatrix * normalMC;
  float size = length(normal);
  normal = size > 0.0 ? normal / size : toViewer;
  bool facesViewer = dot(normal, toViewer) >= 0.0;

  float depth = -position.z;
  float radius = radiusScale * (uniformRadius > 0.0 ? uniformRadius : radiusMC);
  shape = vec4(normal, radius);
  color = colorSource == 0 ? constantColor : colorSource == 1 ? scalarColor : vec4(colorSource == 2 ? colorTCoord : tcoord, 0.0, 1.0);
  id = uint(gl_VertexID + firstId) + 1u;

  gl_PointSize = 1.0;
  gl_Position = VCDCMatrix * position;
  if (cull == (facesViewer ? 2 : 1) || !isVisible(position, gl_Position))
  {
    interval = vec4(0.0);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  // The pixel is chosen here, not by the rasteriser with its own rounding.
  vec2 window = 0.5 * targetSize * (gl_Position.xy / gl_Position.w + 1.0);
  vec2 center = floor(window) + 0.5;
  if (onlyFarthest &&
    depth > texelFetch(nearestInterval, ivec2(floor(window)), 0).x + depthTolerance)
  {
    interval = vec4(0.0);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  gl_Position.xy = (2.0 * center / targetSize - 1.0) * gl_Position.w;
  interval.xy = centerDepths ? vec2(depth, 0.0) : vec2(depth, depth + radius);
  interval.zw = subpixelCenters ? window - center : vec2(0.0);

  // Linear depth over the cloud's own range: the same precision everywhere, whatever the camera's
  // clipping range is.
  float linear = (depth - depthRange.x) / (depthRange.y - depthRange.x);
  gl_Position.z = (2.0 * clamp(linear, 0.0, 1.0) - 1.0) * gl_Position.w;
}
