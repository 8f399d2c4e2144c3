// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The shading of what raycast found.
KERNEL render_volume(global uchar4* image, global const float* vertices,
                     global const float* normals, int count, ShadeParameters shading) {
  FOR_PACKETS(packet, packets_of(count)) {
    const int first = packet * LANES, left = count - first;
    const Vec3 vertex = load3(vertices + 3 * first, left);
    const Vec3 normal = load3(normals + 3 * first, left);
    const Vec3 to_light = sub(splat(shading.light_m), vertex);
    const Vec3 direction = mul(to_light, 1.0f / length3(to_light));
    const Floats lambert = fmax(dot3(normal, direction), (Floats)(0.0f));
    const Floats bright = 
        fmax((Floats)(0.0f), fmin((Floats)(1.0f), lambert + shading.ambient)) * 255.0f;
    const Ints lit = normal.x != INVALID_NORMAL;
    const Ints grey = TO_INTS(lit ? bright : (Floats)(0.0f));
#define TO(lane, i) \
  if (i < left) image[first + i] = (uchar4)((uchar)(grey lane), (uchar)(grey lane), (uchar)(grey lane), 255);
    EVERY(TO)
#undef TO
  }
}
