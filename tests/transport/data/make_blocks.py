"""Writes cornell-plain-blocks.csv from a reference render of scenes/cornell-plain.json.

Usage: make_blocks.py REFERENCE.npz OUTPUT.csv
The archive holds `mean` (300 x 300 x 3 linear radiance, top row first) and `sem` (standard error of
the mean per pixel and channel).
"""

import sys

import numpy as np

HEADER = """\
# Block means of scenes/cornell-plain.json by another renderer: Mitsuba 3.9.1, llvm variant,
# integrator path (max 50 segments), box filter, 300x300 pixels, 5120 samples per pixel, exact Fresnel,
# one-sided lights with black backs. 10 x 10 blocks of 30 x 30 pixels, top row first, linear radiance.
# Errors are standard errors of the block means.
block_x,block_y,red,green,blue,red_error,green_error,blue_error
"""
SIZE, BLOCK = 300, 30

archive = np.load(sys.argv[1])
mean, sem = archive["mean"].astype(float), archive["sem"].astype(float)
assert mean.shape == sem.shape == (SIZE, SIZE, 3)
with open(sys.argv[2], "w", encoding="utf-8", newline="\n") as out:
    out.write(HEADER)
    for by in range(SIZE // BLOCK):
        for bx in range(SIZE // BLOCK):
            window = np.s_[by * BLOCK:(by + 1) * BLOCK, bx * BLOCK:(bx + 1) * BLOCK]
            value = mean[window].mean(axis=(0, 1))
            error = np.sqrt((sem[window] ** 2).sum(axis=(0, 1))) / BLOCK**2
            out.write(f"{bx},{by}," + ",".join(f"{x:.8g}" for x in (*value, *error)) + "\n")
