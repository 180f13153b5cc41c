// SPDX-License-Identifier: BSD-3-Clause
flat in vec4 shape;
flat in vec4 interval;
flat in vec4 color;
flat in uint id;

void main()
{
  OUT_SHAPE = shape;
  OUT_INTERVAL = interval;
  WRITE_ID(id);
  WRITE_COLOR(color);
}
