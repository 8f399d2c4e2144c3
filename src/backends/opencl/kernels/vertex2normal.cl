// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The vertices of a row from x on, which may be one pixel off either end: clamped.
INLINE Vec3 neighbours(global const float* row, int x, int width) {
  if (x >= 0 && x + LANES <= width) return load3(row + 3 * x, LANES);
  Vec3 v;
#define AT(lane, i) row[3 * clamp(x + i, 0, width - 1)]
  v.x = (Floats)(EACH(AT));
  ++row;
  v.y = (Floats)(EACH(AT));
  ++row;
  v.z = (Floats)(EACH(AT));
#undef AT
  return v;
}

KERNEL vertex2normal(global float* normals, global const float* vertices, Size size) {
  const Floats zero = (Floats)(0.0f);
  const Vec3 none = vec3((Floats)(INVALID_NORMAL), zero, zero);
  FOR_PACKETS(i, row_packets(size)) {
    const RowPacket p = row_packet(i, size);
    global const float* row = vertices + 3 * p.y * size.width;
    const Vec3 left = neighbours(row, p.x - 1, size.width);
    const Vec3 right = neighbours(row, p.x + 1, size.width);
    const Vec3 up = neighbours(vertices + 3 * max(p.y - 1, 0) * size.width, p.x, size.width);
    const Vec3 down =
        neighbours(vertices + 3 * min(p.y + 1, size.height - 1) * size.width, p.x, size.width);
    const Vec3 normal = cross3(sub(down, up), sub(right, left));
    const Floats norm = length3(normal);
    const Ints valid = (left.z != 0.0f) & (right.z != 0.0f) & (up.z != 0.0f) & (down.z != 0.0f) &
                       (norm > 0.0f);
    store3(select3(valid, mul(normal, 1.0f / norm), none), normals + 3 * (p.y * size.width + p.x),
           p.count);
  }
}
