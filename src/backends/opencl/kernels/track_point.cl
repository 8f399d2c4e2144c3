// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// slambench::track_point of a packet.
INLINE TrackLanes track_lanes(Vec3 vertex, Vec3 normal, global const float* model_vertices,
                              global const float* model_normals, Size model_size,
                              TrackParameters p) {
  const Floats zero = (Floats)(0.0f);
  const Ints valid = normal.x != INVALID_NORMAL;
  const Vec3 point = apply(p.T_volume_camera, vertex);
  Ints x, y;
  const Ints inside =
      project(apply(p.T_model_volume, point), p.model_camera, model_size, 1e-6f, &x, &y);
  const Ints pixel = y * model_size.width + x;
  const Vec3 model_vertex = gather3(model_vertices, pixel);
  const Vec3 model_normal = gather3(model_normals, pixel);
  const Vec3 difference = sub(model_vertex, point);
  const Ints modelled = model_normal.x != INVALID_NORMAL;
  const Ints near = length3(difference) <= p.distance_threshold_m;
  const Ints parallel = dot3(rotate3(p.T_volume_camera, normal), model_normal) >= p.normal_threshold;

  TrackLanes row;
  row.outcome = parallel ? (Ints)(OK) : (Ints)(WRONG_NORMAL);
  row.outcome = near ? row.outcome : (Ints)(TOO_FAR);
  row.outcome = modelled ? row.outcome : (Ints)(INVALID_MODEL);
  row.outcome = inside ? row.outcome : (Ints)(OUTSIDE_MODEL);
  row.outcome = valid ? row.outcome : (Ints)(INVALID_INPUT);
  const Ints ok = row.outcome == OK;
  const Vec3 none = vec3(zero, zero, zero);
  row.error = ok ? dot3(model_normal, difference) : zero;
  row.normal = select3(ok, model_normal, none);
  row.moment = select3(ok, cross3(point, model_normal), none);
  return row;
}
