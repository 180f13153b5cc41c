//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// The points of a cloud as they are uploaded, and what brings them to the eye; before the vertex
// shaders that draw points.
in vec4 vertexMC;
in vec3 normalMC;
in float radiusMC;
in vec4 scalarColor;
in vec2 colorTCoord;
in vec2 tcoord;
in uint pointId;

uniform mat4 MCVCMatrix;
uniform mat4 VCDCMatrix;
uniform mat3 normalMatrix;
uniform float uniformRadius; // 0: each point has its own
uniform float radiusScale;   // from the units of the radii to eye units
uniform int colorSource;     // 0 constantColor, 1 scalarColor, 2 colorTCoord, 3 tcoord
uniform vec4 constantColor;
uniform int firstId;
uniform int cull;            // 1 drops points that face away, 2 those that face the viewer
uniform vec2 targetSize;     // in pixels
uniform int numberOfClippingPlanes;
uniform vec4 clippingPlanes[6]; // in eye coordinates

vec3 getToViewer(vec4 position)
{
  return VCDCMatrix[2][3] == 0.0 ? vec3(0.0, 0.0, 1.0) : -normalize(position.xyz);
}

// A zero normal says that none is known: it faces the viewer.
vec3 getNormal(vec3 toViewer)
{
  vec3 normal = normalMatrix * normalMC;
  float size = length(normal);
  return size > 0.0 ? normal / size : toViewer;
}

float getRadius()
{
  return radiusScale * (uniformRadius > 0.0 ? uniformRadius : radiusMC);
}

vec4 getColor()
{
  return colorSource == 0 ? constantColor : colorSource == 1 ? scalarColor : vec4(colorSource == 2 ? colorTCoord : tcoord, 0.0, 1.0);
}

// Whether the point is to be seen: within the clipping range, not farther beyond a clipping plane than
// its reach, not culled.
bool isVisible(vec4 position, vec4 clip, float reach, bool facesViewer)
{
  bool visible = clip.w > 0.0 && abs(clip.z) <= clip.w && cull != (facesViewer ? 2 : 1);
  for (int i = 0; i < numberOfClippingPlanes; ++i)
  {
    visible = visible && dot(clippingPlanes[i], position) >= -reach * length(clippingPlanes[i].xyz);
  }
  return visible;
}
