#include <algorithm>
#include <memory>

#include "clackers/exact/quantities/energy.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/tables/respond/timed_rows.hpp"

namespace clackers::tables {
namespace {

const record::Column kinetic{"kinetic", "J", "of all masses"};
const record::Column potential{"potential", "J", "in the springs"};
const record::Column lost{"lost", "J", "at impacts so far"};
const record::Column momentum{"momentum", "kg m/s", "of all masses"};

std::unique_ptr<record::RowSource> rows_of(const cases::Case& test_case, const TimeGrid& grid,
                                           const std::vector<record::Column>& columns,
                                           TimedRows::Fill fill) {
  return std::make_unique<TimedRows>(*test_case.motion, grid, "clackers/energy/1",
                                     "Energy of " + test_case.entry->name, columns, 64,
                                     std::move(fill));
}

// The energy that was lost at impacts. Impacts of one instant have the energies before and after all
// of them.
class LostEnergy {
 public:
  explicit LostEnergy(const model::Motion& motion) {
    const auto count = motion.impact_count(motion.end());
    for (long long k = 1; k <= count; ++k) {
      const auto impact = motion.impact(k);
      if (!t_.empty() && impact.t == t_.back()) continue;
      t_.push_back(impact.t);
      sum_.push_back(sum_.back() + impact.energy_before - impact.energy_after);
    }
  }
  double up_to(double t, model::Side side) const {
    const auto next = side == model::Side::left ? std::ranges::lower_bound(t_, t)
                                                : std::ranges::upper_bound(t_, t);
    return sum_[std::size_t(next - t_.begin())];
  }

 private:
  std::vector<double> t_, sum_{0.0};
};

std::unique_ptr<record::RowSource> sampled_energies(const cases::Case& test_case,
                                                    const TimeGrid& grid) {
  const auto& motion = *test_case.motion;
  const auto energy = std::make_shared<const measure::MechanicalEnergy>(test_case.problem.system);
  const auto at_impacts = std::make_shared<const LostEnergy>(motion);
  const Eigen::VectorXd mass = test_case.problem.system.mass.colwise().sum();
  return rows_of(
      test_case, grid, {kinetic, potential, lost, momentum},
      one_by_one([&motion, energy, at_impacts, mass](double t, model::Side side, double* row) {
        const auto now = motion.at(t, side);
        for (const double value : {energy->kinetic(now.v.data()), energy->potential(now.u.data()),
                                   at_impacts->up_to(t, side), mass.dot(now.v)})
          *row++ = value;
      }));
}

}  // namespace

std::unique_ptr<record::RowSource> energies(const cases::Case& test_case, const TimeGrid& grid) {
  require_inside(test_case, grid);
  const auto* motion = exact::as_closed_form(*test_case.motion);
  if (motion == nullptr) return sampled_energies(test_case, grid);
  const auto account = std::make_shared<const exact::EnergyAccount>(*motion);
  return rows_of(
      test_case, grid,
      {kinetic,
       potential,
       {"dissipated", "J", "by the dashpots so far"},
       lost,
       {"total", "J", "the sum of the four: what was there at t = 0"},
       momentum},
      one_by_one([account](double t, model::Side side, double* row) {
        const auto split = account->at(t, side);
        for (const double value : {split.kinetic, split.potential, split.dissipated, split.lost,
                                   split.total(), account->momentum(t, side)})
          *row++ = value;
      }));
}

}  // namespace clackers::tables
