//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// The primitive that shading draws: the rectangle of the viewport that the cloud covers.
uniform vec4 psRectangle; // lower left and upper right corner in normalised device coordinates
void main()
{
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(mix(psRectangle.xy, psRectangle.zw, corner), 0.0, 1.0);
}
