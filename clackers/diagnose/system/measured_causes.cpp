#include "clackers/diagnose/system/measured_causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>

#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::diagnose {
namespace {

using System = model::SmoothSystem<>;
using measure::FreeState;

// One way in which the flights may be those of another system: linear in each of its parameters.
struct FlightChange {
  Diagnosis cause;  ///< without its numbers
  std::vector<std::function<void(System&, double)>> parameters;
  double frequency = 0.0;  ///< of a load [rad/s]
  bool is_of_all = false;  ///< all springs, dampers or loads by one share, not one of them
};

std::string place_of(Eigen::Index i, Eigen::Index j) {
  return i == j ? fmt::format("between mass {} and the ground", i + 1)
                : fmt::format("between masses {} and {}", i + 1, j + 1);
}

// A spring or damper between i and j, or i and the ground for i = j, by its share, and all of them by one.
void add_links(std::vector<FlightChange>& all, Code code, const char* text_of_all,
               Eigen::MatrixXd System::*member, const System& system) {
  const Eigen::MatrixXd& matrix = system.*member;
  const auto before = all.size();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = i; j < matrix.rows(); ++j) {
      const double size = i == j ? matrix.row(i).sum() : -matrix(i, j);
      if (!(std::abs(size) > 1e-9 * matrix.cwiseAbs().maxCoeff())) continue;
      FlightChange one{diagnosis_of(code, NAN, "%"), {}};
      one.cause.text = place_of(i, j);
      one.parameters.push_back([=](System& changed, double d) {
        auto& to = changed.*member;
        to(i, i) += d * size;
        if (i == j) return;
        to(j, j) += d * size;
        to(i, j) -= d * size;
        to(j, i) -= d * size;
      });
      all.push_back(std::move(one));
    }
  if (all.size() < before + 2) return;
  FlightChange whole{diagnosis_of(code, NAN, "%"), {}, 0.0, true};
  whole.cause.text = text_of_all;
  whole.parameters.push_back([=](System& changed, double d) { changed.*member *= 1.0 + d; });
  all.push_back(std::move(whole));
}

void add_force(System& system, const model::HarmonicForce& force) {
  system.add_load = [before = system.add_load, added = model::HarmonicLoad({force})](
                        double t, std::span<double> sum) {
    if (before) before(t, sum);
    added(t, sum);
  };
}

std::vector<FlightChange> changes_of(const System& system) {
  std::vector<FlightChange> all;
  add_links(all, Code("stiffness-differs"), "of all springs", &System::stiffness, system);
  add_links(all, Code("damping-differs"), "of all dampers", &System::damping, system);
  const auto add = [&](Code code, std::string unit, int mass) -> FlightChange& {
    all.push_back({diagnosis_of(code, NAN, std::move(unit)), {}});
    all.back().cause.evidence.push_back({"mass", mass + 1.0});
    return all.back();
  };
  const auto* load = system.add_load.target<model::HarmonicLoad>();
  for (int mass = 0; mass < system.dof(); ++mass) {
    add(Code("mass-differs"), "%", mass).parameters.push_back([=](System& changed, double d) {
      changed.mass(mass, mass) /= 1.0 - d;  // forces act by 1 / mass
    });
    const auto is_here = [&](const model::HarmonicForce& force) {
      return force.dof == mass && force.frequency == 0.0;
    };
    if (load != nullptr && std::ranges::any_of(load->forces(), is_here)) continue;
    add(Code("constant-force"), "N", mass).parameters.push_back([=](System& changed, double d) {
      add_force(changed, {mass, d, 0.0, 0.0});
    });
  }
  if (load == nullptr) return all;
  const auto& forces = load->forces();
  // More of some forces, and the same a quarter of a period later: as much later as the fastest.
  const auto add_parameters = [](FlightChange& one, std::vector<model::HarmonicForce> some) {
    one.frequency = std::ranges::max(some, {}, &model::HarmonicForce::frequency).frequency;
    one.parameters.push_back([=](System& changed, double d) {
      for (const auto& f : some) add_force(changed, {f.dof, d * f.amplitude, f.frequency, f.phase});
    });
    if (!(one.frequency > 0.0)) return;
    one.parameters.push_back([=, fastest = one.frequency](System& changed, double d) {
      for (const auto& f : some)
        if (f.frequency > 0.0)
          add_force(changed, {f.dof, d * f.amplitude * f.frequency / fastest, f.frequency,
                              f.phase - 0.5 * M_PI});
    });
  };
  for (const auto& force : forces)
    add_parameters(add(Code("load-differs"), "1", force.dof), {force});
  if (forces.size() > 1) {
    all.push_back({diagnosis_of(Code("load-differs"), NAN, "1"), {}, 0.0, true});
    add_parameters(all.back(), {forces.begin(), forces.end()});
  }
  return all;
}

