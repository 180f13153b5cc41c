//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// A tile of pixels, as a point of its size: dropped where the coarser level has no surface that the
// pixels of the tile could take. What covers a pixel covers its parent in the coarser level, or that
// one's neighbour which is the nearest to the pixel: so there is none beside a dropped tile either.
uniform sampler2D coverShape; // the coarser level: radii over 0 in w where there is a surface
uniform ivec2 coverBegin;     // its pixels outside of [begin, end) are empty
uniform ivec2 coverEnd;
uniform int tileSize;         // in pixels
uniform ivec2 firstTile;      // in tiles
uniform int tileColumns;
uniform vec2 targetSize;      // in pixels

void main()
{
  ivec2 place = tileSize * (firstTile + ivec2(gl_VertexID % tileColumns, gl_VertexID / tileColumns));
  ivec2 begin = max(place / 2 - 1, coverBegin);
  ivec2 size = min(place / 2 + tileSize / 2 + 1, coverEnd) - begin;
  int count = max(size.x, 0) * max(size.y, 0);
  bool covered = false;
  for (int i = 0; i < count && !covered; ++i)
  {
    covered = texelFetch(coverShape, begin + ivec2(i % size.x, i / size.x), 0).w > 0.0;
  }
  // a point whose centre is outside of the image would be clipped
  float halfSize = 0.5 * float(tileSize);
  vec2 center = max(min(vec2(place) + halfSize, targetSize - halfSize), 0.5 * min(targetSize, vec2(tileSize)));
  gl_PointSize = float(tileSize);
  gl_Position = covered ? vec4(2.0 * center / targetSize - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
