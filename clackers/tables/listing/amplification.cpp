#include "clackers/tables/listing/show_sheets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "clackers/base/constants.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::tables {
namespace {

using Complex = std::complex<double>;

// A multistep method starts with others' steps, six at most.
constexpr std::size_t start_up = 6, samples = 15, overshoot_steps = 10;
// Rounding of a double eigenvalue on the unit circle.
constexpr double growth = 1e-6;

// States of u'' + u = 0 with steps of h, from u = 1 and from v = 1: a column a start.
std::vector<Eigen::MatrixXd> states(const methods::Integrator& integrator, double h) {
  const model::SmoothSystem<1> system{.mass = model::Matrix<1>(1.0),
                                      .damping = model::Matrix<1>(0.0),
                                      .stiffness = model::Matrix<1>(1.0)};
  std::vector<Eigen::MatrixXd> all(start_up + samples, Eigen::MatrixXd(2, 2));
  const auto count = static_cast<long long>(all.size());
  const methods::StepPlan plan{0.0, h * double(count), h, count, count};
  const auto stepper = integrator.stepper(system, plan);
  for (const Eigen::Index start : {0, 1}) {
    std::vector<model::State<1>> path(all.size());
    path[0].u[0] = start == 0 ? 1.0 : 0.0;
    path[0].v[0] = start == 0 ? 0.0 : 1.0;
    stepper->restart(path[0]);
    stepper->advance(0, path);
    for (std::size_t k = 0; k < all.size(); ++k) all[k].col(start) << path[k].u[0], path[k].v[0];
  }
  return all;
}

// Of the steps behind the start-up, as far as growth leaves their states finite.
std::vector<Complex> eigenvalues_of(const std::vector<Eigen::MatrixXd>& path) {
  const auto is_large = [](const Eigen::MatrixXd& x) { return !(x.cwiseAbs().maxCoeff() < 1e100); };
  const auto own = std::span(path).subspan(start_up);
  const auto count = static_cast<std::size_t>(std::ranges::find_if(own, is_large) - own.begin());
  if (count < 3) return {};
  return numerics::eigenvalues_of_iterates(own.first(count));
}

// The eigenvalue nearest to where the principal one is expected, if it oscillates.
std::optional<Complex> principal(const std::vector<Complex>& eigenvalues, Complex expected) {
  const auto distance = [&](Complex z) { return std::abs(z - expected); };
  const auto nearest = std::ranges::min_element(eigenvalues, {}, distance);
  if (nearest == eigenvalues.end() || !(nearest->imag() > 1e-9 * std::abs(*nearest))) return {};
  return *nearest;
}

double overshoot(const std::vector<Eigen::MatrixXd>& all, Eigen::Index row) {
  double largest = 0.0;
  for (std::size_t k = 0; k <= overshoot_steps; ++k)
    largest = std::max(largest, all[k].row(row).cwiseAbs().maxCoeff());
  return largest;
}

std::vector<double> linear(double first, double last, int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(first + (last - first) * i / (count - 1));
  return all;
}

}  // namespace

std::vector<Amplification> amplification(const methods::Integrator& integrator,
                                         const std::vector<double>& steps) {
  std::vector<Amplification> all;
  std::optional<Complex> rate = Complex(0.0, 1.0);  // of the principal root: exp(rate h), omega = 1
  for (const double h_over_T : steps) {
    const double h = 2.0 * std::numbers::pi * h_over_T;
    const auto path = states(integrator, h);
    const auto eigenvalues = eigenvalues_of(path);
    Amplification point{h_over_T, eigenvalues.empty() ? nan : 0.0, nan, nan, nan, nan};
    for (const auto eigenvalue : eigenvalues)
      point.spectral_radius = std::max(point.spectral_radius, std::abs(eigenvalue));
    const auto root = rate ? principal(eigenvalues, std::exp(*rate * h)) : std::nullopt;
    rate = root ? std::optional(std::log(*root) / h) : std::nullopt;
    if (rate) {
      point.period_elongation = 1.0 / rate->imag() - 1.0;
      point.amplitude_decay = 1.0 - std::exp(2.0 * std::numbers::pi * rate->real() / rate->imag());
    }
    if (point.spectral_radius <= 1.0 + growth) {
      point.u_overshoot = overshoot(path, 0);
      point.v_overshoot = overshoot(path, 1);
    }
    all.push_back(point);
  }
  return all;
}

std::vector<record::Sheet> amplification_sheets(const methods::Integrator& integrator) {
  const auto name = integrator.facts().name;
  constexpr auto note =
      "Of the free, undamped vibration. A curve ends where the quantity has no meaning.";
  const record::Column steps{"h/T", "", "step over period, h/T"};
  record::Sheet accuracy{"clackers/accuracy/1",
                         fmt::format("Period elongation and amplitude decay of {}", name),
                         {steps,
                          {"period_elongation", "", "period elongation T'/T - 1"},
                          {"amplitude_decay", "", "amplitude decay in a period, 1 - A'/A"}},
                         {},
                         record::Axes{.highest = 1.0, .y = "T'/T - 1 and 1 - A'/A", .note = note}};
  for (const auto& point : amplification(integrator, linear(0.01, 0.4, 40)))
    accuracy.rows.push_back({point.steps, record::cell_of(point.period_elongation),
                             record::cell_of(point.amplitude_decay)});
  record::Sheet radius{"clackers/spectral-radius/1",
                       fmt::format("Spectral radius of {}: above 1 the motion grows", name),
                       {steps, {"spectral_radius", "", "spectral radius, largest |eigenvalue|"}},
                       {},
                       record::Axes{.log_x = true, .highest = 1.5, .note = note}};
  const double limit = integrator.facts().stability_limit / (2.0 * std::numbers::pi);
  auto all = linear(-2.0, 2.0, 161);
  for (double& step : all) step = std::pow(10.0, step);
  if (all.front() < limit && limit < all.back()) {
    for (const double power : linear(-0.1, 0.1, 41)) all.push_back(limit * std::pow(10.0, power));
    std::ranges::sort(all);
    radius.curves->marks = {limit};
    radius.curves->mark_text = fmt::format("stability limit h/T = {:.4g}, omega h = {:.4g}", limit,
                                           integrator.facts().stability_limit);
  }
  record::Sheet overshoot{
      "clackers/overshoot/1",
      fmt::format("Overshoot of {} in ten steps, where the motion does not grow", name),
      {steps,
       {"u_overshoot", "", "displacement: largest |u| over amplitude"},
       {"v_overshoot", "", "velocity: largest |v| over amplitude"}},
      {},
      record::Axes{.log_x = true,
                   .log_y = true,
                   .y = "largest value over the exact amplitude",
                   .note = note}};
  for (const auto& point : amplification(integrator, all)) {
    radius.rows.push_back({point.steps, record::cell_of(point.spectral_radius)});
    overshoot.rows.push_back(
        {point.steps, record::cell_of(point.u_overshoot), record::cell_of(point.v_overshoot)});
  }
  return {accuracy, radius, overshoot};
}

}  // namespace clackers::tables
