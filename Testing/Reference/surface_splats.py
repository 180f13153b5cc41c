# SPDX-License-Identifier: BSD-3-Clause
"""What vtkSurfaceSplatMapper computes, in double precision: slow and plain; nothing is shared with the mapper.

Discs are projected as in M. Zwicker, H. Pfister, J. van Baar, M. Gross, Surface Splatting, SIGGRAPH 2001; the visible
depth of each pixel is found, and what lies near it is blended. The constants are those of the mapper's documentation.

Arrays are of (height, width) or (height, width, components); row 0 is at the bottom.
"""

from dataclasses import dataclass

import numpy as np

LOW_PASS_VARIANCE = 0.05  # square pixels
CORE = 0.75  # e below which a disc covers a pixel
MARGIN_COSINE = 0.9
TOLERANCE_PIXELS = 2
FRAGMENTS_AT_ONCE = 1 << 20

NEAR = 1e-5  # of a threshold
NEAR_EDGE = 3e-4  # pixels from a splat's edge: single precision resolves no less across a viewport


@dataclass
class Surface:
    """A surface buffer; depth 0: no surface. near_decision: pixels where rounding may have decided."""

    normals: np.ndarray
    depth: np.ndarray
    colors: np.ndarray
    ids: np.ndarray
    near_decision: np.ndarray


@dataclass
class Options:
    blend_radius: float = 1.25
    depth_tolerance: float = 2
    cull_backfaces: bool = False


def draw_surface_splats(points, normals, radii, view, projection, size, colors=None, options=None):
    """The Surface that discs make.

    points, normals: (n, 3), world coordinates, unit normals. radii: (n,), world units. colors: (n, k) or None.
    view, projection: (4, 4), from world to eye and from there to clip coordinates, for column vectors; the eye looks
    along -z, and all points are within the clipping range.
    size: (width, height) in pixels.
    """
    splats = _Splats(points, normals, radii, view, projection, size, options or Options())
    width, height = size
    count = width * height
    visible, is_back, near = _find_visible(splats, count)

    channels = 4 if colors is None else 4 + colors.shape[1]
    sums, weights = np.zeros((channels, count)), np.zeros(count)
    heaviest, second, ids = np.zeros(count), np.zeros(count), np.full(count, -1)
    for splat, pixel, e, depth in splats.fragments():
        key = depth + splats.back[splat] * splats.tolerance[splat]
        excess = key - visible[pixel] - splats.tolerance[splat]
        same_side = splats.back[splat] == is_back[pixel]
        close = np.abs(excess) < NEAR * splats.tolerance[splat] + 1e-6 * depth
        near[pixel[same_side & close & np.isfinite(excess)]] = True
        blended = same_side & (excess <= 0)
        splat, pixel, e, depth = splat[blended], pixel[blended], e[blended], depth[blended]
        weight = (1 - e / splats.options.blend_radius**2) ** 4
        weights += np.bincount(pixel, weight, minlength=count)
        values = [*splats.normals[splat].T, depth]
        if colors is not None:
            values += [*colors[splats.ids[splat]].T]
        for layer, value in zip(sums, values):
            layer += np.bincount(pixel, weight * value, minlength=count)
        for i, p, w in zip(splats.ids[splat], pixel, weight):
            if w > heaviest[p]:
                heaviest[p], second[p], ids[p] = w, heaviest[p], i
            else:
                second[p] = max(second[p], w)

    covered = weights > 0
    near |= covered & (heaviest - second < 1e-3 * heaviest)
    sums = np.where(covered, sums / np.where(covered, weights, 1), 0)
    length = np.linalg.norm(sums[:3], axis=0)
    unit = np.where(length > 0, sums[:3] / np.where(length > 0, length, 1), 0)
    return Surface(
        unit.T.reshape(height, width, 3),
        sums[3].reshape(height, width),
        None if colors is None else sums[4:].T.reshape(height, width, -1),
        ids.reshape(height, width),
        near.reshape(height, width),
    )


