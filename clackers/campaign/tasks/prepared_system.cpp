#include "clackers/campaign/tasks/prepared_system.hpp"

#include <utility>

#include "clackers/cases/case.hpp"

namespace clackers::campaign {
namespace {

study::RefinementRequest ladder_of(const Ladder& asked, bool is_solver) {
  study::RefinementRequest ladder{asked.coarsest, asked.levels};
  if (is_solver && !ladder.levels) ladder.levels = study::default_solver_levels;
  const int samples =
      is_solver ? study::default_solver_samples : study::RefinementRequest{}.samples_per_level;
  ladder.samples_per_level = asked.neighbours.value_or(samples);
  return ladder;
}

}  // namespace

PreparedSystem::PreparedSystem(const Specification& specification, System system)
    : specification_(specification), system_(std::move(system)) {
  study::SystemRequest request;
  request.plan = ladder_of(specification.ladder(), false);
  request.tolerances = specification.ladder().tolerances;
  request.metrics = !specification.metrics().empty();
  request.times = specification.times_runs();
  try {
    study_.emplace(request, cases::make(system_.name, system_.settings));
  } catch (const InputError& error) {
    refusal_ = error;
  }
}

const record::CaseRecord* PreparedSystem::assess(const MethodEntry& method,
                                                 const std::optional<study::SolverSubject>& solver,
                                                 const std::atomic<bool>* interrupt) {
  const auto& name = solver ? solver->name : method.name;
  if (!study_) return refused(name, *refusal_);
  try {
    return solver ? study_->assess(*solver, ladder_of(specification_.ladder(), true), interrupt)
                  : study_->assess(method.text, interrupt);
  } catch (const InputError& error) {
    return refused(name, error);
  }
}

study::CostEstimate PreparedSystem::estimate(const MethodEntry& method,
                                             const std::optional<study::SolverSubject>& solver,
                                             bool timed) {
  if (!study_) return {};
  try {
    return solver ? study_->estimate(*solver, ladder_of(specification_.ladder(), true), timed)
                  : study_->estimate(method.text, timed);
  } catch (const InputError&) {
    return {};
  }
}

const record::CaseRecord* PreparedSystem::refused(std::string name, const InputError& why) {
  record_ = study::refused_record(system_.name, std::move(name), why);
  return &record_;
}

}  // namespace clackers::campaign
