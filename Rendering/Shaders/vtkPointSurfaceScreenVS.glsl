//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Four vertices, no attributes, that fill the viewport at the least depth.
void main()
{
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(2.0 * corner - 1.0, -1.0, 1.0);
}
