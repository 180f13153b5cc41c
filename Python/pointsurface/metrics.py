# SPDX-License-Identifier: BSD-3-Clause
"""How far a picture of a surface is from the truth: plain numpy, no VTK.

Images are arrays of (height, width) or (height, width, components); row 0 is at the bottom, as in VTK. Colours are in
0 to 1. A mask is an array of (height, width) of bool, true where there is a surface.
"""

from dataclasses import dataclass

import numpy as np


@dataclass
class SurfaceImage:
    """What a picture shows, pixel by pixel.

    color: (height, width, 3), 0 to 1, background included.
    normals: (height, width, 3), eye space, unit length where there is a surface.
    depth: (height, width), distance from the eye along the view direction in world units, 0 where there is no surface.
    """

    color: np.ndarray
    normals: np.ndarray
    depth: np.ndarray

    @property
    def mask(self):
        return self.depth > 0


def psnr(image, truth):
    """Peak signal-to-noise ratio in dB, for a peak of 1; infinite for equal images."""
    error = np.mean((np.asarray(image, float) - truth) ** 2)
    return float("inf") if error == 0 else float(-10 * np.log10(error))


def _gaussian_blur(image, sigma, radius):
    """Blur of a (height, width) image with a window cut off at `radius`; only where the window fits."""
    offsets = np.arange(-radius, radius + 1)
    weights = np.exp(-0.5 * (offsets / sigma) ** 2)
    weights /= weights.sum()
    for axis in (0, 1):
        windows = np.lib.stride_tricks.sliding_window_view(image, 2 * radius + 1, axis)
        image = windows @ weights
    return image


def ssim(image, truth):
    """Mean structural similarity (Wang et al. 2004), for a peak of 1: 1 for equal images.

    An 11 by 11 Gaussian window of sigma 1.5, K1 = 0.01, K2 = 0.03, on the luminance (Rec. 601) of colour images.
    Raises ValueError for images smaller than the window.
    """
    image, truth = (np.asarray(x, float) for x in (image, truth))
    if image.ndim == 3:
        image, truth = (x @ (0.299, 0.587, 0.114) for x in (image, truth))
    if min(image.shape) < 11:
        raise ValueError(f"SSIM needs an image of 11 by 11 pixels or more, not {image.shape[1]} by {image.shape[0]}")

    def blur(x):
        return _gaussian_blur(x, sigma=1.5, radius=5)

    mean_x, mean_y = blur(image), blur(truth)
    variance_x = blur(image * image) - mean_x**2
    variance_y = blur(truth * truth) - mean_y**2
    covariance = blur(image * truth) - mean_x * mean_y
    c1, c2 = 0.01**2, 0.03**2
    similarity = ((2 * mean_x * mean_y + c1) * (2 * covariance + c2)) / (
        (mean_x**2 + mean_y**2 + c1) * (variance_x + variance_y + c2)
    )
    return float(similarity.mean())


def normal_angles(normals, truth, mask):
    """Mean and 95th percentile of the angle between unit normals in `mask`, in degrees; NaN for an empty mask."""
    a, b = (np.asarray(x, float)[mask] for x in (normals, truth))
    if len(a) == 0:
        return float("nan"), float("nan")
    # The arc tangent is exact for small angles as well, where the arc cosine loses half of the digits.
    sine = np.linalg.norm(np.cross(a, b), axis=-1)
    angles = np.degrees(np.arctan2(sine, np.sum(a * b, axis=-1)))
    return float(angles.mean()), float(np.percentile(angles, 95))


def depth_error(depth, truth, mask, diagonal):
    """Mean absolute difference of depth in `mask` as a fraction of `diagonal`; NaN for an empty mask."""
    difference = np.abs(np.asarray(depth, float)[mask] - np.asarray(truth, float)[mask])
    return float(difference.mean() / diagonal) if difference.size else float("nan")


def wrong_depth_share(depth, truth, mask, diagonal):
    """Share of the pixels of `mask` whose depth is off by more than 1% of `diagonal`; 0 for an empty mask."""
    difference = np.abs(np.asarray(depth, float)[mask] - np.asarray(truth, float)[mask])
    return float(np.mean(difference > 0.01 * diagonal)) if difference.size else 0.0


def silhouette_iou(mask, truth):
    """Intersection over union of two silhouettes; 1 if both are empty."""
    union = np.count_nonzero(mask | truth)
    return np.count_nonzero(mask & truth) / union if union else 1.0


def unfilled_share(mask, truth):
    """Share of the pixels of the true silhouette that show no surface; 0 if it is empty."""
    inside = np.count_nonzero(truth)
    return np.count_nonzero(truth & ~mask) / inside if inside else 0.0


def compare(image, truth, diagonal):
    """All measures of a SurfaceImage beside the true one.

    diagonal: that of the surface's bounding box, in world units.
    Returns a dict: psnr (dB), ssim, normal_mean and normal_95 (degrees), depth (fraction of the diagonal),
    wrong_depth, iou and unfilled (0 to 1).
    """
    both = image.mask & truth.mask
    normal_mean, normal_95 = normal_angles(image.normals, truth.normals, both)
    return {
        "psnr": psnr(image.color, truth.color),
        "ssim": ssim(image.color, truth.color),
        "normal_mean": normal_mean,
        "normal_95": normal_95,
        "depth": depth_error(image.depth, truth.depth, both, diagonal),
        "wrong_depth": wrong_depth_share(image.depth, truth.depth, both, diagonal),
        "iou": silhouette_iou(image.mask, truth.mask),
        "unfilled": unfilled_share(image.mask, truth.mask),
    }
