// SPDX-License-Identifier: BSD-3-Clause
flat in vec4 shape;
flat in vec2 interval;
flat in vec4 color;
flat in uint id;

void main()
{
  OUT_SHAPE = shape;
  OUT_INTERVAL = vec4(interval, 0.0, 0.0);
#ifdef OUT_ID
  OUT_ID = id;
#endif
#ifdef OUT_COLOR
  OUT_COLOR = color;
#endif
}