// Pairs of neighbouring rows with no impact near them.
std::vector<std::size_t> flights_in(const model::Trajectory& rows, double longest) {
  constexpr std::size_t most = 300;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i + 1 < rows.t.size(); ++i) {
    const double s = rows.t[i + 1] - rows.t[i];
    if (!(s > 0.0) || s > longest) continue;
    const auto near = [&](const model::Impact& impact) {
      return impact.t > rows.t[i] - 3.0 * s && impact.t < rows.t[i + 1] + 3.0 * s;
    };
    if (!rows.impacts || std::ranges::none_of(*rows.impacts, near)) found.push_back(i);
  }
  if (found.size() <= most) return found;
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < most; ++k) kept.push_back(found[k * found.size() / most]);
  return kept;
}

// What flights lack of the case's equations: in sqrt(m) v, a row a flight and mass, and what each
// parameter of each change makes of it.
struct FlightFit {
  Eigen::VectorXd lack;
  Eigen::MatrixXd columns;
  /// By this share displacements between rows are larger than what velocities make of them: no force does
  /// so, but a clock, or another unit of velocities.
  double excess = 0.0;
};

class Mover {
 public:
  Mover(const System& system, double fastest) : motion_(system), fastest_(fastest) {}
  FreeState moved(const FreeState& state, double s) const {
    return motion_.moved(state, s, 1 + int(std::abs(s) * fastest_ / 0.05));
  }

 private:
  measure::FreeMotion motion_;
  double fastest_;
};

FlightFit flight_fit(const Observation& seen, const System& system,
                     const std::vector<FlightChange>& changes) {
  FlightFit fit;
  const double fastest = measure::highest_frequency(system);
  const auto& whole = seen.sample;
  if (whole.v.empty()) return fit;
  const double longest = 0.5 / fastest;
  auto flights = flights_in(whole, longest);
  constexpr std::size_t enough = 40;
  const auto& rows = flights.size() < enough && !seen.opening.v.empty() ? seen.opening : whole;
  if (&rows != &whole) flights = flights_in(rows, longest);
  if (flights.size() < enough) return fit;
  const auto dof = system.dof();
  const Eigen::ArrayXd weight = system.mass.diagonal().array().sqrt();
  const auto moved = [&](const System& by) {
    const Mover mover(by, fastest);
    Eigen::VectorXd all(std::ssize(flights) * dof);
    for (std::size_t k = 0; k < flights.size(); ++k) {
      const auto i = flights[k];
      const double s = rows.t[i + 1] - rows.t[i];
      all.segment(Eigen::Index(k) * dof, dof) =
          mover.moved(measure::row_state(rows, i), s).v.array() * weight / s;
    }
    return all;
  };
  const Eigen::VectorXd right = moved(system);
  fit.lack.resize(right.size());
  for (std::size_t k = 0; k < flights.size(); ++k) {
    const auto i = flights[k];
    fit.lack.segment(Eigen::Index(k) * dof, dof) =
        measure::row_state(rows, i + 1).v.array() * weight / (rows.t[i + 1] - rows.t[i]);
  }
  fit.lack -= right;
  const Mover mover(system, fastest);
  double over = 0.0, under = 0.0;
  for (const auto i : flights) {
    const double s = rows.t[i + 1] - rows.t[i];
    const auto from = measure::row_state(rows, i), to = measure::row_state(rows, i + 1);
    const Eigen::VectorXd way = s * from.v.array() * weight.square();
    over += way.dot(to.u - mover.moved(from, s).u);
    under += way.dot(s * from.v);
  }
  if (under > 0.0) fit.excess = over / under;
  std::vector<Eigen::VectorXd> columns;
  constexpr double small = 1e-5;
  for (const auto& change : changes)
    for (const auto& parameter : change.parameters) {
      auto changed = system;
      parameter(changed, small);
      columns.emplace_back((moved(changed) - right) / small);
    }
  fit.columns.resize(right.size(), std::ssize(columns));
  for (std::size_t k = 0; k < columns.size(); ++k) fit.columns.col(Eigen::Index(k)) = columns[k];
  return fit;
}

