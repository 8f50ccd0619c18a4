#include "clackers/diagnose/start_parameters.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "clackers/diagnose/file/start/first_row.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::diagnose {
namespace {

using Values = std::vector<CaseParameter>;

constexpr int most_whole = 50;

class Search {
 public:
  Search(const FirstRow& row, const CaseFamily& family) : row_(row), motion_of_(family.motion_of) {
    for (const auto& parameter : family.parameters) {
      if (!parameter.is_setting || !moves_start(parameter)) continue;
      (is_whole(parameter) ? whole_ : real_).push_back(parameter);
    }
  }

  Values run() const {
    for (const auto& whole : whole_)
      if (auto found = scan(whole, nullptr); !found.empty()) return found;
    for (const auto& real : real_)
      if (auto found = refined({real}); !found.empty()) return found;
    for (const auto& whole : whole_)
      for (const auto& real : real_)
        if (auto found = scan(whole, &real); !found.empty()) return found;
    for (std::size_t i = 0; i < real_.size(); ++i)
      for (std::size_t j = i + 1; j < real_.size(); ++j)
        if (auto found = refined({real_[i], real_[j]}); !found.empty()) return found;
    return {};
  }

 private:
  // Differences of the first row from the start over the envelope of the case; empty for values that
  // are not allowed.
  Eigen::VectorXd difference(const Values& values) const {
    const auto motion = motion_of_(values);
    if (motion == nullptr) return {};
    const auto now = motion->at(0.0, model::Side::right);
    std::vector<double> known;
    for (std::size_t q = 0; q < row_.given().size(); ++q) {
      if (std::isnan(row_.given()[q])) continue;
      const auto mass = Eigen::Index(q % row_.masses());
      const double state = q < row_.masses() ? now.u[mass] : now.v[mass];
      known.push_back((state - row_.given()[q]) / row_.scale(q));
    }
    return Eigen::Map<Eigen::VectorXd>(known.data(), Eigen::Index(known.size()));
  }

  bool matches(const Values& values) const {
    const auto left = difference(values);
    return left.size() > 0 && left.cwiseAbs().maxCoeff() <= row_.tolerance();
  }

  bool moves_start(const CaseParameter& parameter) const {
    const auto before = difference({parameter});
    for (const double factor : {1.5, 0.5, 3.0, 1.0 / 3.0, 7.0}) {
      const auto after =
          difference({{parameter.name, parameter.value == 0.0 ? 0.1 : factor * parameter.value}});
      if (after.size() > 0 && before.size() > 0) {
        if ((after - before).cwiseAbs().maxCoeff() > 1e-12) return true;
      }
    }
    return false;
  }

  bool is_whole(const CaseParameter& parameter) const {
    return parameter.value == std::round(parameter.value) &&
           motion_of_(Values{{parameter.name, parameter.value + 0.5}}) == nullptr &&
           motion_of_(Values{{parameter.name, parameter.value * 1.01}}) == nullptr;
  }

  Values scan(const CaseParameter& whole, const CaseParameter* real) const {
    for (int n = 0; n <= most_whole; ++n) {
      Values values{{whole.name, double(n)}};
      if (real == nullptr) {
        if (matches(values)) return values;
        continue;
      }
      if (n == int(whole.value)) continue;
      values.push_back(*real);
      if (auto found = step_from(values, 1); !found.empty()) return found;
    }
    return {};
  }

  Values refined(const Values& from) const {
    const auto starts = from.size() == 1
                            ? std::vector<double>{1.0, 1e-1, 10.0, 1e-2, 100.0, 1e-3, 1000.0}
                            : std::vector<double>{1.0, 0.2, 5.0};
    for (const double factor : starts) {
      auto values = from;
      for (auto& one : values) one.value *= factor;
      if (auto found = step_from(values, 0); !found.empty()) return found;
    }
    return {};
  }

  // Gauss-Newton steps in the values from `first` on; empty where they do not lead to a match.
  Values step_from(Values values, std::size_t first) const {
    const auto count = Eigen::Index(values.size() - first);
    auto left = difference(values);
    for (int step = 0; step < 10 && left.size() > 0; ++step) {
      if (left.cwiseAbs().maxCoeff() <= row_.tolerance()) return rounded(values, first);
      Eigen::MatrixXd slopes(left.size(), count);
      for (Eigen::Index i = 0; i < count; ++i) {
        auto moved = values;
        auto& value = moved[first + std::size_t(i)].value;
        const double change = 1e-6 * std::max(std::abs(value), 1e-3);
        value += change;
        const auto after = difference(moved);
        if (after.size() != left.size()) return {};
        slopes.col(i) = (after - left) / change;
      }
      const Eigen::VectorXd change = -numerics::least_squares(slopes, left);
      if (!change.allFinite()) return {};
      Eigen::VectorXd next;
      Values moved;
      for (double part = 1.0; part > 0.01; part *= 0.5) {
        moved = values;
        for (Eigen::Index i = 0; i < count; ++i)
          moved[first + std::size_t(i)].value += part * change[i];
        next = difference(moved);
        if (next.size() > 0 && next.norm() < left.norm()) break;
        next.resize(0);
      }
      if (next.size() == 0) return nearest_zero(values, first);
      values = moved;
      left = next;
    }
    return {};
  }

  // The least value of a range is often 0, and a step may end below it.
  Values nearest_zero(Values values, std::size_t first) const {
    for (std::size_t i = first; i < values.size(); ++i) {
      const double kept = values[i].value;
      values[i].value = 0.0;
      if (matches(values)) return values;
      values[i].value = kept;
    }
    return {};
  }

  Values rounded(Values values, std::size_t first) const {
    for (std::size_t i = first; i < values.size(); ++i) {
      const double exact = values[i].value;
      values[i].value = 0.0;
      if (matches(values)) continue;
      for (int digits = 1; digits < 17; ++digits) {
        values[i].value = std::strtod(fmt::format("{:.{}g}", exact, digits).c_str(), nullptr);
        if (matches(values)) break;
        values[i].value = exact;
      }
    }
    return values;
  }

  const FirstRow& row_;
  const MotionOf& motion_of_;
  Values whole_, real_;
};

// The rows of the first flight, which another cause of the start may explain better.
bool flight_agrees(const FirstRow& row, const Diagnosis& cause, const model::Motion& found) {
  const double left = row.flight_distance(found);
  if (cause.code == "starts-at-rest") return !(row.own_flight_distance() < 0.5 * left);
  if (cause.code == "velocity-at-half-steps")
    return !(row.flight_distance(row.motion()) < 0.5 * left);
  constexpr double sure = 0.9;
  return cause.code == "time-shifted" || cause.confidence < sure;
}

}  // namespace

std::vector<CaseParameter> start_parameters(const FirstRows& opening,
                                            const model::ImpactProblem<>& problem,
                                            const model::Motion& motion, const CaseFamily& family) {
  if (opening.rows.t.empty() || opening.rows.t.front() != 0.0) return {};
  const FirstRow row(opening, problem, motion);
  auto found = Search(row, family).run();
  if (found.empty()) return {};
  const auto other = family.motion_of(found);
  const auto cause = diagnose_start(opening, problem, motion);
  if (other == nullptr || (cause && !flight_agrees(row, *cause, *other))) return {};
  return found;
}

}  // namespace clackers::diagnose
