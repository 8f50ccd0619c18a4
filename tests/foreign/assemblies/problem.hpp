#pragma once

#include <cmath>
#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "../system.hpp"

// M a + C v + K u = f(t) with contacts, from a file of numbers that judge.py writes. Nothing here comes
// from the library under test.
namespace foreign::assemblies {

using Vector = std::vector<double>;

inline Vector operator+(Vector a, const Vector& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}
inline Vector operator*(double s, Vector a) {
  for (double& x : a) x *= s;
  return a;
}
inline Vector operator-(const Vector& a, const Vector& b) { return a + -1.0 * b; }
inline double dot(const Vector& a, const Vector& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

using Matrix = std::vector<Vector>;

inline Matrix operator+(Matrix p, const Matrix& q) {
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = p[i] + q[i];
  return p;
}
inline Matrix operator*(double s, Matrix p) {
  for (auto& row : p) row = s * row;
  return p;
}
inline Vector operator*(const Matrix& p, const Vector& x) {
  Vector y;
  for (const auto& row : p) y.push_back(dot(row, x));
  return y;
}

/// Gauss elimination with pivots.
inline Vector solve(Matrix p, Vector r) {
  const std::size_t n = r.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(p[i][k]) > std::abs(p[best][k])) best = i;
    std::swap(p[k], p[best]);
    std::swap(r[k], r[best]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = p[i][k] / p[k][k];
      if (factor == 0.0) continue;
      for (std::size_t j = k; j < n; ++j) p[i][j] -= factor * p[k][j];
      r[i] -= factor * r[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) r[k] -= p[k][j] * r[j];
    r[k] /= p[k][k];
  }
  return r;
}

/// amplitude cos(frequency t + phase) on one mass.
struct Load {
  std::size_t mass;
  double amplitude, frequency, phase;
};

/// direction . u - gap >= 0
struct Contact {
  Vector direction;
  double gap, eta;
};

struct Problem {
  Matrix M, C, K;
  Vector u0, v0;
  std::vector<Contact> contacts;
  std::vector<Load> loads;
  double end = 0.0;
  double hold = NAN;  ///< time at which loads are taken in this step, if it is held

  double gap(std::size_t c, const Vector& u) const {
    return dot(contacts[c].direction, u) - contacts[c].gap;
  }
  double speed(std::size_t c, const Vector& v) const { return dot(contacts[c].direction, v); }
  Vector force(double t) const {
    Vector f(u0.size());
    for (const auto& load : loads)
      f[load.mass] +=
          load.amplitude * std::cos(load.frequency * (std::isnan(hold) ? t : hold) + load.phase);
    return f;
  }
  Vector acceleration(const Vector& u, const Vector& v, double t) const {
    return solve(M, force(t) - C * v - K * u);
  }
};

// Scales the spring or damper between masses i and j, or i and the ground for i = j.
inline void scale_link(Matrix& matrix, std::size_t i, std::size_t j, double factor) {
  double size = -matrix[i][j];
  if (i == j) {
    size = 0.0;
    for (const double entry : matrix[i]) size += entry;
  }
  const double added = (factor - 1.0) * size;
  matrix[i][i] += added;
  if (i == j) return;
  matrix[j][j] += added;
  matrix[i][j] -= added;
  matrix[j][i] -= added;
}

/// Makes it another problem, as `o` says, for steps of h.
inline void change(Problem& p, const Options& o, double h) {
  const auto name = [](const std::string& letter, std::size_t i) {
    return letter + std::to_string(i + 1);
  };
  p.M = o.number("m*", 1.0) * p.M;
  p.C = o.number("c*", 1.0) * p.C;
  p.K = o.number("k*", 1.0) * p.K;
  for (std::size_t i = 0; i < p.u0.size(); ++i) {
    p.M[i][i] *= o.number(name("m", i) + "*", 1.0);
    for (std::size_t j = i; j < p.u0.size(); ++j) {
      scale_link(p.K, i, j, o.number(name("k", i) + std::to_string(j + 1) + "*", 1.0));
      scale_link(p.C, i, j, o.number(name("c", i) + std::to_string(j + 1) + "*", 1.0));
    }
    if (o.has(name("force", i))) p.loads.push_back({i, o.number(name("force", i), 0.0), 0.0, 0.0});
  }
  const double late = o.number("load-late", 0.0) + h * o.number("load-late-steps", 0.0);
  for (auto& load : p.loads) {
    load.amplitude *= o.number("load*", 1.0) * o.number(name("load", load.mass) + "*", 1.0);
    load.frequency *= o.number("load-frequency*", 1.0);
    load.phase += o.number("load-phase+", 0.0) - load.frequency * late;
  }
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    auto& contact = p.contacts[c];
    contact.eta = o.number(name("eta", c), o.number("solver-eta", contact.eta));
    contact.gap -= o.number("clearance", 0.0) + o.number(name("clearance", c), 0.0);
    if (o.has(name("no-contact", c))) contact.gap = -1e9;
  }
  p.v0 = o.number("v0*", 1.0) * p.v0;
}

/// Numbers separated by blanks: masses, contacts, loads, end, M, C, K, u, v, then direction, gap and
/// restitution of each contact, then mass (from 1), amplitude, frequency and phase of each load.
inline Problem read_problem(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("no problem " + path);
  Problem p;
  std::size_t n = 0, contacts = 0, loads = 0;
  in >> n >> contacts >> loads >> p.end;
  const auto vector = [&] {
    Vector read(n);
    for (double& x : read) in >> x;
    return read;
  };
  for (Matrix* matrix : {&p.M, &p.C, &p.K})
    for (std::size_t i = 0; i < n; ++i) matrix->push_back(vector());
  p.u0 = vector();
  p.v0 = vector();
  for (std::size_t c = 0; c < contacts; ++c) {
    p.contacts.push_back({vector(), 0.0, 1.0});
    in >> p.contacts.back().gap >> p.contacts.back().eta;
  }
  for (std::size_t l = 0; l < loads; ++l) {
    Load load{};
    in >> load.mass >> load.amplitude >> load.frequency >> load.phase;
    --load.mass;
    p.loads.push_back(load);
  }
  if (!in) throw std::runtime_error("cannot read " + path);
  return p;
}

}  // namespace foreign::assemblies
