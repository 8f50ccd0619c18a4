#pragma once

// Solvers with one fault each, right solvers, and the cases on which both are run. For tests only.

#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/diagnose/testing/foreign_solver.hpp"
#include "clackers/diagnose/testing/histories.hpp"

namespace clackers::diagnose::testing {

/// A fault and what must be found. `value` NaN: not compared.
struct Fault {
  const char* name;
  const char* code;
  double value;
  /// Changes problem or the words of the solver; false where the case cannot have the fault.
  std::function<bool(model::ImpactProblem<>&, std::string&)> put;

  /// Half width in which the value must be found: a file of two equal masses cannot tell a sum from
  /// its parts better than this, and a method of order two errs by (w h)^2/12 = 2e-4.
  double within() const {
    return std::isnan(value) ? INFINITY : 0.05 * (value == 0.0 ? 1.0 : std::abs(value));
  }
};

inline std::vector<Fault> faults() {
  using P = model::ImpactProblem<>&;
  using S = std::string&;
  const auto collides = [](P p) { return !p.contacts.empty(); };
  const auto restitution = [](double d) {
    return [d](P p, S) {
      for (auto& contact : p.contacts) contact.restitution += d;
      return !p.contacts.empty();
    };
  };
  const auto gap = [](double d) {
    return [d](P p, S) {
      for (auto& contact : p.contacts) contact.gap += d;
      return !p.contacts.empty();
    };
  };
  const auto mass = [](Eigen::Index i, double factor) {
    return [i, factor](P p, S) {
      if (p.dof() < 2) return false;
      p.system.mass(i, i) *= factor;
      return true;
    };
  };
  const auto stiffness = [](bool last, double factor) {
    return [last, factor](P p, S) {
      const auto i = last ? p.dof() - 1 : 0;
      p.system.stiffness(i, i) *= factor;
      return true;
    };
  };
  const auto damping = [](bool first_only, double factor) {
    return [first_only, factor](P p, S) {
      if (!(p.system.damping.norm() > 0.0)) return false;
      if (first_only)
        p.system.damping(0, 0) *= factor;
      else
        p.system.damping *= factor;
      return true;
    };
  };
  const auto damping_after = [collides](double factor) {
    return [=](P p, S s) {
      s += " c-after=" + std::to_string(factor);
      return collides(p) && p.system.damping.norm() > 0.0;
    };
  };
  const auto percent = [](double factor) { return 100.0 * (std::sqrt(factor) - 1.0); };
  return {
      {"restitution lower by 0.01", "restitution-differs", NAN, restitution(-0.01)},
      {"restitution lower by 0.1", "restitution-differs", NAN, restitution(-0.1)},
      {"mass 2 heavier by 1 %", "mass-ratio-differs", 1.0, mass(1, 1.01)},
      {"mass 1 lighter by 3 %", "mass-ratio-differs", -3.0, mass(0, 0.97)},
      {"last spring stiffer by 1 %", "frequency-differs", percent(1.01), stiffness(true, 1.01)},
      {"first spring softer by 1 %", "frequency-differs", percent(0.99), stiffness(false, 0.99)},
      {"all springs stiffer by 1 %", "frequency-differs", percent(1.01),
       [](P p, S) { return p.system.stiffness *= 1.01, true; }},
      {"damping larger by a tenth", "damping-differs", 10.0, damping(false, 1.1)},
      {"damping lost", "damping-differs", -100.0, damping(false, 0.0)},
      {"damping of mass 1 larger by half", "damping-differs", 50.0, damping(true, 1.5)},
      {"damping lost after the first impact", "damping-changes-at-impact", 0.0, damping_after(0.0)},
      {"damping halved after the first impact", "damping-changes-at-impact", 0.5,
       damping_after(0.5)},
      {"damping doubled after the first impact", "damping-changes-at-impact", 2.0,
       damping_after(2.0)},
      // Where impacts are all as fast, less than a step is a delay as well; where they slow down to
      // rest, the motion is not simulated; a long run hides it behind the error of the period.
      {"contacts close 20 mm early", "gap-differs", 0.02,
       [gap](P p, S s) {
         return gap(0.02)(p, s) && p.system.damping.norm() > 0.0 &&
                p.contacts[0].restitution > 0.5 && p.end < 21.0;
       }},
      {"contacts close 50 mm late", "gap-differs", -0.05, gap(-0.05)},
      {"second impact missed", "impact-missed", 2.0,
       [collides](P p, S s) { return s += " miss=2", collides(p); }},
      {"third impact missed", "impact-missed", 3.0,
       [collides](P p, S s) { return s += " miss=3", collides(p); }},
      {"no contact", "impact-missed", NAN,
       [](P p, S) {
         const bool had = !p.contacts.empty();
         p.contacts.clear();
         return had;
       }},
      {"first impact doubled", "impact-doubled", 1.0,
       [collides](P p, S s) { return s += " at=1 impulse-at=2", collides(p); }},
      {"third impact doubled", "impact-doubled", 3.0,
       [collides](P p, S s) { return s += " at=3 impulse-at=2", collides(p); }},
      {"impulses larger by 2 % of elastic ones", "impact-impulse-wrong", 1.02,
       [collides](P p, S s) {
         s += " impulse=1.02";
         return collides(p) && p.contacts[0].restitution == 1.0;
       }},
      {"rows late by a step", "time-shifted", 1.0,
       [](P, S s) { return s += " late-steps=1", true; }},
      {"rows late by two steps", "time-shifted", 2.0,
       [](P, S s) { return s += " late-steps=2", true; }},
      // Without damping, or by less than the method errs, a frequency explains as much.
      {"clock slow by 5 %", "time-unit", 0.95,
       [](P p, S s) { return s += " time-unit=0.95", p.system.damping.norm() > 0.0; }},
      {"rows late by 5 ms", "time-shifted", 0.005,
       [](P, S s) { return s += " late-seconds=0.005", true; }},
  };
}

inline std::vector<std::string> right_solvers() {
  std::vector<std::string> all{"method=rk4",
                               "method=newmark",
                               "method=newmark beta=0.16666666666666666",
                               "method=newmark beta=0",
                               "method=newmark beta=0.3025 gamma=0.6",
                               "method=hht alpha=-0.2",
                               "method=implicit-euler",
                               "method=symplectic-euler",
                               "method=bathe",
                               "method=rk4 event-tolerance=1e-5"};
  for (const auto* contact : {" contact=linear-time", " contact=end-of-step"})
    for (const std::string method : {"method=rk4", "method=newmark", "method=newmark beta=0"})
      all.push_back(method + contact);
  return all;
}

inline std::vector<cases::Case> system_cases() {
  auto all = assorted_cases();
  all.push_back(cases::make("three-parameter", {{"N", 1.0}, {"xi1", 0.0}}));
  all.push_back(cases::make("three-parameter", {{"N", 2.0}, {"a_t", 3.0}}));
  all.push_back(cases::make("synchronized-pair", {{"X", 7.0}, {"r", 1.5}}));
  all.push_back(cases::make("stop", {{"xi1", 0.0}}));
  all.push_back(cases::make("symmetric-pair", {{"eta", 0.7}}));
  all.push_back(cases::make("exact-data-pair", {}));
  return all;
}

inline double fastest(const cases::Case& which) {
  const auto& s = which.problem.system;
  return std::sqrt(s.stiffness.diagonal().cwiseQuotient(s.mass.diagonal()).maxCoeff());
}

inline std::string name_of(const cases::Case& which) {
  std::string name(which.entry->name);
  for (const auto& [parameter, value] : which.values)
    name += " " + parameter + "=" + std::to_string(value);
  return name;
}

/// Files of a solver for a problem that may be another than the case's, steps halved, the first
/// `turn` radians of the fastest frequency. `digits` of the printed numbers.
inline Files solved(const cases::Case& which, const model::ImpactProblem<>& problem,
                    const std::string& solver, double turn, int count, int digits = 17) {
  Files files{which};
  const double end = which.problem.end;
  double h = turn / fastest(which);
  for (int i = 0; i < count; ++i, h /= 2.0) {
    const double step = end / std::ceil(end / h);
    auto rows = history_of(solver, problem, step);
    if (digits < 17) print(rows, digits);
    files.add(rows, facts_of(which, rows, step, digits));
  }
  return files;
}

}  // namespace clackers::diagnose::testing