// Some changes fitted together: their parameters one after the other.
struct Fitted {
  std::vector<std::size_t> changes;
  Eigen::VectorXd values, uncertainty;
  double gain = 0.0;
};

class FlightFits {
 public:
  FlightFits(const Observation& seen, const System& system,
             const std::vector<FlightChange>& changes)
      : fit_(flight_fit(seen, system, changes)) {
    for (const auto& change : changes) {
      first_.push_back(next_);
      next_ += std::ssize(change.parameters);
      count_.push_back(std::ssize(change.parameters));
    }
    if (!known()) return;
    gram_ = fit_.columns.transpose() * fit_.columns;
    onto_ = fit_.columns.transpose() * fit_.lack;
    square_ = fit_.lack.squaredNorm();
  }

  bool known() const { return fit_.lack.size() > 0; }
  double excess() const { return fit_.excess; }

  Fitted of(std::vector<std::size_t> changes) const {
    std::vector<Eigen::Index> at;
    for (const auto change : changes)
      for (Eigen::Index k = 0; k < count_[change]; ++k) at.push_back(first_[change] + k);
    const Eigen::MatrixXd part = gram_(at, at);
    const numerics::Cholesky solver(part);
    Fitted found{std::move(changes), {}, {}, 0.0};
    if (!solver.is_definite(part, double(part.rows()) * std::numeric_limits<double>::epsilon()))
      return found;
    found.values = solver.solve(onto_(at));
    double left = (fit_.lack - fit_.columns(Eigen::all, at) * found.values).squaredNorm();
    found.gain = std::sqrt(square_ / std::max(left, 1e-300));
    left /= double(fit_.lack.size());
    found.uncertainty =
        (4.0 * left *
         solver.solve(Eigen::MatrixXd::Identity(part.rows(), part.rows())).diagonal().array())
            .sqrt();
    return found;
  }

 private:
  FlightFit fit_;
  Eigen::MatrixXd gram_;
  Eigen::VectorXd onto_;
  double square_ = 0.0;
  Eigen::Index next_ = 0;
  std::vector<Eigen::Index> first_, count_;
};

// The change, or two of them, that leave least; nothing where another one leaves little more. One of
// some springs, dampers or loads beside all of them is as good as two.
std::optional<Fitted> best_of(const FlightFits& fits, const std::vector<FlightChange>& changes) {
  constexpr double least_gain = 5.0, least_gain_of_two = 20.0, least_lead = 2.0;
  std::vector<Fitted> tried;
  const auto lead = [&](double least) -> std::optional<Fitted> {
    std::ranges::sort(tried, std::greater{}, &Fitted::gain);
    if (tried.empty() || tried.front().gain < least) return {};
    if (tried.size() > 1 && tried.front().gain < least_lead * tried[1].gain) return {};
    return tried.front();
  };
  for (std::size_t i = 0; i < changes.size(); ++i) tried.push_back(fits.of({i}));
  const auto one = lead(least_gain);
  const double alone = tried.empty() ? 0.0 : tried.front().gain;
  tried.clear();
  for (std::size_t i = 0; i < changes.size(); ++i)
    for (std::size_t j = i + 1; j < changes.size(); ++j)
      if (changes[i].cause.code != changes[j].cause.code || !changes[j].is_of_all)
        tried.push_back(fits.of({i, j}));
  // Two changes always leave less than one, and what the method's own error leaves is no change.
  constexpr double worth_two = 3.0, enough_alone = 300.0;
  const auto two = lead(least_gain_of_two);
  return two && two->gain > worth_two * alone && alone < enough_alone ? two : one;
}

