// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// slambench::raycast_pixel: LANES rays march in lockstep.

INLINE void clip_axis(float origin, Floats direction, float size, Floats* near_t, Floats* far_t) {
  const Floats a = (0.0f - origin) / direction, b = (size - origin) / direction;
  const Ints along = direction == 0.0f;
  const Floats nearer = fmax(*near_t, fmin(a, b)), farther = fmin(*far_t, fmax(a, b));
  const Floats end = origin < 0.0f || origin > size ? *near_t : *far_t;
  *far_t = along ? end : farther;
  *near_t = along ? *near_t : nearer;
}

// The lanes of `active` that meet a surface; their `hit` is set. No sample nearer than start_m is
// other than +1: the march adds up the same depths without them.
INLINE Ints find_surface(const Map* map, Float3 origin, Vec3 direction, RaycastParameters p,
                         float start_m, Ints active, Vec3* hit) {
  Floats t = (Floats)(p.near_m), far_t = (Floats)(p.far_m);
  clip_axis(origin.x, direction.x, map->size_m.x, &t, &far_t);
  clip_axis(origin.y, direction.y, map->size_m.y, &t, &far_t);
  clip_axis(origin.z, direction.z, map->size_m.z, &t, &far_t);
  active = active & (t < far_t);

  const Vec3 start = splat(origin);
  Floats step = (Floats)(p.large_step_m), previous = (Floats)(1.0f), previous_t = t;
  Floats hit_t = (Floats)(0.0f);
  Ints hits = (Ints)(0);
  int first = 1, skipped = 0;
#if BRICKS
  while (any_lane(active) && all_lanes(!active | (t + step < start_m))) {
    first = 0;
    skipped = 1;
    previous_t = t;
    t = t + step;
    active = active & (t < far_t);
  }
#endif
  while (any_lane(active)) {
    const Cell cell = cell_of(map, add(start, mul(direction, t)));
#if BRICKS
    // In the band there is nothing to skip.
    if (!any_lane(active & (previous < 0.99f)) && !any_lane(active & (occupied(map, cell) != 0))) {
      // Every sample here is +1: the march goes on as if each had been taken.
      first = 0;
      skipped = 1;
      previous_t = t;
      t = t + step;
      active = active & (t < far_t);
      continue;
    }
#endif
    const Floats value = interpolate(map, cell);
    if (first) {
      active = active & (value > 0.0f);  // else the ray starts behind a surface
      previous = value;
      first = 0;
    }
    const Ints crossing = active & (value < 0.0f);
    if (any_lane(crossing)) {
      if (skipped) {
        previous = interpolate(map, cell_of(map, add(start, mul(direction, previous_t))));
      }
      hit_t = crossing ? t + step * value / (previous - value) : hit_t;
      hits = hits | crossing;
      active = active & !crossing;
    }
    const Ints slow = value < p.slow_below;
    step = slow ? (Floats)(p.small_step_m) : step;
    skipped = 0;
    previous = value;
    t = active ? t + step : t;  // lanes that are done stay near the others
    active = active & (t < far_t);
  }
  *hit = add(start, mul(direction, hit_t));
  return hits;
}

// ONLY_MISSES: leaves pixels alone whose normal is valid already.
KERNEL raycast(global float* vertices, global float* normals, Size size, RaycastParameters p,
               Int3 n, Float3 size_m, global const short* values, global const int* planes,
               Int3 bricks, global const uchar* occupied_bricks, global const int* start_depths,
               int start_tile) {
  const Map map = {n, size_m, bricks, values, planes, occupied_bricks};
  const Floats zero = (Floats)(0.0f);
  const int across = (size.width + PACKET_WIDTH - 1) / PACKET_WIDTH;
  const int down = (size.height + PACKET_HEIGHT - 1) / PACKET_HEIGHT;
  FOR_PACKETS(packet, across * down) {
    const int x0 = packet % across * PACKET_WIDTH, y0 = packet / across * PACKET_HEIGHT;
    const Ints x = x0 + COLUMN_OF_LANE, y = y0 + ROW_OF_LANE;
    Ints wanted = (x < size.width) & (y < size.height);
#if ONLY_MISSES
    const Ints pixel = wanted ? 3 * (y * size.width + x) : (Ints)(0);
    wanted = wanted & (gather_floats(normals, pixel) == INVALID_NORMAL);
    if (!any_lane(wanted)) continue;
#endif
    const Vec3 direction = rotate3(p.T_volume_camera, pixel_ray(p.camera, x, y));
    float start_m = 0.0f;
#if BRICKS
    const int tiles = (size.width + start_tile - 1) / start_tile;
    start_m = as_float(start_depths[y0 / start_tile * tiles + x0 / start_tile]);
#endif
    Vec3 hit;
    const Ints hits =
        find_surface(&map, p.T_volume_camera.translation, direction, p, start_m, wanted, &hit);
    Vec3 vertex = vec3(zero, zero, zero), normal = vec3((Floats)(INVALID_NORMAL), zero, zero);
    if (any_lane(hits)) {
      vertex = select3(hits, hit, vertex);
      const Vec3 slope = gradient(&map, vertex);
      const Floats norm = length3(slope);
      const Ints sloped = hits & (norm > 0.0f);
      normal = select3(sloped, mul(slope, 1.0f / norm), normal);
    }
    const int first = 3 * (y0 * size.width + x0);
    store3_packet(vertex, wanted, vertices + first, size.width);
    store3_packet(normal, wanted, normals + first, size.width);
  }
}
