// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The sums of the rows that are OK, whatever the others hold.
INLINE TrackLanes load_rows(global const float* rows, int count) {
  TrackLanes row;
#define WORD(lane, i) (i < count ? p[i * TRACK_WORDS] : 0.0f)
  global const float* p = rows;
  row.outcome = AS_INTS((Floats)(EACH(WORD)));
  const Ints ok = row.outcome == OK;
  const Floats zero = (Floats)(0.0f);
  Floats word[7];
  for (int i = 0; i < 7; ++i) {
    p = rows + 1 + i;
    word[i] = (Floats)(EACH(WORD));
    word[i] = ok ? word[i] : zero;
  }
#undef WORD
  row.error = word[0];
  row.normal = vec3(word[1], word[2], word[3]);
  row.moment = vec3(word[4], word[5], word[6]);
  return row;
}

KERNEL reduce(global float* partial, global const float* track_rows, int count) {
  local float rows[GROUP * COLUMNS];
  Sums sums = no_sums();
  FOR_PACKETS(packet, packets_of(count)) {
    const int first = packet * LANES;
    accumulate(load_rows(track_rows + first * TRACK_WORDS, count - first), count - first, &sums);
  }
  store_group_sums(&sums, rows, partial);
}