def _find_visible(splats, count):
    """The visible depth of each pixel, inf where there is none; whether it is a back's; near decisions."""
    front, back, margin, facing_margin = (np.full(count, np.inf) for _ in range(4))
    near = np.zeros(count, bool)
    for splat, pixel, e, depth in splats.fragments():
        is_back, facing = splats.back[splat], splats.facing[splat]
        core = e < CORE
        for layer, chosen in (
            (front, core & ~is_back),
            (margin, ~is_back),
            (facing_margin, facing > MARGIN_COSINE),
        ):
            np.minimum.at(layer, pixel[chosen], depth[chosen])
        chosen = core & is_back
        np.minimum.at(back, pixel[chosen], (depth + splats.tolerance[splat])[chosen])
        # an edge, a splat seen edge-on, or one about to have a margin
        edge = np.abs(e - CORE) < NEAR_EDGE / splats.width[splat]
        side = (np.abs(facing) < NEAR) | (np.abs(facing - MARGIN_COSINE) < NEAR)
        near[pixel[edge | side]] = True

    def is_close(a, b):
        with np.errstate(invalid="ignore"):
            return np.abs(a - b) < 1e-6 * np.minimum(a, b)

    near |= is_close(front, back) | is_close(margin, back)
    gap, nothing = back < front, ~np.isfinite(np.minimum(front, back))
    front = np.where(gap & (margin < back), margin, np.where(nothing, facing_margin, front))
    is_back = back < front
    return np.where(np.isfinite(np.minimum(front, back)), np.minimum(front, back), -np.inf), is_back, near


class _Splats:
    """Ellipses on the screen, e = d^T V^-1 d, and the pixels that they are blended in."""

    def __init__(self, points, normals, radii, view, projection, size, options):
        self.options, self.size = options, np.array(size)
        eye = np.asarray(points, float) @ view[:3, :3].T + view[:3, 3]
        normals = np.asarray(normals, float) @ view[:3, :3].T
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        parallel = projection[3, 2] == 0
        facing = normals[:, 2] if parallel else -np.sum(eye * normals, axis=1) / np.linalg.norm(eye, axis=1)
        kept = facing >= 0 if options.cull_backfaces else np.ones(len(eye), bool)
        self.ids = np.flatnonzero(kept)
        eye, self.normals, self.facing = eye[kept], normals[kept], facing[kept]
        self.back = self.facing < 0
        self.depth = -eye[:, 2]
        radius = np.asarray(radii, float)[kept]
        if not parallel:
            tilt = np.linalg.norm(self.normals[:, :2], axis=1)
            radius = np.minimum(radius, self.depth / 2 / np.maximum(tilt, 1e-300))

        clip = np.c_[eye, np.ones(len(eye))] @ projection.T
        w = clip[:, 3]
        ndc = clip[:, :2] / w[:, None]
        self.center = (ndc + 1) / 2 * self.size
        pixel = 2 * w / (self.size[1] * abs(projection[1, 1]))
        self.tolerance = options.depth_tolerance * radius + TOLERANCE_PIXELS * pixel

        # the projection of the disc's second moment, of the screen and the depth
        jacobian = np.zeros((len(eye), 3, 3))
        jacobian[:, :2] = (projection[:2, :3] - ndc[:, :, None] * projection[3, :3]) * (
            self.size[:, None] / 2 / w[:, None, None]
        )
        jacobian[:, 2, 2] = -1
        on_plane = np.eye(3) - self.normals[:, :, None] * self.normals[:, None, :]
        moment = radius[:, None, None] ** 2 * (jacobian @ on_plane @ jacobian.transpose(0, 2, 1))
        variance = moment[:, :2, :2] + LOW_PASS_VARIANCE * np.eye(2)
        self.inverse_variance = np.linalg.inv(variance)
        self.slope = np.einsum("nij,nj->ni", self.inverse_variance, moment[:, :2, 2])
        self.width = np.sqrt(np.linalg.eigvalsh(variance)[:, 0])

        # the pixels whose centres lie in the ellipse's box
        reach = options.blend_radius * np.sqrt(np.diagonal(variance, axis1=1, axis2=2))
        self.begin = np.clip(np.ceil(self.center - reach - 0.5), 0, self.size).astype(int)
        self.end = np.clip(np.floor(self.center + reach - 0.5) + 1, self.begin, self.size).astype(int)

    def fragments(self):
        """Runs over all, many at once: splat, pixel, e and depth of each."""
        extent = self.end - self.begin
        up_to = np.concatenate([[0], np.cumsum(extent[:, 0] * extent[:, 1])])
        first = 0
        while first < len(extent):
            last = max(np.searchsorted(up_to, up_to[first] + FRAGMENTS_AT_ONCE, "right") - 1, first + 1)
            splat = np.repeat(np.arange(first, last), np.diff(up_to[first : last + 1]))
            row, column = np.divmod(np.arange(up_to[first], up_to[last]) - up_to[splat], extent[splat, 0])
            place = self.begin[splat] + np.stack([column, row], axis=1)
            offset = place + 0.5 - self.center[splat]
            e = np.einsum("ni,nij,nj->n", offset, self.inverse_variance[splat], offset)
            inside = e < self.options.blend_radius**2
            depth = self.depth[splat] + np.sum(self.slope[splat] * offset, axis=1)
            yield splat[inside], (place[:, 1] * self.size[0] + place[:, 0])[inside], e[inside], depth[inside]
            first = last
