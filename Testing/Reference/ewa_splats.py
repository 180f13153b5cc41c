# SPDX-License-Identifier: BSD-3-Clause
"""Two-pass splatting of discs in the manner of EWA surface splatting: the yardstick for quality, slow and plain.

After M. Zwicker, H. Pfister, J. van Baar, M. Gross, Surface Splatting, SIGGRAPH 2001: each disc is a Gaussian on the
screen, widened by a low-pass filter of the pixel grid. A first pass finds the least depth of each pixel, a second one
averages what lies near it. Numpy in double precision; nothing is shared with the mappers.
"""

import numpy as np

LOW_PASS_VARIANCE = 0.1  # square pixels; 0.5 costs 2 dB
FRAGMENTS_AT_ONCE = 1 << 20


def draw_ewa_splats(points, normals, radii, view, focal_length, size):
    """Normals and depth of the surface that discs make, as a pinhole camera sees them.

    points, normals: (n, 3), world coordinates, unit normals. Discs that face away are left out.
    radii: (n,), of the discs, in world units.
    view: (4, 4), from world to eye coordinates, for column vectors; the eye looks along -z.
    focal_length: in pixels; the picture's centre is on the axis.
    size: (width, height) in pixels.
    Returns eye-space unit normals (height, width, 3) and depth (height, width), the distance from the eye along -z;
    both 0 where there is no surface. Row 0 is at the bottom.
    """
    width, height = size
    splats = _Splats(points, normals, radii, view, focal_length, size)
    nearest = np.full(width * height, np.inf)
    for _, pixel, _, depth in splats.fragments():
        np.minimum.at(nearest, pixel, depth)

    sums = np.zeros((5, width * height))  # of the normal, the depth and 1, weighted
    for splat, pixel, e, depth in splats.fragments():
        near = depth <= nearest[pixel] + splats.radii[splat]
        splat, pixel, e, depth = splat[near], pixel[near], e[near], depth[near]
        weight = np.exp(-3 * e)
        for layer, value in zip(sums, (*splats.normals[splat].T, depth, 1)):
            layer += np.bincount(pixel, weight * value, minlength=len(layer))

    covered = sums[4] > 0
    depth = np.where(covered, sums[3] / np.where(covered, sums[4], 1), 0)
    normal = sums[:3].T / np.maximum(np.linalg.norm(sums[:3].T, axis=1, keepdims=True), 1e-300)
    return normal.reshape(height, width, 3), depth.reshape(height, width)


class _Splats:
    """Ellipses on the screen, e <= 1 with e = d^T V^-1 d, and the pixels that they cover."""

    def __init__(self, points, normals, radii, view, focal_length, size):
        eye_points = np.asarray(points, float) @ view[:3, :3].T + view[:3, 3]
        eye_normals = np.asarray(normals, float) @ view[:3, :3].T
        seen = (np.sum(eye_points * eye_normals, axis=1) < 0) & (eye_points[:, 2] < 0)
        self.points, self.normals = eye_points[seen], eye_normals[seen]
        self.radii = np.asarray(radii, float)[seen]
        self.focal_length, self.size = focal_length, size
        x, y, z = self.points.T
        self.center = np.stack([x, y], axis=1) * (focal_length / -z)[:, None] + np.array(size) / 2

        jacobian = np.zeros((len(z), 2, 3))  # of the screen by the eye coordinates
        jacobian[:, 0, 0] = jacobian[:, 1, 1] = -focal_length / z
        jacobian[:, 0, 2], jacobian[:, 1, 2] = focal_length * x / z**2, focal_length * y / z**2
        on_normal = np.einsum("nij,nj->ni", jacobian, self.normals)
        disc = jacobian @ jacobian.transpose(0, 2, 1) - on_normal[:, :, None] * on_normal[:, None, :]
        variance = self.radii[:, None, None] ** 2 * disc + LOW_PASS_VARIANCE * np.eye(2)
        self.inverse_variance = np.linalg.inv(variance)

        # The pixels whose centres lie in the ellipse's box.
        reach = np.sqrt(np.diagonal(variance, axis1=1, axis2=2))
        self.begin = np.clip(np.ceil(self.center - reach - 0.5), 0, size).astype(int)
        self.end = np.clip(np.floor(self.center + reach - 0.5) + 1, self.begin, size).astype(int)

    def fragments(self):
        """Runs over all, many at once: splat, pixel, e and depth of each."""
        extent = self.end - self.begin
        up_to = np.concatenate([[0], np.cumsum(extent[:, 0] * extent[:, 1])])
        first = 0
        while first < len(extent):
            last = max(np.searchsorted(up_to, up_to[first] + FRAGMENTS_AT_ONCE, "right") - 1, first + 1)
            count = np.diff(up_to[first : last + 1])
            splat = np.repeat(np.arange(first, last), count)
            yield self._fragments_of(splat, np.arange(up_to[first], up_to[last]) - up_to[splat])
            first = last

    def _fragments_of(self, splat, index):
        row, column = np.divmod(index, (self.end - self.begin)[splat, 0])
        x, y = self.begin[splat, 0] + column, self.begin[splat, 1] + row
        offset = np.stack([x, y], axis=1) + 0.5 - self.center[splat]
        e = np.einsum("ni,nij,nj->n", offset, self.inverse_variance[splat], offset)
        inside = e <= 1
        splat, x, y, e = splat[inside], x[inside], y[inside], e[inside]
        return splat, y * self.size[0] + x, e, self._depth(splat, x, y)

    def _depth(self, splat, x, y):
        """Where the ray through a pixel's centre meets the disc's plane; at most a radius from the centre's depth."""
        slope = (np.stack([x, y], axis=1) + 0.5 - np.array(self.size) / 2) / self.focal_length
        normal = self.normals[splat]
        along = np.sum(normal[:, :2] * slope, axis=1) - normal[:, 2]
        grazing = along > -1e-12
        plane = np.sum(normal * self.points[splat], axis=1) / np.where(grazing, -1, along)
        center, radius = -self.points[splat, 2], self.radii[splat]
        return np.clip(np.where(grazing, center, plane), center - radius, center + radius)
