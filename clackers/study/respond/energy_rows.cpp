#include <memory>

#include "clackers/exact/quantities/energy.hpp"
#include "clackers/study/respond/timed_rows.hpp"

namespace clackers::study {

std::unique_ptr<RowSource> energies(const cases::Case& which, const TimeGrid& grid) {
  const auto& motion = closed_form(which, "the energy");
  require_inside(which, grid);
  const auto account = std::make_shared<const exact::EnergyAccount>(motion);
  const std::vector<Column> columns{{"kinetic", "J", "of all masses"},
                                    {"potential", "J", "in the springs"},
                                    {"dissipated", "J", "by the dashpots so far"},
                                    {"lost", "J", "at impacts so far"},
                                    {"total", "J", "the sum of the four: what was there at t = 0"},
                                    {"momentum", "kg m/s", "of all masses"}};
  return std::make_unique<TimedRows>(
      motion, grid, "clackers/energy/1", "Energy of " + which.entry->name, columns, 64,
      one_by_one([account](double t, model::Side side, double* row) {
        const auto split = account->at(t, side);
        for (const double value : {split.kinetic, split.potential, split.dissipated, split.lost,
                                   split.total(), account->momentum(t, side)})
          *row++ = value;
      }));
}

}  // namespace clackers::study
