// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

INLINE uchar4 track_color(int outcome) {
  switch (outcome) {
    case OK:
      return (uchar4)(128, 128, 128, 255);
    case INVALID_INPUT:
      return (uchar4)(0, 0, 0, 255);
    case OUTSIDE_MODEL:
      return (uchar4)(255, 0, 0, 255);
    case INVALID_MODEL:
      return (uchar4)(0, 255, 0, 255);
    case TOO_FAR:
      return (uchar4)(0, 0, 255, 255);
    case WRONG_NORMAL:
      return (uchar4)(255, 255, 0, 255);
    default:
      return (uchar4)(255, 128, 128, 255);
  }
}

KERNEL render_track(global uchar4* image, global const int* rows, int count) {
  FOR_PACKETS(packet, packets_of(count)) {
    for (int i = packet * LANES; i < min(count, packet * LANES + LANES); ++i) {
      image[i] = track_color(rows[i * TRACK_WORDS]);
    }
  }
}
