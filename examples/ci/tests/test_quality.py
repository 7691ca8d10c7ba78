"""What has to hold of our pictures, as tests: beside the code they belong to, and for frames of our own engine."""

import numpy as np

COURTYARD = "scenes/courtyard.toml"


def test_the_courtyard(lightmeter):
    lightmeter.hold(COURTYARD, "flip <= 0.3", "shadow_map.rmse <= 0.02 without background", size="64x64", spp=256)


def test_filtered_shadows_are_worth_their_time(lightmeter):
    filtered = {"shadow_map": {"filter": "pcf3", "resolution": 512}}
    lightmeter.hold(COURTYARD, "shadow_map.time_ratio to frame <= 0.9", size="64x64", knobs=filtered)


def test_packing_to_half_floats_cannot_be_seen(lightmeter):
    """Stands for a frame of our own engine: an array, or a path such as "frame.exr"."""
    row, column = np.mgrid[0:64, 0:64] / 63
    frame = np.stack([row, column, row * column], axis=2)
    lightmeter.hold_images(frame.astype(np.float16).astype(np.float32), frame, "flip <= 0.01", "psnr >= 60")
