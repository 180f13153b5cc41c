//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// The primitives that shading draws: rectangles of the viewport with what the cloud covers, two triangles each.
uniform vec4 psRectangles[64]; // lower left and upper right corners in normalised device coordinates
const ivec2 corners[6] = ivec2[6](ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(0, 1), ivec2(1, 0), ivec2(1, 1));
void main()
{
  vec4 rectangle = psRectangles[gl_VertexID / 6];
  vec2 corner = vec2(corners[gl_VertexID % 6]);
  gl_Position = vec4(mix(rectangle.xy, rectangle.zw, corner), 0.0, 1.0);
}
