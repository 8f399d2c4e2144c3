// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Least and greatest depth of square tiles; 0 stands for what is no depth.
KERNEL depth_tiles(global float2* ranges, Size tiles, global const float* depth_m, Size size) {
  FOR_PACKETS(tile, tiles.width * tiles.height) {
    const int x0 = tile % tiles.width * TILE, y0 = tile / tiles.width * TILE;
    const int x1 = min(size.width, x0 + TILE), y1 = min(size.height, y0 + TILE);
    float least = INFINITY, greatest = 0.0f;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const float depth = depth_m[y * size.width + x];
        const float valid = depth > 0.0f ? depth : 0.0f;
        least = fmin(least, valid);
        greatest = fmax(greatest, valid);
      }
    }
    ranges[tile] = (float2)(least, greatest);
  }
}
