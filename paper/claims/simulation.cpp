#include "paper/claims/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "clackers/methods/registry.hpp"

namespace clackers::paper {

Pair::Pair(double N, double damping, double r, double u1, double m1, double k1)
    : X(4.0 * N + 1.0),
      Omega(std::sqrt(k1 / m1) * std::sqrt(1.0 - damping * damping)),
      sigma(damping * std::sqrt(k1 / m1)),
      xi1(damping),
      xi2(xi1 / std::sqrt(X * X - xi1 * xi1 * X * X + xi1 * xi1)),
      m{m1, m1 / r},
      u{u1, -r * u1 / X} {
  const double omega[] = {std::sqrt(k1 / m1), X * Omega / std::sqrt(1.0 - xi2 * xi2)};
  for (int i = 0; i < 2; ++i) {
    c[i] = 2.0 * m[i] * omega[i] * (i == 0 ? xi1 : xi2);
    k[i] = m[i] * omega[i] * omega[i];
    v[i] = -c[i] / (2.0 * m[i]) * u[i];
  }
}

double Pair::quarters(double count) const { return count * std::numbers::pi / (2.0 * Omega); }

Pair Pair::apart() const {
  Pair out = *this;
  out.contact = false;
  return out;
}

Pair Pair::from(double t) const {
  Pair out = *this;
  const auto state = motion(t).at(t, model::Side::right);
  for (int i = 0; i < masses; ++i) out.u[i] = state.u[i], out.v[i] = state.v[i];
  return out;
}

double Pair::written(double t, int mass) const {
  const double slow = std::cos(Omega * t), sign = double(slow > 0.0) - double(slow < 0.0);
  return u[mass] * (contact ? sign : 1.0) * std::cos((mass == 0 ? 1.0 : X) * Omega * t) *
         std::exp(-sigma * t);
}

model::ImpactProblem<> Pair::problem(double end) const {
  const auto vector = [&](const double* x) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(x, masses);
  };
  const auto matrix = [&](const double* x) -> Eigen::MatrixXd { return vector(x).asDiagonal(); };
  model::ImpactProblem<> out{
      {matrix(m), matrix(c), matrix(k)}, {}, {0.0, vector(u), vector(v)}, end};
  const double direction[] = {1.0, -1.0};
  if (contact) out.contacts = {{vector(direction), 0.0, 1.0}};
  return out;
}

Impacts::Impacts(const Pair& pair, double end) {
  const auto simulated = pair.motion(end);
  count = simulated.impact_count(end);
  for (long long j = 1; j <= count; ++j) {
    const auto hit = simulated.impact(j), first = simulated.impact(1);
    const auto& before = hit.before.v;
    u = std::max(u, hit.before.u.cwiseAbs().maxCoeff() / pair.u[0]);
    late = std::max(late, std::abs(hit.t - pair.quarters(2.0 * double(j) - 1.0)));
    closing = std::min(closing, before[1] - before[0]);
    momentum = std::max(momentum, std::abs(1.0 + pair.m[1] * before[1] / (pair.m[0] * before[0])));
    for (int i = 0; i < 2; ++i) {
      turned = std::max(turned, std::abs(hit.after.v[i] / before[i] + 1.0));
      if (j == 1) continue;
      rate = std::max(
          rate, std::abs(std::log(first.before.v[i] / before[i]) / (hit.t - first.t) - pair.sigma));
    }
  }
}

double largest(double from, double to, const std::function<double(double t)>& quantity) {
  double out = 0.0;
  for (int j = 0; j <= 500; ++j)
    out = std::max(out, std::abs(quantity(from + (to - from) * j / 500)));
  return out;
}

double difference(const model::Motion& first, const model::Motion& other, double from, double to,
                  double factor, double shift) {
  return largest(from, to, [&](double t) {
    const auto then = u_of(other, std::min(t + shift, other.end()));
    return (u_of(first, t) - factor * then).cwiseAbs().maxCoeff();
  });
}

std::vector<double> mass2(const Pair& pair, double from, double to) {
  const auto motion = pair.motion(to);
  const double points = 40.0 * pair.X * std::ceil((to - from) / pair.quarters(2.0));
  std::vector<double> out;
  for (double j = 0.0; j <= points; ++j)
    out.push_back(u_of(motion, from + (to - from) * j / points)[1]);
  return out;
}

std::vector<double> harmonics(const Pair& pair) {
  const auto motion = pair.motion(pair.quarters(3.0));
  constexpr int points = 8192;
  std::vector<std::complex<double>> sums(std::size_t(2.0 * pair.X) + 30);
  for (int j = 0; j < points; ++j) {
    const double t = pair.quarters(1.0 + 2.0 * (j + 0.5) / points);
    const auto turn = std::polar(1.0, -2.0 * pair.Omega * t);
    std::complex<double> pointer = u_of(motion, t)[1];
    for (auto& sum : sums) sum += pointer, pointer *= turn;
  }
  std::vector<double> out;
  for (const auto& sum : sums) out.push_back(std::abs(sum));
  const double most = *std::max_element(out.begin() + 1, out.end());
  for (auto& size : out) size /= most;
  return out;
}

model::Trajectory history(const model::ImpactProblem<>& problem, const std::string& method,
                          double step) {
  model::TrajectorySink sink(true);
  methods::method(method)->prepare(problem, step)->advance(sink);
  return sink.trajectory();
}

double difference(const model::Trajectory& run, const Pair& pair) {
  double out = 0.0;
  const auto dof = std::size_t(run.dof);
  for (std::size_t j = 0; j < run.u.size(); ++j)
    out = std::max(out, std::abs(run.u[j] - pair.written(run.t[j / dof], int(j % dof))));
  return out;
}

}  // namespace clackers::paper
