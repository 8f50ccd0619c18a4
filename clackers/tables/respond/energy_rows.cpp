#include <memory>

#include "clackers/exact/quantities/energy.hpp"
#include "clackers/tables/times/energy_balance.hpp"
#include "clackers/tables/times/timed_rows.hpp"

namespace clackers::tables {
namespace {

// `account` has the split and the momentum at t.
template <class Account>
std::unique_ptr<record::RowSource> rows_of(const cases::Case& test_case, const TimeGrid& grid,
                                           std::shared_ptr<const Account> account, bool has_work) {
  std::vector<record::Column> columns{
      {"kinetic", "J", "of all masses"},
      {"potential", "J", "in the springs and of constant loads, 0 where nothing is displaced"},
      {"dissipated", "J", "by dashpots and friction so far"},
      {"lost", "J", "at impacts so far"}};
  if (has_work) columns.push_back({"work", "J", "of loads that vary and of belts so far"});
  columns.push_back({"total", "J",
                     has_work ? "the sum of the first four less the work: what was there at t = 0"
                              : "the sum of the four: what was there at t = 0"});
  columns.push_back({"momentum", "kg m/s", "of all masses"});
  return std::make_unique<TimedRows>(
      *test_case.motion, grid, "clackers/energy/1", "Energy of " + test_case.entry->name, columns,
      64, one_by_one([account, has_work](double t, model::Side side, double* row) {
        const auto split = account->at(t, side);
        for (const double value : {split.kinetic, split.potential, split.dissipated, split.lost})
          *row++ = value;
        if (has_work) *row++ = split.work;
        *row++ = split.total();
        *row = account->momentum(t, side);
      }));
}

}  // namespace

std::unique_ptr<record::RowSource> energies(const cases::Case& test_case, const TimeGrid& grid) {
  require_inside(test_case, grid);
  if (const auto* motion = exact::as_closed_form(*test_case.motion))
    return rows_of(test_case, grid, std::make_shared<const exact::EnergyAccount>(*motion), false);
  const auto balance = std::make_shared<const EnergyBalance>(test_case, grid.latest());
  return rows_of(test_case, grid, balance, balance->has_work());
}

}  // namespace clackers::tables
