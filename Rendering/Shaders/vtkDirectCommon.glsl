// SPDX-License-Identifier: BSD-3-Clause
// What the steps of a direct reconstruction have in common: the meaning of a cell's layers.
//   shape:    xyz nearest point in eye coordinates; w 1, or 0 where the cell is empty
//   interval: xyz farthest point within the tolerance of it; w 1 where points are not yet in a splat
// and of a splat's:
//   shape:    xyz normal, w radius in cells of level 0 (0: no splat)
//   interval: xyz mean of the two points; w 1 where a coarser level has to make the splat, -1 where the
//             nearest point is a copy of another process' one, which makes this splat too
uniform vec4 eyeRay;     // xy: the ray's direction through the place (0, 0); zw: its origin
uniform vec4 eyeRayStep; // change of these a cell of level 0
uniform float shear;     // eye x is less by that times y
uniform vec4 cellToEye;  // xy: eye units a cell where w is 1; zw: w = z depth + w
uniform float gamma;     // in eye units

// Eye units along a cell of level 0.
float getEyeCell(float depth)
{
  return max(cellToEye.x, cellToEye.y) * (cellToEye.z * depth + cellToEye.w);
}
