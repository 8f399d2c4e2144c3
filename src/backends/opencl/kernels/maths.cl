// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// src/kernels/float3.h and the shared parts of pixel.h, for lanes: sums run from left to right.

INLINE Vec3 vec3(Floats x, Floats y, Floats z) {
  Vec3 v;
  v.x = x;
  v.y = y;
  v.z = z;
  return v;
}
INLINE Vec3 splat(Float3 v) { return vec3((Floats)(v.x), (Floats)(v.y), (Floats)(v.z)); }
INLINE Vec3 add(Vec3 a, Vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
INLINE Vec3 sub(Vec3 a, Vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
INLINE Vec3 mul(Vec3 a, Floats s) { return vec3(a.x * s, a.y * s, a.z * s); }
INLINE Floats dot3(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
INLINE Vec3 cross3(Vec3 a, Vec3 b) {
  return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
INLINE Floats length3(Vec3 a) { return sqrt(dot3(a, a)); }
INLINE Vec3 select3(Ints mask, Vec3 yes, Vec3 no) {
  return vec3(mask ? yes.x : no.x, mask ? yes.y : no.y, mask ? yes.z : no.z);
}
INLINE Vec3 rotate3(Rigid3f t, Vec3 v) {
  return vec3(t.row0.x * v.x + t.row0.y * v.y + t.row0.z * v.z,
              t.row1.x * v.x + t.row1.y * v.y + t.row1.z * v.z,
              t.row2.x * v.x + t.row2.y * v.y + t.row2.z * v.z);
}
INLINE Vec3 apply(Rigid3f t, Vec3 v) { return add(rotate3(t, v), splat(t.translation)); }

// Of the eight corners of a box.
INLINE float least_of(float8 v) { return FOLD_4(fmin, fmin(v.lo, v.hi)); }
INLINE float greatest_of(float8 v) { return FOLD_4(fmax, fmax(v.lo, v.hi)); }

// The direction of depth 1 through pixels (x, y).
INLINE Vec3 pixel_ray(Intrinsics k, Ints x, Ints y) {
  return vec3((TO_FLOATS(x) - k.cx) / k.fx, (TO_FLOATS(y) - k.cy) / k.fy, (Floats)(1.0f));
}

// Lanes that fall into the image; the others' coordinates are 0.
INLINE Ints project(Vec3 p, Intrinsics k, Size size, float min_depth, Ints* x, Ints* y) {
  const Floats zero = (Floats)(0.0f);
  const Floats u = k.fx * p.x / p.z + k.cx + 0.5f;
  const Floats v = k.fy * p.y / p.z + k.cy + 0.5f;
  const Ints inside = (p.z >= min_depth) & (u >= 0.0f) & (u <= (float)(size.width - 1)) &
                      (v >= 0.0f) & (v <= (float)(size.height - 1));
  *x = TO_INTS(inside ? u : zero);
  *y = TO_INTS(inside ? v : zero);
  return inside;
}
