// SPDX-License-Identifier: BSD-3-Clause
// A point of the cloud at the eye; radius 0: it is not drawn. After vtkPointAttributes.glsl.
uniform float blendRadius;

out vec4 disc; // xyz: centre; w: radius
out vec3 discNormal;
out vec4 discColor;
flat out uint discId;

void main()
{
  vec4 position = MCVCMatrix * vertexMC;
  vec3 toViewer = getToViewer(position);
  discNormal = getNormal(toViewer);
  bool facesViewer = dot(discNormal, toViewer) >= 0.0;
  float radius = getRadius();
  bool isDrawn = isVisible(position, VCDCMatrix * position, blendRadius * radius, facesViewer);
  disc = vec4(position.xyz, isDrawn ? radius : 0.0);
  discColor = getColor();
  discId = pointId + uint(firstId) + 1u;
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
