#include "clackers/model/trajectory.hpp"

namespace clackers::model {
namespace {

void append(std::vector<double>& to, std::span<const double> from) {
  to.insert(to.end(), from.begin(), from.end());
}

std::vector<double> copy(std::span<const double> from) { return {from.begin(), from.end()}; }

}  // namespace

TrajectorySink::TrajectorySink(bool impacts_are_reported) {
  if (impacts_are_reported) trajectory_.impacts.emplace();
}

bool TrajectorySink::take(const SampleBlock& block) {
  trajectory_.dof = block.dof;
  append(trajectory_.t, block.t);
  append(trajectory_.u, block.u);
  append(trajectory_.v, block.v);
  return true;
}

bool TrajectorySink::take(const ReportedImpact& impact) {
  if (!trajectory_.impacts) trajectory_.impacts.emplace();
  trajectory_.impacts->push_back({impact.t, impact.contact, copy(impact.u), copy(impact.v_before),
                                  copy(impact.v_after), impact.impulse});
  return true;
}

}  // namespace clackers::model
