// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cmath>

#include "kernels/types.h"

/// The end of an ICP iteration on the device: Backend::solve and moved() in plain double precision.
namespace slambench::cuda {

/// A rigid transform; `rotation` row by row.
struct PoseD {
  double rotation[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  double translation[3] = {};
};

SLAMBENCH_HD inline Rigid3f to_rigid3f(const PoseD& pose) {
  const double *r = pose.rotation, *t = pose.translation;
  const auto row = [](const double* v) {
    return Float3{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
  };
  return {row(r), row(r + 3), row(r + 6), row(t)};
}

SLAMBENCH_HD inline bool is_finite(double value) { return value - value == 0; }

SLAMBENCH_HD inline double norm(const Twist& twist) {
  double sum = 0;
  for (int i = 0; i < 6; ++i) sum += twist.v[i] * twist.v[i];
  return sqrt(sum);
}

SLAMBENCH_HD inline bool is_finite(const PoseD& pose) {
  bool finite = true;
  for (const double entry : pose.rotation) finite = finite && is_finite(entry);
  for (const double entry : pose.translation) finite = finite && is_finite(entry);
  return finite;
}

SLAMBENCH_HD inline PoseD inverse(const PoseD& pose) {
  PoseD result;
  for (int i = 0; i < 3; ++i) {
    double translation = 0;
    for (int k = 0; k < 3; ++k) {
      result.rotation[3 * i + k] = pose.rotation[3 * k + i];
      translation += pose.rotation[3 * k + i] * pose.translation[k];
    }
    result.translation[i] = -translation;
  }
  return result;
}

/// exp(twist) * pose, as core/se3.h defines it.
SLAMBENCH_HD inline PoseD moved(const PoseD& pose, const Twist& twist) {
  const double *v = twist.v, *w = twist.v + 3;
  const double squared = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
  const double angle = sqrt(squared);
  // Series below the angle where the closed forms lose digits.
  const bool small = angle < 1e-4;
  const double a = small ? 1 - squared / 6 : sin(angle) / angle;
  const double b = small ? 0.5 - squared / 24 : (1 - cos(angle)) / squared;
  const double c = small ? 1.0 / 6 - squared / 120 : (angle - sin(angle)) / (squared * angle);
  const double skew[9] = {0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0};
  double turn[9], lift[9];  // the rotation, and what maps the twist's translation to the pose's
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double one = i == j ? 1 : 0;
      const double twice = w[i] * w[j] - one * squared;  // of skew * skew
      turn[3 * i + j] = one + a * skew[3 * i + j] + b * twice;
      lift[3 * i + j] = one + b * skew[3 * i + j] + c * twice;
    }
  }
  PoseD result;
  for (int i = 0; i < 3; ++i) {
    double translation = 0;
    for (int k = 0; k < 3; ++k) {
      translation += turn[3 * i + k] * pose.translation[k] + lift[3 * i + k] * v[k];
    }
    result.translation[i] = translation;
    for (int j = 0; j < 3; ++j) {
      double entry = 0;
      for (int k = 0; k < 3; ++k) entry += turn[3 * i + k] * pose.rotation[3 * k + j];
      result.rotation[3 * i + j] = entry;
    }
  }
  return result;
}

/// The normal equations and how they are being solved.
struct Equations {
  double matrix[6][6], right[6];
  double lower[6][6];  ///< of matrix = lower * diag(pivots) * lower^T; ones on the diagonal
  double pivots[6];
  double solved[7][6];    ///< columns of the inverse, and last the solution
  bool finite, factored;  ///< factored: all pivots are positive
};

SLAMBENCH_HD inline void set_up(const double* jt_j, const double* jt_error, Equations* e) {
  e->finite = true;
  for (int i = 0; i < 6; ++i) {
    e->right[i] = jt_error[i];
    e->finite = e->finite && is_finite(jt_error[i]);
    for (int j = i; j < 6; ++j) {
      const double entry = *jt_j++;
      e->finite = e->finite && is_finite(entry);
      e->matrix[i][j] = entry;
      e->matrix[j][i] = entry;
    }
  }
}

SLAMBENCH_HD inline void factor(Equations* e) {
  e->factored = e->finite;
  for (int j = 0; j < 6 && e->factored; ++j) {
    double pivot = e->matrix[j][j];
    for (int k = 0; k < j; ++k) pivot -= e->lower[j][k] * e->lower[j][k] * e->pivots[k];
    e->pivots[j] = pivot;
    e->factored = pivot > 0;
    e->lower[j][j] = 1;
    for (int i = j + 1; i < 6; ++i) {
      double entry = e->matrix[i][j];
      for (int k = 0; k < j; ++k) entry -= e->lower[i][k] * e->lower[j][k] * e->pivots[k];
      e->lower[i][j] = entry / pivot;
    }
  }
}

/// Column `which` of the inverse, or for 6 the solution, into solved[which].
SLAMBENCH_HD inline void solve_column(Equations* e, int which) {
  if (!e->factored) return;
  double* x = e->solved[which];
  for (int i = 0; i < 6; ++i) {
    x[i] = which == 6 ? e->right[i] : (which == i ? 1.0 : 0.0);
    for (int k = 0; k < i; ++k) x[i] -= e->lower[i][k] * x[k];
  }
  for (int i = 0; i < 6; ++i) x[i] /= e->pivots[i];
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) x[i] -= e->lower[k][i] * x[k];
  }
}

