#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "clackers/base/error.hpp"
#include "clackers/campaign/specification.hpp"
#include "clackers/solvers/solver.hpp"
#include "clackers/study/system_study.hpp"

namespace clackers::campaign {

/// A system ready to run, or why it is none.
class PreparedSystem {
 public:
  PreparedSystem(const Specification& specification, System system);

  const System& system() const { return system_; }

  /// A record with one subject, valid until the next call; nullptr when interrupted. `solver` is there
  /// for a method that is none of the catalogue.
  const record::CaseRecord* assess(const MethodEntry& method,
                                   const std::optional<solvers::SolverSubject>& solver,
                                   const std::atomic<bool>* interrupt);
  study::CostEstimate estimate(const MethodEntry& method,
                               const std::optional<solvers::SolverSubject>& solver, bool timed);

 private:
  const record::CaseRecord* refused(std::string name, const InputError& why);

  System system_;
  std::optional<study::SystemStudy> study_;
  std::optional<InputError> refusal_;
  record::CaseRecord record_;  // of what was refused
};

}  // namespace clackers::campaign
