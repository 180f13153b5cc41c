//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// The primitives that shading draws: rectangles of the viewport with what the cloud covers, two triangles each.
uniform vec4 psRectangles[64]; // lower left and upper right corners in normalised device coordinates
uniform vec4 psRays[3];        // the viewport's centre, and what is added per step to its right and its upper border
out vec4 psRay;                // see vtkSurfaceBufferDec.glsl
//PointSurface::Uniforms::Dec
const ivec2 corners[6] = ivec2[6](ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(0, 1), ivec2(1, 0), ivec2(1, 1));
void main()
{
  vec4 rectangle = psRectangles[gl_VertexID / 6];
  vec2 corner = vec2(corners[gl_VertexID % 6]);
  vec2 place = mix(rectangle.xy, rectangle.zw, corner);
  gl_Position = vec4(place, 0.0, 1.0);
  psRay = psRays[0] + place.x * psRays[1] + place.y * psRays[2];
//PointSurface::Uniforms::Impl
}
