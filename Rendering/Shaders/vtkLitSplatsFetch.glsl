// SPDX-License-Identifier: BSD-3-Clause
  // the splat's mean, normal and colour in the place of the pixel's; see vtkLitSplatsImpl.glsl
  if (psLightsSplat)
  {
    psVertexVC = psEyeToView * vec4(texelFetch(inInterval, psSplat, 0).xyz, 1.0);
    psNormalVC = psNormalToView * texelFetch(inShape, psSplat, 0).xyz;
    psFrontFacing = true;
#ifdef HAS_COLOR
    psColorOrTCoord = texelFetch(inColor, psSplat, 0);
#endif
  }
