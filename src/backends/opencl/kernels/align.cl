// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// track and the sums of what it would have written, in one.
KERNEL align(global float* partial, global const float* vertices, global const float* normals,
             int count, global const float* model_vertices, global const float* model_normals,
             Size model_size, TrackParameters parameters) {
  local float rows[GROUP * COLUMNS];
  Sums sums = no_sums();
  FOR_PACKETS(packet, packets_of(count)) {
    const int first = packet * LANES, left = count - first;
    TrackLanes row =
        track_lanes(load3(vertices + 3 * first, left), load3(normals + 3 * first, left),
                    model_vertices, model_normals, model_size, parameters);
    if (left < LANES) {
      const Floats zero = (Floats)(0.0f);
      const Ints exists = IOTA < (Ints)(left);
      const Vec3 none = vec3(zero, zero, zero);
      row.error = exists ? row.error : zero;
      row.normal = select3(exists, row.normal, none);
      row.moment = select3(exists, row.moment, none);
    }
    accumulate(row, left, &sums);
  }
  store_group_sums(&sums, rows, partial);
}
