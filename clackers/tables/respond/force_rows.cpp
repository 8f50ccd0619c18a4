#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <memory>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/model/forces.hpp"
#include "clackers/tables/times/running_integral.hpp"
#include "clackers/tables/times/timed_rows.hpp"

namespace clackers::tables {
namespace {

using Eigen::VectorXd;
using model::Side;

constexpr long long most_impacts = 1'000'000;

// The impulses of contacts and one-sided springs up to a time: those of impacts and the integral of the force.
class ContactImpulses {
 public:
  ContactImpulses(const cases::Case& test_case, double until)
      : motion_(*test_case.motion), zero_(VectorXd::Zero(count_of(test_case.problem))) {
    add_impacts(test_case, until);
    if (motion_.closed_contacts().empty() && model::force_counts(test_case.problem).springs == 0)
      return;
    std::vector<double> breaks;
    for (const auto& impact : impacts_) breaks.push_back(impact.t);
    for (const auto& closed : motion_.closed_contacts())
      breaks.insert(breaks.end(), {closed.from, closed.until});
    std::ranges::sort(breaks);
    const double momentum = (test_case.problem.system.mass.cwiseAbs() * motion_.peak().v).sum();
    flow_.emplace(
        test_case,
        [&problem = test_case.problem, &motion = motion_, n = zero_.size()](double t, Side side) {
          return VectorXd(model::forces(problem, motion, t, side).head(n));
        },
        breaks, until, VectorXd::Constant(zero_.size(), momentum));
  }
  static Eigen::Index count_of(const model::ImpactProblem<>& problem) {
    const auto counts = model::force_counts(problem);
    return counts.contacts + counts.springs;
  }

  VectorXd at(double t, Side side) const {
    VectorXd sum = flow_ ? flow_->at(t) : zero_;
    const auto next = side == Side::left ? std::ranges::lower_bound(impacts_, t, {}, &Impact::t)
                                         : std::ranges::upper_bound(impacts_, t, {}, &Impact::t);
    if (next != impacts_.begin()) sum += (next - 1)->sum;
    return sum;
  }

 private:
  struct Impact {
    double t = 0.0;
    VectorXd sum;  ///< of impulses up to it and its own
  };

  void add_impacts(const cases::Case& test_case, double until) {
    const auto& problem = test_case.problem;
    const auto count = motion_.impact_count(until);
    if (count > most_impacts)
      throw InputError(
          fmt::format(
              "respond: forces are given with impulses, of at most {} impacts; {} has {} up to t = "
              "{} s. End the times earlier.",
              most_impacts, test_case.entry->name, count, until),
          "out-of-range");
    for (long long k = 1; k <= count; ++k) {
      const auto impact = motion_.impact(k);
      if (impacts_.empty() || impacts_.back().t != impact.t) impacts_.push_back({impact.t, zero_});
      impacts_.back().sum[impact.contact] += impact.impulse;
    }
    // Impacts that accumulate and are not resolved are one, where the motion takes the contact for closed.
    for (const auto& closed : motion_.closed_contacts())
      if (closed.accumulates && closed.resolved <= until &&
          std::ranges::find(impacts_, closed.resolved, &Impact::t) == impacts_.end())
        impacts_.push_back({closed.resolved, zero_});
    std::ranges::stable_sort(impacts_, {}, &Impact::t);
    for (auto& impact : impacts_) add_held(problem, impact);
    for (std::size_t k = 1; k < impacts_.size(); ++k) impacts_[k].sum += impacts_[k - 1].sum;
  }

  // What the impulses listed leave of the momenta comes from the contacts that are closed then.
  void add_held(const model::ImpactProblem<>& problem, Impact& impact) const {
    std::vector<Eigen::Index> held;
    for (const auto& closed : motion_.closed_contacts())
      if ((closed.accumulates ? closed.resolved : closed.from) <= impact.t &&
          impact.t <= closed.until && impact.sum[closed.contact] == 0.0)
        held.push_back(closed.contact);
    if (held.empty()) return;
    Eigen::MatrixXd directions(motion_.dof(), Eigen::Index(problem.contacts.size()));
    for (std::size_t i = 0; i < problem.contacts.size(); ++i)
      directions.col(Eigen::Index(i)) = problem.contacts[i].direction;
    const VectorXd jump = motion_.at(impact.t, Side::right).v - motion_.at(impact.t, Side::left).v,
                   left =
                       problem.system.mass * jump - directions * impact.sum.head(directions.cols());
    const VectorXd impulses =
        directions(Eigen::all, held).completeOrthogonalDecomposition().solve(left);
    for (std::size_t i = 0; i < held.size(); ++i) impact.sum[held[i]] = impulses[Eigen::Index(i)];
  }

  const model::Motion& motion_;
  const VectorXd zero_;
  std::vector<Impact> impacts_;
  std::optional<RunningIntegral> flow_;
};

}  // namespace

std::unique_ptr<record::RowSource> forces(const cases::Case& test_case, const TimeGrid& grid) {
  const auto& problem = test_case.problem;
  const auto counts = model::force_counts(problem);
  if (counts.all() == 0)
    throw InputError(
        fmt::format(
            "respond: forces are those of contacts, one-sided springs and dry friction; {} "
            "has none of them{}.",
            test_case.entry->name,
            problem.has_unstated_impacts() ? " but impacts, whose impulses --impacts has" : ""),
        "no-closed-form");
  require_inside(test_case, grid);
  const auto pushing = counts.contacts + counts.springs;
  std::vector<record::Column> columns;
  for (int i = 1; i <= pushing; ++i)
    columns.push_back(
        {fmt::format("force{}", i), "N",
         i <= counts.contacts
             ? fmt::format("of contact {} while it stays closed, along its direction", i)
             : fmt::format("of one-sided spring {} in compression, along its direction",
                           i - counts.contacts)});
  for (int i = 1; i <= pushing; ++i)
    columns.push_back({fmt::format("impulse{}", i), "N s",
                       fmt::format("so far, of force{} and of its impacts", i)});
  for (int i = 1; i <= counts.frictions; ++i)
    columns.push_back({fmt::format("friction{}", i), "N", "of dry friction, along its direction"});
  const auto known = std::make_shared<const ContactImpulses>(test_case, grid.latest());
  return std::make_unique<TimedRows>(
      *test_case.motion, grid, "clackers/forces/1", "Contact forces of " + test_case.entry->name,
      columns, 64, one_by_one([&test_case, known, pushing](double t, Side side, double* row) {
        const auto now = model::forces(test_case.problem, *test_case.motion, t, side);
        const auto impulses = known->at(t, side);
        row = std::copy_n(now.data(), pushing, row);
        row = std::copy_n(impulses.data(), pushing, row);
        std::copy(now.data() + pushing, now.data() + now.size(), row);
      }));
}

}  // namespace clackers::tables
