#pragma once

// The solvers of tests/foreign on the problems of cases, for tests only: nothing of them comes from
// methods/.

#include <algorithm>
#include <cmath>
#include <string>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/trajectory.hpp"
#include "tests/foreign/printed.hpp"

namespace clackers::diagnose::testing {

/// Rows at n h up to the problem's end of the solver of these words (tests/foreign/README.md):
/// "method=rk4 contact=linear". One or two masses that are not coupled, and one contact at most.
inline model::Trajectory history_of(const std::string& words, const model::ImpactProblem<>& problem,
                                    double h) {
  const auto two = problem.dof() == 2;
  const auto diagonal = [&](const Eigen::MatrixXd& m, double single) {
    return foreign::Mat{m(0, 0), 0.0, 0.0, two ? m(1, 1) : single};
  };
  const auto entries = [&](const Eigen::VectorXd& x) {
    return foreign::Vec{x[0], two ? x[1] : 0.0};
  };
  const foreign::Options options(words);
  foreign::System s;
  s.M = diagonal(problem.system.mass, 1.0);
  s.C = diagonal(problem.system.damping, 0.0);
  s.K = diagonal(problem.system.stiffness, 1.0);
  s.u0 = entries(problem.start.u);
  s.v0 = entries(problem.start.v);
  s.end = problem.end;
  foreign::change(s, options);
  if (problem.contacts.empty()) {
    s.contact = false;
  } else {
    s.normal = entries(problem.contacts[0].direction);
    s.clearance -= problem.contacts[0].gap;
    s.eta = problem.contacts[0].restitution;
  }
  foreign::History history;
  const auto n = static_cast<long>(std::floor(problem.end / h * (1.0 + 1e-12)));
  model::Trajectory rows;
  rows.dof = int(problem.dof());
  for (const auto& row : foreign::printed_rows(s, options, h, n, history)) {
    if (!std::isfinite(row.u.x + row.u.y)) break;
    rows.t.push_back(std::min(row.t, problem.end));
    rows.u.push_back(row.u.x);
    rows.v.push_back(row.v.x);
    if (two) rows.u.push_back(row.u.y);
    if (two) rows.v.push_back(row.v.y);
  }
  return rows;
}

}  // namespace clackers::diagnose::testing
