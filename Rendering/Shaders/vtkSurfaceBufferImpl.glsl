// SPDX-License-Identifier: BSD-3-Clause
  vec2 psPlace = gl_FragCoord.xy - vec2(psOrigin - psOffset);
  vec4 psGeometry = psFetch(psSurface, psPlace);
  psPoint = psGeometry.w > 0.0 ? 0 : -1;
#ifdef HAS_ID
  psPoint = int(texelFetch(psId, ivec2(psPlace), 0).r) - 1;
  psPoint = psPoint >= psPoints.x && psPoint < psPoints.y ? psPoint - psPoints.x : -1;
#endif
  psCoverage = psHasCoverage != 0 ? length(psGeometry.xyz) : 1.0;
  vec4 psColorOrTCoord = vec4(1.0);
#ifdef HAS_COLOR
  psColorOrTCoord = psFetch(psColor, psPlace);
#endif
  // the position in eye coordinates, from the pixel and its eye depth
  vec4 psEye = vec4(0.0, 0.0, -psGeometry.w, 1.0);
  float psW = psVCDC[2][3] * psEye.z + psVCDC[3][3];
  vec2 psStep = 2.0 * vec2(psOffset) * psTexel * psW;
  psStep.y /= psVCDC[1].y;
  psStep.x = (psStep.x - psVCDC[1].x * psStep.y) / psVCDC[0].x;
  psEye.xy = psRay.xy + psEye.z * psRay.zw + psStep;
  psVertexVC = psEyeToView * psEye;
  psFragCoordZ = psPoint < 0 ? 1.0 : 0.5 * (psVCDC * psEye).z / psW + 0.5;
  psFragCoordW = 1.0 / psW;
#ifdef HAS_DUPLICATES
  if (psPoint >= 0 && texelFetch(psDuplicates, psPoint >> 2)[psPoint & 3] > 0.0)
  {
    // Another process draws this pixel, with all that is around it, and has to come out in front.
    // Only where each takes the pixel for the other's this one is seen.
    vec4 psBehind = psVCDC * (psEye - vec4(0.0, 0.0, psRecess, 0.0));
    // before the far plane still
    psFragCoordZ = min(0.5 * psBehind.z / psBehind.w + 0.5, max(psFragCoordZ, 0.999999));
    if (psLeavesDuplicates)
    {
      psPoint = -1; // a translucent surface would be blended twice
    }
  }
#endif
  vec3 psToViewer = psVCDC[2][3] == 0.0 ? vec3(0.0, 0.0, 1.0) : -normalize(psEye.xyz);
  float psFacing = dot(normalize(psGeometry.xyz), psToViewer);
  psFrontFacing = psFacing >= 0.0;
  if (psFacing < 0.0 && psFacing > -0.3 && psLeansOutward(psPlace, psGeometry))
  {
    // just past an outline: the front, bent to the side
    psFrontFacing = true;
    psGeometry.xyz -= psFacing * length(psGeometry.xyz) * psToViewer;
  }
  vec3 psNormalVC = psNormalToView * psGeometry.xyz;
//PointSurface::Lit::Impl
