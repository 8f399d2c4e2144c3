// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

INLINE uchar4 depth_color(float depth_m, float near_m, float far_m) {
  if (!(depth_m >= near_m)) return (uchar4)(255);
  if (depth_m > far_m) return (uchar4)(0, 0, 0, 255);
  const float hue = (depth_m - near_m) / (far_m - near_m) * 4.0f;
  const int sextant = hue >= 4.0f ? 3 : (int)hue;
  const float rising = hue - (float)sextant;
  const float low = 64.0f, high = 191.0f;
  const uchar up = (uchar)(low + (high - low) * rising + 0.5f);
  const uchar down = (uchar)(high - (high - low) * rising + 0.5f);
  switch (sextant) {
    case 0:
      return (uchar4)(191, up, 64, 255);
    case 1:
      return (uchar4)(down, 191, 64, 255);
    case 2:
      return (uchar4)(64, 191, up, 255);
    default:
      return (uchar4)(64, down, 191, 255);
  }
}

KERNEL render_depth(global uchar4* image, global const float* depth_m, int count, float near_m,
                    float far_m) {
  FOR_PACKETS(packet, packets_of(count)) {
    for (int i = packet * LANES; i < min(count, packet * LANES + LANES); ++i) {
      image[i] = depth_color(depth_m[i], near_m, far_m);
    }
  }
}
