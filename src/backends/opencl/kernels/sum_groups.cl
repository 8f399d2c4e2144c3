// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The top of the tree: a work-item a column; counts end up as integers.
KERNEL sum_groups(global float* total, global const float* partial, int groups) {
  for (int column = get_local_id(0); column < COLUMNS; column += GROUP) {
    float8 sum = (float8)(0.0f);
    int8 count = (int8)(0);
    for (int first = 0; first < groups; first += 8) {
#define AT(i) (first + i < groups ? partial[(first + i) * COLUMNS + column] : 0.0f)
      const float8 values = (float8)(AT(0), AT(1), AT(2), AT(3), AT(4), AT(5), AT(6), AT(7));
#undef AT
      sum += values;
      count += convert_int8(values);
    }
    const int whole = FOLD_4(SUM_OF, count.lo + count.hi);
    total[column] = column < COUNTS ? FOLD_4(SUM_OF, sum.lo + sum.hi) : as_float(whole);
  }
}
