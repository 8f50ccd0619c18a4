#include "clackers/diagnose/system/hypotheses.hpp"

#include <cmath>

namespace clackers::diagnose {

namespace {

double damping_ratio(const model::ImpactProblem<>& problem, Eigen::Index i) {
  const auto& s = problem.system;
  return s.damping(i, i) / (2.0 * std::sqrt(s.stiffness(i, i) * s.mass(i, i)));
}

bool is_frequency(const Hypothesis& one) { return one.code.name() == "frequency-differs"; }

}  // namespace

Variation Hypothesis::base(const model::ImpactProblem<>& problem) const {
  Variation made{problem, law};
  if (no_contact) made.problem.contacts.clear();
  return made;
}

Diagnosis Hypothesis::diagnosis(const model::ImpactProblem<>& problem, double d,
                                double uncertainty) const {
  Diagnosis found;
  found.code = code.name();
  const auto say = [&](double value, double factor, const char* unit) {
    found.value = value;
    found.unit = unit;
    found.evidence.push_back({"uncertainty", std::abs(factor) * uncertainty});
  };
  if (!parameter) {
    if (no_contact)
      found.evidence.push_back({"share", 1.0});
    else
      found.value = law.missed + law.doubled;
    return found;
  }
  const Eigen::Index mass = std::max(parameter->mass, 0);
  const double eta = problem.contacts.empty() ? 1.0 : problem.contacts.front().restitution;
  switch (parameter->change) {
    case Change::restitution:
      // More than an elastic impact gives back cannot be called restitution.
      if (eta + d > 1.0 + std::max(uncertainty, 1e-9)) {
        found.code = Code("impact-impulse-wrong").name();
        say(1.0 + d / (1.0 + eta), 1.0 / (1.0 + eta), "1");
        found.evidence.push_back({"expected", 1.0});
      } else {
        say(eta + d, 1.0, "1");
        found.evidence.push_back({"expected", eta});
      }
      break;
    case Change::impulse:
      say(1.0 + d, 1.0, "1");
      found.evidence.push_back({"expected", 1.0});
      break;
    case Change::damping:
      if (const double ratio = damping_ratio(problem, mass); ratio > 0.0)
        say(100.0 * d / ratio, 100.0 / ratio, "%");
      else
        say(d, 1.0, "1");
      break;
    case Change::gap:
      say(d, 1.0, "m");
      break;
    case Change::damping_after_impact:
      say(1.0 + d, 1.0, "1");
      break;
    case Change::time_shift:
      say(d, 1.0, "s");
      break;
    case Change::time_scale:
      say(1.0 / (1.0 + d), 1.0, "1");
      break;
    case Change::mass:
      if (is_frequency(*this))
        say(100.0 * (1.0 / std::sqrt(1.0 + d) - 1.0), 50.0, "%");
      else
        say(100.0 * d, 100.0, "%");
      break;
    default:
      say(100.0 * d, 100.0, "%");
  }
  if (parameter->mass >= 0 && problem.dof() > 1)
    found.evidence.push_back({"mass", double(parameter->mass + 1)});
  return found;
}

std::vector<Hypothesis> parameter_hypotheses(const model::ImpactProblem<>& problem) {
  std::vector<Hypothesis> all;
  const auto add = [&](Code code, Change change, int mass = -1) {
    all.push_back({code, Parameter{change, mass}});
  };
  const int n = int(problem.dof());
  const bool impacts = !problem.contacts.empty(), damped = problem.system.damping.norm() > 0.0;
  for (int i = 0; i < n; ++i) {
    add("frequency-differs", Change::frequency, i);
    if (damped) add("frequency-differs", Change::frequency_at_ratio, i);
    add("damping-differs", Change::damping, i);
    if (n == 1 && damped) add("frequency-differs", Change::mass, i);
    if (n > 1) add("mass-ratio-differs", Change::mass, i);
    if (n > 1 && impacts) add("impact-impulse-wrong", Change::impulse, i);
  }
  if (n > 1) add("frequency-differs", Change::frequency);
  if (n > 1) add("damping-differs", damped ? Change::damping_share : Change::damping);
  if (n > 1 && impacts) add("mass-ratio-differs", Change::mass_ratio, n - 1);
  if (impacts) add("restitution-differs", Change::restitution);
  if (impacts) add("gap-differs", Change::gap);
  if (impacts && damped) add("damping-changes-at-impact", Change::damping_after_impact);
  add("time-shifted", Change::time_shift);
  add("time-unit", Change::time_scale);
  return all;
}

std::vector<Hypothesis> impact_hypotheses(int first, int last) {
  std::vector<Hypothesis> all;
  for (int k = first; k <= last; ++k) {
    all.push_back({"impact-missed", {}, {.missed = k}});
    all.push_back({"impact-doubled", {}, {.doubled = k}});
  }
  all.push_back({"impact-missed", {}, {}, true});
  return all;
}

std::vector<Parameter> smooth_parameters(const model::ImpactProblem<>& problem) {
  std::vector<Parameter> all;
  for (int i = 0; i < int(problem.dof()); ++i) {
    all.push_back({Change::frequency, i});
    all.push_back({Change::damping, i});
  }
  // The ratio of velocities to displacements is that of the method's frequencies, so momentum is
  // off as with another mass.
  if (problem.dof() > 1 && !problem.contacts.empty())
    all.push_back({Change::mass_ratio, int(problem.dof()) - 1});
  return all;
}

Hypothesis hypothesis_of(const Parameter& parameter) {
  switch (parameter.change) {
    case Change::frequency:
      return {"frequency-differs", parameter};
    case Change::restitution:
      return {"restitution-differs", parameter};
    case Change::mass_ratio:
      return {"mass-ratio-differs", parameter};
    default:
      return {"damping-differs", parameter};
  }
}

bool equivalent(const Hypothesis& one, const Hypothesis& other, Eigen::Index dof) {
  if (&one == &other) return true;
  if (!one.parameter || !other.parameter) {
    // A system that never collides and one whose only impact is missed may be the same.
    return one.code.name() == other.code.name() && (one.no_contact || other.no_contact);
  }
  const auto a = *one.parameter, b = *other.parameter;
  if (one.code.name() == other.code.name() && (a.mass == b.mass || dof == 1)) return true;
  const auto scales = [](const Parameter& p) { return p.change == Change::time_scale; };
  return (scales(a) && is_frequency(other)) || (scales(b) && is_frequency(one));
}

}  // namespace clackers::diagnose
