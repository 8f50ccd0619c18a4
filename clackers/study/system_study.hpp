#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "clackers/base/error.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/record/record.hpp"
#include "clackers/solvers/solver.hpp"
#include "clackers/study/refinement.hpp"
#include "clackers/study/subject_study.hpp"

namespace clackers::study {

/// How methods and solvers are assessed on a system.
struct SystemRequest {
  RefinementRequest plan{};  ///< what is not given follows the system, and the kind of the subject
  bool metrics = false;      ///< of one run of each method
  bool times = false;  ///< each run made again for its processor time; else that of run and errors
};

/// What a method costs on a system.
struct CostEstimate {
  std::size_t runs = 0;
  double seconds = 0.0;  ///< processor time of all runs, from that of the first [s]
};

/// One system, prepared once, whose methods and solvers are assessed one after another on one thread,
/// without refinement, and without what only a record shows: curves, self-convergence, profiles.
/// Numbers are those of verify().
class SystemStudy {
 public:
  /// Throws InputError for steps that verify() refuses.
  SystemStudy(const SystemRequest& request, cases::Case problem);
  SystemStudy(const SystemStudy&) = delete;
  SystemStudy& operator=(const SystemStudy&) = delete;

  /// A method of the catalogue, by its specification, or a solver.
  using Subject = std::variant<std::string, const solvers::SolverSubject*>;

  /// The case with that subject, valid until the next call; nullptr when interrupted. A method that
  /// objects has its refusal. Throws InputError as verify() does.
  const record::CaseRecord* assess(const Subject& subject,
                                   const std::atomic<bool>* interrupt = nullptr);
  /// What assess() would do; `seconds` only where `timed`: one run is made then, the shortest.
  CostEstimate estimate(const Subject& subject, bool timed);

 private:
  std::unique_ptr<SubjectStudy> study_of(const Subject& subject) const;

  SystemRequest request_;
  StudyCase problem_;
  record::CaseRecord record_;
};

/// The record of a system that was refused as a whole: only the names, and why.
record::CaseRecord refused_record(std::string_view case_name, std::string subject_name,
                                  const InputError& why);

/// The name that a method of the catalogue has in every output.
std::string subject_name(const std::string& method);

}  // namespace clackers::study
