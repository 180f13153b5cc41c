// SPDX-License-Identifier: BSD-3-Clause
  ivec2 psPixel = ivec2(gl_FragCoord.xy) - psOrigin;
  vec4 psGeometry = texelFetch(psSurface, psPixel, 0);
  psPoint = psGeometry.w > 0.0 ? 0 : -1;
#ifdef HAS_ID
  psPoint = int(texelFetch(psId, psPixel, 0).r) - 1;
#endif
  psCoverage = psHasCoverage ? length(psGeometry.xyz) : 1.0;
  vec4 psColorOrTCoord = vec4(1.0);
#ifdef HAS_COLOR
  psColorOrTCoord = texelFetch(psColor, psPixel, 0);
#endif
  // the position in view coordinates, from the pixel and its eye depth
  vec2 psNDC = 2.0 * (gl_FragCoord.xy - vec2(psOrigin)) / vec2(textureSize(psSurface, 0)) - 1.0;
  float psZ = -psGeometry.w;
  float psW = psVCDC[2][3] * psZ + psVCDC[3][3];
  psVertexVC = vec4((psNDC * psW - psVCDC[2].xy * psZ - psVCDC[3].xy) / vec2(psVCDC[0][0], psVCDC[1][1]), psZ, 1.0);
  psFragCoordZ = psPoint < 0 ? 1.0 : 0.5 * (psVCDC[2][2] * psZ + psVCDC[3][2]) / psW + 0.5;
  psFragCoordW = 1.0 / psW;
  // Just past an outline normals point a little away: those of the front, bent to the side. What
  // points far away is the back.
  vec3 psToViewer = psVCDC[2][3] == 0.0 ? vec3(0.0, 0.0, 1.0) : -normalize(psVertexVC.xyz);
  float psFacing = dot(normalize(psGeometry.xyz), psToViewer);
  psFrontFacing = psFacing > -0.3;
  if (psFrontFacing && psFacing < 0.0)
  {
    psGeometry.xyz -= psFacing * length(psGeometry.xyz) * psToViewer;
  }
