#include "clackers/campaign/tasks/prepared_system.hpp"

#include <utility>

#include "clackers/cases/case.hpp"

namespace clackers::campaign {
namespace {

study::SystemStudy::Subject subject_of(const MethodEntry& method,
                                       const std::optional<solvers::SolverSubject>& solver) {
  if (solver) return &*solver;
  return method.text;
}

}  // namespace

PreparedSystem::PreparedSystem(const Specification& specification, System system)
    : system_(std::move(system)) {
  study::SystemRequest request;
  request.plan = specification.ladder();
  request.metrics = !specification.metrics().empty();
  request.times = specification.times_runs();
  try {
    study_.emplace(request, cases::make(system_.name, system_.settings));
  } catch (const InputError& error) {
    refusal_ = error;
  }
}

const record::CaseRecord* PreparedSystem::assess(
    const MethodEntry& method, const std::optional<solvers::SolverSubject>& solver,
    const std::atomic<bool>* interrupt) {
  const auto& name = solver ? solver->name : method.name;
  if (!study_) return refused(name, *refusal_);
  try {
    return study_->assess(subject_of(method, solver), interrupt);
  } catch (const InputError& error) {
    return refused(name, error);
  }
}

study::CostEstimate PreparedSystem::estimate(const MethodEntry& method,
                                             const std::optional<solvers::SolverSubject>& solver,
                                             bool timed) {
  if (!study_) return {};
  try {
    return study_->estimate(subject_of(method, solver), timed);
  } catch (const InputError&) {
    return {};
  }
}

const record::CaseRecord* PreparedSystem::refused(std::string name, const InputError& why) {
  record_ = study::refused_record(system_.name, std::move(name), why);
  return &record_;
}

}  // namespace clackers::campaign
