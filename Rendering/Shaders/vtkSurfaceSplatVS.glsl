// SPDX-License-Identifier: BSD-3-Clause
// A point of the cloud at the eye; radius 0: it is not drawn. After vtkPointAttributes.glsl.
uniform float blendRadius;
uniform int thinning; // of 2^thinning points that follow each other, one is drawn

out vec4 disc; // xyz: centre; w: radius
out vec3 discNormal;
out vec4 discColor;
flat out uint discId;

// The point that stands for its group; see vtkPointThinning.h.
uint getPointOfGroup(uint group)
{
  for (int below = thinning; below > 0; --below)
  {
    uint mixed = (group ^ (group >> 15)) * 2654435761u + uint(below) * 2246822519u;
    group = 2u * group + (((mixed ^ (mixed >> 16)) >> 7) & 1u);
  }
  return group;
}

void main()
{
  vec4 position = MCVCMatrix * vertexMC;
  vec3 toViewer = getToViewer(position);
  discNormal = getNormal(toViewer);
  bool facesViewer = dot(discNormal, toViewer) >= 0.0;
  bool isKept = getPointOfGroup(uint(gl_VertexID) >> thinning) == uint(gl_VertexID);
  float radius = getRadius();
  bool isDrawn = isKept && isVisible(position, VCDCMatrix * position, blendRadius * radius, facesViewer);
  disc = vec4(position.xyz, isDrawn ? radius : 0.0);
  discColor = getColor();
  discId = pointId + uint(firstId) + 1u;
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