/// Diagonalises a symmetric matrix (cyclic Jacobi): eigenvalues on its diagonal, eigenvectors in
/// the columns of `vectors`.
SLAMBENCH_HD inline void diagonalize(double (*a)[6], double (*vectors)[6]) {
  constexpr int most_sweeps = 30;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) vectors[i][j] = i == j ? 1 : 0;
  }
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double off = 0, on = 0;
    for (int i = 0; i < 6; ++i) {
      on += a[i][i] * a[i][i];
      for (int j = i + 1; j < 6; ++j) off += a[i][j] * a[i][j];
    }
    if (!(off > 1e-40 * on)) return;
    for (int p = 0; p < 5; ++p) {
      for (int q = p + 1; q < 6; ++q) {
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta < 0 ? -1.0 : 1.0) / (fabs(theta) + sqrt(theta * theta + 1));
        const double c = 1 / sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 6; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 6; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
          const double vp = vectors[k][p], vq = vectors[k][q];
          vectors[k][p] = c * vp - s * vq;
          vectors[k][q] = s * vp + c * vq;
        }
      }
    }
  }
}

/// The shortest least-squares motion; eigenvalues below 1 / condition of the largest count as zero.
SLAMBENCH_HD inline Twist solve_spectral(Equations* e, double condition) {
  Twist twist;
  double vectors[6][6];
  diagonalize(e->matrix, vectors);
  double largest = 0;
  for (int i = 0; i < 6; ++i) largest = fmax(largest, fabs(e->matrix[i][i]));
  for (int i = 0; i < 6; ++i) {
    const double value = e->matrix[i][i];
    if (!(fabs(value) > largest / condition)) continue;
    double along = 0;
    for (int k = 0; k < 6; ++k) along += vectors[k][i] * e->right[k];
    for (int k = 0; k < 6; ++k) twist.v[k] += along / value * vectors[k][i];
  }
  return twist;
}

/// Once every column is solved: what Backend::solve answers. The product of the Frobenius norms of
/// the matrix and of its inverse is at least the condition: where it is within the limit, nothing
/// counts as zero and the solution stands. Changes the matrix.
SLAMBENCH_HD inline Twist solution(Equations* e, double condition) {
  if (!e->finite) return {};
  if (!e->factored) return solve_spectral(e, condition);
  double matrix = 0, inverse = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      matrix += e->matrix[i][j] * e->matrix[i][j];
      inverse += e->solved[i][j] * e->solved[i][j];
    }
  }
  if (!(sqrt(matrix) * sqrt(inverse) < condition)) return solve_spectral(e, condition);
  Twist twist;
  for (int i = 0; i < 6; ++i) twist.v[i] = e->solved[6][i];
  return twist;
}

}  // namespace slambench::cuda
