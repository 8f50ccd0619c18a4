#include "clackers/tables/times/running_integral.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "clackers/base/constants.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::tables {

using Eigen::VectorXd;
using model::Side;

namespace {

// Lobatto's rule of ten points on [-1, 1], exact up to degree 17; a bend beside an end is seen from the end.
constexpr std::array<double, 10> nodes{-1.0,
                                       -0.9195339081664589,
                                       -0.7387738651055050,
                                       -0.4779249498104445,
                                       -0.1652789576663870,
                                       0.1652789576663870,
                                       0.4779249498104445,
                                       0.7387738651055050,
                                       0.9195339081664589,
                                       1.0};
constexpr std::array<double, 5> weights{1.0 / 45.0, 0.1333059908510701, 0.2248893420631264,
                                        0.2920426836796838, 0.3275397611838976};

// No more are halved: where states are less smooth than rounding explains, the total shows what is left out.
constexpr std::size_t most_intervals = 1'000'000;

double fastest_of(const model::ImpactProblem<>& problem) {
  const auto& system = problem.system;
  Eigen::MatrixXd stiffness = system.stiffness;  // with all springs closed
  if (const auto* springs = model::one_sided_springs(problem))
    for (std::size_t i = 0; i < springs->contacts().size(); ++i) {
      const auto& direction = springs->contacts()[i].direction;
      stiffness += springs->stiffnesses()[i] * direction * direction.transpose();
    }
  double fastest =
      std::max(std::sqrt(std::max(0.0, numerics::highest_square(stiffness, system.mass))),
               numerics::highest_square(system.damping, system.mass));
  if (const auto* load = system.add_load.target<model::HarmonicLoad>())
    for (const auto& f : load->forces()) fastest = std::max(fastest, f.frequency);
  return fastest;
}

}  // namespace

RunningIntegral::RunningIntegral(const cases::Case& test_case, Rates rates,
                                 const std::vector<double>& breaks, double until, VectorXd largest)
    : rates_(std::move(rates)),
      largest_(std::move(largest)),
      sum_(VectorXd::Zero(largest_.size())),
      dof_(double(test_case.motion->dof())),
      fastest_(fastest_of(test_case.problem)) {
  std::vector<double> list{0.0};
  for (const double t : breaks)
    if (t > list.back() && t < until) list.push_back(t);
  list.push_back(until);
  for (std::size_t k = 0; k + 1 < list.size(); ++k) {
    const double parts = std::max(1.0, std::ceil((list[k + 1] - list[k]) * fastest_));
    double from = list[k];
    for (double part = 1.0; part <= parts; part += 1.0) {
      const double to =
          part == parts ? list[k + 1] : list[k] + (list[k + 1] - list[k]) * (part / parts);
      add(from, to, over(from, to));
      from = to;
    }
  }
  intervals_.push_back({until, sum_});
}

void RunningIntegral::add(double from, double to, const VectorXd& whole) {
  const double middle = from + 0.5 * (to - from);
  const VectorXd left = over(from, middle), right = over(middle, to);
  // Rounding of the sum over the masses, and of the phases, which are off by epsilon times themselves.
  const double enough = epsilon * (dof_ + 4.0 + fastest_ * to);
  if (intervals_.size() < most_intervals && to - from > 64.0 * epsilon * to &&
      ((left + right - whole).cwiseAbs().array() > enough * largest_.array()).any()) {
    add(from, middle, left);
    add(middle, to, right);
    return;
  }
  for (const auto& [start, part] : {std::pair(from, left), std::pair(middle, right)}) {
    intervals_.push_back({start, sum_});
    sum_ += part;
  }
}

VectorXd RunningIntegral::over(double from, double to) const {
  const double half = 0.5 * (to - from);
  VectorXd sum = VectorXd::Zero(sum_.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double t = nodes[i] < 0.0 ? from + half * (1.0 + nodes[i]) : to - half * (1.0 - nodes[i]),
                 weight = half * weights[std::min(i, nodes.size() - 1 - i)];
    sum += weight * rates_(t, nodes[i] < 1.0 ? Side::right : Side::left);
  }
  return sum;
}

VectorXd RunningIntegral::at(double t) const {
  const auto& interval = *(std::ranges::upper_bound(intervals_, t, {}, &Interval::from) - 1);
  if (interval.from < t) return interval.before + over(interval.from, t);
  return interval.before;
}

}  // namespace clackers::tables
