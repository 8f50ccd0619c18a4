#pragma once

#include <memory>

#include "clackers/study/candidate.hpp"

namespace clackers::study {

/// A program or a callable, judged by the histories that it makes.
class SolverCandidate : public Candidate {
 public:
  /// Prepares the solver for the case. Both must outlive the candidate.
  SolverCandidate(const solvers::SolverSubject& asked, const StudyCase& problem);

  CandidateFacts facts() const override;
  void expect(std::span<const RunTask> tasks) override;
  double cost(const RunTask& task) const override;
  std::optional<Measured> run(const RunTask& task, TaskShare& share,
                              const std::atomic<bool>* interrupt) override;

 private:
  Measured compared(const RunTask& task, const solvers::SolverOutput& output,
                    const std::atomic<bool>* interrupt) const;

  const solvers::SolverSubject& asked_;
  const StudyCase& problem_;
  std::unique_ptr<solvers::Solver> solver_;
};

}  // namespace clackers::study
