// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The tree that sums up the point-to-plane system: lanes, work-items, groups, in a fixed order.
// Columns of a row of sums: error^2, error J (6), the upper triangle of J^T J (21), and how many
// pixels had which outcome (4), which are whole numbers that a float holds exactly in one group.
#define COLUMNS 32
#define COUNTS 28

typedef struct {
  Floats squared_error, jt_error[6], jt_j[21];
  Ints inliers, too_far, wrong_normal, others;
} Sums;

// What track makes of a packet; error, normal and moment are 0 where the outcome is not OK.
typedef struct {
  Ints outcome;
  Floats error;
  Vec3 normal, moment;
} TrackLanes;

INLINE Sums no_sums(void) {
  Sums s;
  s.squared_error = (Floats)(0.0f);
  for (int i = 0; i < 6; ++i) s.jt_error[i] = (Floats)(0.0f);
  for (int i = 0; i < 21; ++i) s.jt_j[i] = (Floats)(0.0f);
  s.inliers = s.too_far = s.wrong_normal = s.others = (Ints)(0);
  return s;
}

// Adds a packet of which `count` pixels exist.
INLINE void accumulate(TrackLanes row, int count, Sums* s) {
  const Floats j[6] = {row.normal.x, row.normal.y, row.normal.z,
                       row.moment.x, row.moment.y, row.moment.z};
  s->squared_error += row.error * row.error;
  int entry = 0;
  UNROLL
  for (int a = 0; a < 6; ++a) {
    s->jt_error[a] += row.error * j[a];
    UNROLL
    for (int b = a; b < 6; ++b) s->jt_j[entry++] += j[a] * j[b];
  }
  const Ints one = (Ints)(1), none = (Ints)(0);
  const Ints exists = IOTA < (Ints)(count);
  const Ints ok = exists & (row.outcome == OK), too_far = exists & (row.outcome == TOO_FAR);
  const Ints wrong_normal = exists & (row.outcome == WRONG_NORMAL);
  const Ints others = exists & !(ok | too_far | wrong_normal);
  s->inliers += ok ? one : none;
  s->too_far += too_far ? one : none;
  s->wrong_normal += wrong_normal ? one : none;
  s->others += others ? one : none;
}

// Sums over the lanes, then over the work-items of the group (GROUP is a power of two).
INLINE void store_group_sums(const Sums* s, local float* rows, global float* partial) {
  local float* row = rows + get_local_id(0) * COLUMNS;
  row[0] = SUM_OF_LANES(s->squared_error);
  for (int i = 0; i < 6; ++i) row[1 + i] = SUM_OF_LANES(s->jt_error[i]);
  for (int i = 0; i < 21; ++i) row[7 + i] = SUM_OF_LANES(s->jt_j[i]);
  row[COUNTS] = SUM_OF_LANES(TO_FLOATS(s->inliers));
  row[COUNTS + 1] = SUM_OF_LANES(TO_FLOATS(s->too_far));
  row[COUNTS + 2] = SUM_OF_LANES(TO_FLOATS(s->wrong_normal));
  row[COUNTS + 3] = SUM_OF_LANES(TO_FLOATS(s->others));
  for (int half_size = GROUP / 2; half_size > 0; half_size /= 2) {
    barrier(CLK_LOCAL_MEM_FENCE);
    if (get_local_id(0) < half_size) {
      for (int i = 0; i < COLUMNS; ++i) row[i] += row[half_size * COLUMNS + i];
    }
  }
  if (get_local_id(0) == 0) {
    for (int i = 0; i < COLUMNS; ++i) partial[get_group_id(0) * COLUMNS + i] = row[i];
  }
}