// The diagnosis of one change by its values.
Diagnosis diagnosis_by(const FlightChange& change, std::span<const double> values,
                       double uncertainty) {
  auto cause = change.cause;
  const double scale = cause.unit == "%" ? 100.0 : 1.0;
  cause.value = scale * values[0];
  if (cause.code == Code("mass-differs").name()) cause.value /= 1.0 - values[0];
  if (cause.code == Code("load-differs").name()) {
    // (1 + a) cos + b sin: amplitude and lateness.
    constexpr double noticeable_lag = 1e-4;  // [rad]
    const double lag = values.size() > 1 ? values[1] : 0.0;
    cause.value = std::hypot(1.0 + values[0], lag);
    const double late = std::atan2(lag, 1.0 + values[0]) / change.frequency;
    if (std::abs(lag) > noticeable_lag && cause.value > 0.1)
      cause.evidence.push_back({"time", late});
    if (cause.value < std::max(0.02, 3.0 * uncertainty)) cause.text = "missing";
  }
  cause.evidence.push_back({"uncertainty", scale * uncertainty});
  return cause;
}

}  // namespace

std::vector<Diagnosis> flight_causes(const DiagnosisInput& question, System* solved) {
  if (!is_elsewhere(question)) return {};
  const auto& finest = question.histories.back();
  const auto other = std::ranges::find_if(
      question.histories.rbegin(), question.histories.rend(), [&](const Observation& one) {
        return one.facts.step > least_other_step * finest.facts.step;
      });
  if (other == question.histories.rend()) return {};
  const auto& system = question.problem.system;
  if (system.nonlinear || system.dof() > 40) return {};
  const auto changes = changes_of(system);
  const FlightFits fits(finest, system, changes), others(*other, system, changes);
  if (!fits.known() || !others.known()) return {};
  const auto best = best_of(fits, changes);
  if (!best) return {};
  const auto again = others.of(best->changes);
  if (again.values.size() == 0) return {};
  const double excess = fits.excess();
  if (std::abs(excess) > same_share * best->values.cwiseAbs().maxCoeff() &&
      std::abs(others.excess() - excess) < same_share * std::abs(excess))
    return {};
  std::vector<Diagnosis> found;
  Eigen::Index at = 0;
  for (const auto change : best->changes) {
    const auto count = std::ssize(changes[change].parameters);
    const auto values = best->values.segment(at, count);
    const double apart = (again.values.segment(at, count) - values).norm();
    const double spread =
        best->uncertainty.segment(at, count).norm() + again.uncertainty.segment(at, count).norm();
    if (apart > same_share * values.norm() + spread || values.norm() < 2.0 * spread) return {};
    // No spring, damper or mass is below zero.
    constexpr double least_share = -1.05;
    if (changes[change].cause.unit == "%" && values[0] < least_share) return {};
    found.push_back(diagnosis_by(changes[change], {values.data(), std::size_t(count)},
                                 std::max(apart, best->uncertainty[at])));
    found.back().confidence = 0.95;
    found.back().evidence.insert(found.back().evidence.begin(), {"gain", best->gain});
    found.back().evidence.push_back({"files", 2.0});
    if (best->changes.size() > 1)
      found.back().evidence.push_back({"causes", double(best->changes.size())});
    at += count;
  }
  if (solved == nullptr) return found;
  at = 0;
  for (const auto change : best->changes)
    for (const auto& parameter : changes[change].parameters) parameter(*solved, best->values[at++]);
  return found;
}

bool is_elsewhere(const DiagnosisInput& question) {
  const auto& fit = question.displacement;
  return question.limit.wrong || fit.behaviour == Behaviour::stagnating ||
         fit.reason == Code("larger-than-motion").name();
}

std::vector<Diagnosis> measured_causes(const DiagnosisInput& question) {
  auto solved = question.problem;
  auto found = flight_causes(question, &solved.system);
  const auto& q = question;
  std::ranges::move(impact_causes({solved, q.motion, q.histories, q.ladder, q.displacement,
                                   q.velocity, q.limit, q.by_tolerance, q.is_this_system}),
                    std::back_inserter(found));
  return found;
}

}  // namespace clackers::diagnose
