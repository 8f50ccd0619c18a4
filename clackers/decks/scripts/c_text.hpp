#pragma once

#include <string>

#include "clackers/decks/scripts/data.hpp"

// What models in C share.
namespace clackers::decks {

inline constexpr Syntax c_syntax = {
    .comment = "//",
    .table = "enum { @name@_rows = @rows@ };\nstatic const double @name@[] = {@values@};\n",
    .vector = "static const double @name@[] = {@values@};\n",
    .number = "static const double @name@ = @value@;\n",
    .line = "",
    .nothing = "0",
};

/// Behind the data: n, dot(), solve(), rates() and impacts().
inline constexpr auto c_mechanics = R"c(enum { n = M_rows };

static double dot(const double* a, const double* b) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

// M^-1 f, into f.
static void solve(double* f) {
  double A[n * n];
  for (int i = 0; i < n * n; ++i) A[i] = M[i];
  for (int k = 0; k < n; ++k)  // M is positive definite: no pivoting
    for (int i = k + 1; i < n; ++i) {
      const double factor = A[i * n + k] / A[k * n + k];
      for (int j = k; j < n; ++j) A[i * n + j] -= factor * A[k * n + j];
      f[i] -= factor * f[k];
    }
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j) f[i] -= A[i * n + j] * f[j];
    f[i] /= A[i * n + i];
  }
}

// Of y = (u, v) at t; `order` is that of the derivative of the loads.
static void rates(double t, int order, const double* y, double* dy) {
  const double *u = y, *v = y + n;
  double* force = dy + n;
  for (int i = 0; i < n; ++i) force[i] = -dot(C + i * n, v) - dot(K + i * n, u);
  for (int i = 0; i < n; ++i) dy[i] = v[i];
  for (int k = 0; k < loads_rows; ++k) {
    const double* load = loads + 4 * k;
    const double quarter = 1.5707963267948966;
    force[(int)load[0] - 1] += load[1] * pow(load[2], order) * cos(load[2] * t + load[3] + order * quarter);
  }
  for (int k = 0; k < springs_rows; ++k) {
    const double *row = springs + (n + 2) * k, gap = dot(row, u) - row[n];
    for (int i = 0; i < n && gap < 0.0; ++i) force[i] -= row[n + 1] * gap * row[i];
  }
  solve(force);
}

// Newton's law, one contact after the other, until none of those that touch is closing. Returns their number,
// -1 where that does not end.
static int impacts(double* u, double* v, double tolerance) {
  for (int trial = 0; trial < 1000; ++trial) {
    const double* closing = NULL;
    for (int k = 0; k < contacts_rows && closing == NULL; ++k) {
      const double* contact = contacts + (n + 2) * k;
      if (dot(contact, u) - contact[n] < tolerance && dot(contact, v) < 0.0) closing = contact;
    }
    if (closing == NULL) return trial;
    double jump[n];
    for (int i = 0; i < n; ++i) jump[i] = closing[i];
    solve(jump);
    const double impulse = -(1.0 + closing[n + 1]) * dot(closing, v) / dot(closing, jump);
    for (int i = 0; i < n; ++i) v[i] += impulse * jump[i];
  }
  return -1;
}
)c";

/// Locates impacts: behind advance(t, h, y, next), a step that returns the smallest gap at its end.
extern const char* const c_located;

/// A unit of FMI 2 or 3 behind the data and the mechanics, with one of two motions, exact or of a method,
/// and a program that drives it.
extern const char* const fmu_model;
extern const char* const fmu_exact;
extern const char* const fmu_method;
extern const char* const fmu_simulate;

}  // namespace clackers::decks
