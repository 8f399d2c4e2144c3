// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

KERNEL track(global float* rows, global const float* vertices, global const float* normals,
             int count, global const float* model_vertices, global const float* model_normals,
             Size model_size, TrackParameters parameters) {
  FOR_PACKETS(packet, packets_of(count)) {
    const int first = packet * LANES, left = count - first;
    const TrackLanes row =
        track_lanes(load3(vertices + 3 * first, left), load3(normals + 3 * first, left),
                    model_vertices, model_normals, model_size, parameters);
#define TO(lane, i)                                                                            \
  if (i < left)                                                                                \
    vstore8((float8)(as_float(row.outcome lane), row.error lane, row.normal.x lane,            \
                     row.normal.y lane, row.normal.z lane, row.moment.x lane, row.moment.y lane, \
                     row.moment.z lane), first + i, rows);
    EVERY(TO)
#undef TO
  }
}
