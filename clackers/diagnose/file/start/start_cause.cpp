#include <cmath>

#include "clackers/diagnose/diagnose.hpp"
#include "clackers/diagnose/file/start/start_readings.hpp"

namespace clackers::diagnose {
namespace {

bool displacements_are_right(const FirstRow& row) {
  for (std::size_t q = 0; q < row.masses(); ++q)
    if (std::abs(row.given()[q] - row.expected()[q]) > row.tolerance() * row.scale(q)) return false;
  return true;
}

std::optional<Diagnosis> start_at_rest(const FirstRow& row) {
  if (!row.has_v() || !displacements_are_right(row)) return {};
  double largest = 0.0;
  for (std::size_t q = row.masses(); q < row.given().size(); ++q) {
    if (row.given()[q] != 0.0) return {};
    largest = std::max(largest, std::abs(row.expected()[q]));
  }
  Diagnosis cause;
  cause.code = "starts-at-rest";
  cause.value = 0.0;
  cause.unit = "m/s";
  cause.confidence = 0.95;
  for (std::size_t q = row.masses(); q < row.given().size(); ++q)
    if (std::abs(row.expected()[q]) == largest) {
      cause.evidence.push_back({"mass", double(q - row.masses() + 1)});
      cause.evidence.push_back({"expected", row.expected()[q]});
      break;
    }
  return cause;
}

// v(0) is that of half a step later or earlier: v0 +- a0 h/2, the exact velocity there, or the
// difference of the first two displacements.
std::optional<Diagnosis> start_at_half_steps(const FirstRow& row) {
  const double h = row.step(), t = row.time();
  if (!row.has_v() || h == 0.0 || !displacements_are_right(row)) return {};
  const auto now = row.motion().at(t, model::Side::right);
  const auto masses = row.masses();
  const auto& rows = row.opening().rows;
  const auto left = [&](const std::vector<double>& v) {
    auto state = row.expected();
    std::copy(v.begin(), v.end(), state.begin() + std::ptrdiff_t(masses));
    return row.distance(row.given(), state);
  };
  for (const double side : {0.5, -0.5}) {
    std::vector<double> kick(masses), difference;
    for (std::size_t mass = 0; mass < masses; ++mass)
      kick[mass] = now.v[Eigen::Index(mass)] + side * h * now.a[Eigen::Index(mass)];
    if (side > 0.0 && rows.t.size() > 1)
      for (std::size_t mass = 0; mass < masses; ++mass)
        difference.push_back((rows.u[masses + mass] - rows.u[mass]) / (rows.t[1] - rows.t[0]));
    auto exact = row.state_at(t + side * h);
    exact.erase(exact.begin(), exact.begin() + std::ptrdiff_t(masses));
    double least = left(kick);
    if (t + side * h >= 0.0) least = std::min(least, left(exact));
    if (!difference.empty()) least = std::min(least, left(difference));
    if (least > row.tolerance()) continue;
    Diagnosis cause;
    cause.code = "velocity-at-half-steps";
    cause.value = side;
    cause.unit = "steps";
    cause.confidence = 0.95;
    cause.evidence = {{"gain", row.distance() / std::max(least, 1e-16)}, {"step", h}};
    return cause;
  }
  return {};
}

}  // namespace

std::optional<Diagnosis> diagnose_start(const FirstRows& opening,
                                        const model::ImpactProblem<>& problem,
                                        const model::Motion& motion) {
  if (opening.rows.t.empty()) return {};
  const FirstRow row(opening, problem, motion);
  // Nothing can be told from a difference of a few units of printing.
  constexpr double visible = 10.0;
  if (!(row.distance() > visible * row.tolerance())) return {};
  if (row.complete()) {
    if (auto cause = start_at_rest(row)) return cause;
    if (auto cause = start_at_half_steps(row)) return cause;
  }
  if (row.time() > 0.0)
    if (auto cause = start_as_shift(row)) return cause;
  if (auto cause = start_as_reading(row)) return cause;
  return row.time() > 0.0 ? std::nullopt : start_as_shift(row);
}

}  // namespace clackers::diagnose
