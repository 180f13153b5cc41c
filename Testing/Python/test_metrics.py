# SPDX-License-Identifier: BSD-3-Clause
import math

import numpy as np
import pytest

from pointsurface import metrics


def test_psnr_of_a_known_difference():
    truth = np.full((4, 5, 3), 0.5)
    assert metrics.psnr(truth + 0.1, truth) == pytest.approx(20.0)
    assert metrics.psnr(truth, truth) == math.inf


def test_ssim_of_constant_images():
    a, b = np.full((20, 30), 0.25), np.full((20, 30), 0.75)
    expected = (2 * 0.25 * 0.75 + 1e-4) / (0.25**2 + 0.75**2 + 1e-4)
    assert metrics.ssim(a, b) == pytest.approx(expected)


def test_ssim_by_its_definition():
    """One window, summed up pixel by pixel as Wang et al. write it."""
    random = np.random.default_rng(1)
    x, y = random.random((2, 11, 11))
    weights = np.array([[math.exp(-((i - 5) ** 2 + (j - 5) ** 2) / (2 * 1.5**2)) for i in range(11)] for j in range(11)])
    weights /= weights.sum()
    mx, my = (weights * x).sum(), (weights * y).sum()
    vx, vy = (weights * (x - mx) ** 2).sum(), (weights * (y - my) ** 2).sum()
    vxy = (weights * (x - mx) * (y - my)).sum()
    expected = (2 * mx * my + 1e-4) * (2 * vxy + 9e-4) / ((mx**2 + my**2 + 1e-4) * (vx + vy + 9e-4))
    assert metrics.ssim(x, y) == pytest.approx(expected, rel=1e-10)
    assert metrics.ssim(x, x) == pytest.approx(1.0)
    gray = np.repeat(x[..., None], 3, axis=2)
    assert metrics.ssim(gray, np.repeat(y[..., None], 3, axis=2)) == pytest.approx(expected, rel=1e-10)


def test_ssim_of_an_image_that_is_too_small():
    with pytest.raises(ValueError, match="11 by 11 pixels or more, not 10 by 30"):
        metrics.ssim(np.zeros((30, 10)), np.zeros((30, 10)))


def test_normal_angles():
    degrees = np.arange(0.0, 101.0).reshape(1, -1)
    radians = np.radians(degrees)
    truth = np.zeros((1, 101, 3))
    truth[..., 2] = 1
    normals = np.stack([np.sin(radians), np.zeros_like(radians), np.cos(radians)], axis=-1)
    mean, largest = metrics.normal_angles(normals, truth, np.ones((1, 101), bool))
    assert mean == pytest.approx(50.0)
    assert largest == pytest.approx(95.0)
    only_ten = degrees == 10
    assert metrics.normal_angles(normals, truth, only_ten) == pytest.approx((10.0, 10.0))
    assert all(map(math.isnan, metrics.normal_angles(normals, truth, degrees < 0)))


def test_small_angles_are_exact():
    normals = np.array([[[1e-9, 0, 1]]])
    mean, _ = metrics.normal_angles(normals, np.array([[[0.0, 0, 1]]]), np.ones((1, 1), bool))
    assert mean == pytest.approx(math.degrees(1e-9))


def test_silhouettes_and_depth():
    truth = np.zeros((4, 4), bool)
    truth[:, :2] = True  # 8 pixels
    mask = np.zeros((4, 4), bool)
    mask[1:, :3] = True  # 9 pixels, 6 of them inside
    assert metrics.silhouette_iou(mask, truth) == pytest.approx(6 / 11)
    assert metrics.unfilled_share(mask, truth) == pytest.approx(2 / 8)
    depth = np.where(truth, 5.0, 0.0)
    assert metrics.depth_error(depth + 0.1, depth, truth, diagonal=2.0) == pytest.approx(0.05)
    assert metrics.silhouette_iou(~truth & truth, ~truth & truth) == 1.0


def test_wrong_depth_is_more_than_a_hundredth_of_the_diagonal():
    truth = np.full((2, 5), 5.0)
    depth = truth + np.array([[0, 0.019, -0.019, 0.021, -0.021], [0, 0, 0, 0, 9]])
    mask = np.ones((2, 5), bool)
    mask[1, 4] = False
    assert metrics.wrong_depth_share(depth, truth, mask, diagonal=2.0) == pytest.approx(2 / 9)
    assert metrics.wrong_depth_share(depth, truth, ~mask & mask, diagonal=2.0) == 0.0


def test_compare_measures_where_both_have_a_surface():
    truth_depth = np.zeros((16, 16))
    truth_depth[:, :8] = 2.0
    depth = np.zeros((16, 16))
    depth[:, 4:8] = 2.5
    facing = np.zeros((16, 16, 3))
    facing[..., 2] = 1
    black = np.zeros((16, 16, 3))
    result = metrics.compare(
        metrics.SurfaceImage(black, facing, depth), metrics.SurfaceImage(black, facing, truth_depth), diagonal=10.0
    )
    assert result["psnr"] == math.inf and result["ssim"] == pytest.approx(1.0)
    assert result["normal_mean"] == 0.0 and result["normal_95"] == 0.0
    assert result["depth"] == pytest.approx(0.05)
    assert result["wrong_depth"] == 1.0
    assert result["iou"] == 0.5 and result["unfilled"] == 0.5
