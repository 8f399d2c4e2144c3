// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

KERNEL generate_gaussian(global float* weights, int radius, float sigma_px) {
  FOR_PACKETS(i, 2 * radius + 1) {
    const int distance = i - radius;
    weights[i] = exp(-(float)(distance * distance) / (2.0f * sigma_px * sigma_px));
  }
}
