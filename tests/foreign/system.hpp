#pragma once

#include <cmath>
#include <map>
#include <sstream>
#include <string>

// Linear algebra of two masses, options as key=value, and the systems of the paper from its formulas.
// Nothing here comes from the library under test.
namespace foreign {

struct Vec {
  double x = 0.0, y = 0.0;
};
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y}; }
inline Vec operator*(double s, Vec a) { return {s * a.x, s * a.y}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y; }

struct Mat {
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0;  ///< rows (a b), (c d)
};
inline Mat operator+(Mat p, Mat q) { return {p.a + q.a, p.b + q.b, p.c + q.c, p.d + q.d}; }
inline Mat operator*(double s, Mat p) { return {s * p.a, s * p.b, s * p.c, s * p.d}; }
inline Vec operator*(Mat p, Vec x) { return {p.a * x.x + p.b * x.y, p.c * x.x + p.d * x.y}; }
inline Mat outer(Vec n) { return {n.x * n.x, n.x * n.y, n.y * n.x, n.y * n.y}; }
inline Vec solve(Mat p, Vec r) {
  const double det = p.a * p.d - p.b * p.c;
  return {(p.d * r.x - p.b * r.y) / det, (p.a * r.y - p.c * r.x) / det};
}

/// key=value words of one line.
struct Options {
  std::map<std::string, std::string> values;
  explicit Options(const std::string& line) {
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      const auto cut = word.find('=');
      values[word.substr(0, cut)] = cut == std::string::npos ? "1" : word.substr(cut + 1);
    }
  }
  bool has(const std::string& key) const { return values.count(key) != 0; }
  std::string text(const std::string& key, const std::string& otherwise) const {
    const auto found = values.find(key);
    return found == values.end() ? otherwise : found->second;
  }
  double number(const std::string& key, double otherwise) const {
    const auto found = values.find(key);
    return found == values.end() ? otherwise : std::stod(found->second);
  }
};

/// M a + C v + K u = contact force along `normal`, gap = normal . u >= 0.
struct System {
  int masses = 2;
  Mat M, C, K;
  Vec u0, v0, normal{1.0, -1.0};
  bool contact = true;
  double eta = 1.0, end = 20.0;
  double spring = 0.0, dashpot = 0.0;  ///< of a penalty contact
  double release = 0.0;                ///< gap up to which a closed penalty contact pulls
  bool clip = false;                   ///< a contact force below zero is set to zero

  double clearance = 0.0;  ///< added to the gap by mistake [m]

  double gap(Vec u) const { return dot(normal, u) + clearance; }
  double speed(Vec v) const { return dot(normal, v); }
  double force(Vec u, Vec v) const {
    const double pressed = -spring * gap(u) - dashpot * speed(v);
    return clip && pressed < 0.0 ? 0.0 : pressed;
  }
  Vec acceleration(Vec u, Vec v, bool closed) const {
    const Vec free = -1.0 * (C * v + K * u);
    return solve(M, closed ? free + force(u, v) * normal : free);
  }
  Mat damping(bool closed) const { return closed ? C + dashpot * outer(normal) : C; }
  Mat stiffness(bool closed) const { return closed ? K + spring * outer(normal) : K; }
};

/// Makes it another system, as `o` says.
inline void change(System& s, const Options& o) {
  s.M.a *= o.number("m1*", 1.0);
  s.M.d *= o.number("m2*", 1.0);
  s.K.a *= o.number("k1*", 1.0);
  s.K.d *= o.number("k2*", 1.0);
  s.C.a *= o.number("c1*", 1.0) * o.number("c*", 1.0);
  s.C.d *= o.number("c2*", 1.0) * o.number("c*", 1.0);
  s.eta = o.number("solver-eta", s.eta);
  if (o.has("rest")) s.v0 = {};
  s.v0 = o.number("v0*", 1.0) * s.v0;
  if (o.has("no-contact")) s.contact = false;
  s.clearance = o.number("clearance", 0.0);
  s.spring = o.number("spring", 0.0);
  s.dashpot = o.number("dashpot", 0.0);
  s.release = o.number("release", 0.0);
  s.clip = o.has("clip");
}

/// The system that the solver should solve, section 2.2 of the paper, then the changes of `o`.
inline System make_system(const Options& o) {
  System s;
  const std::string kind = o.text("system", "pair");
  const double m1 = o.number("m1", 1.0), k1 = o.number("k1", 1.0), xi1 = o.number("xi1", 0.05);
  const double X = o.has("N") ? 4.0 * o.number("N", 2.0) + 1.0 : o.number("X", 9.0);
  const double r = o.number("r", 3.0), A = o.number("A", 1.0);
  const double w1 = std::sqrt(k1 / m1), sigma = xi1 * w1, m2 = m1 / r;
  const double w2 = w1 * std::sqrt((1.0 - xi1 * xi1) * X * X + xi1 * xi1);
  const double sign = std::lround((X - 1.0) / 2.0) % 2 == 0 ? 1.0 : -1.0;
  s.M = {m1, 0.0, 0.0, m2};
  s.C = {2.0 * m1 * sigma, 0.0, 0.0, 2.0 * m2 * sigma};
  s.K = {k1, 0.0, 0.0, m2 * w2 * w2};
  s.u0 = {A, -sign * r * A / X};
  if (kind != "pair") {
    s.masses = 1;
    s.u0.y = 0.0;
    s.normal = {1.0, 0.0};
    s.contact = kind == "stop";
  }
  s.v0 = -sigma * s.u0;
  s.eta = o.number("eta", 1.0);
  s.end = o.number("t_end", 20.0);
  change(s, o);
  return s;
}

}  // namespace foreign
