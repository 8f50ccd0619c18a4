#pragma once

#include <memory>
#include <string>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/study/candidate.hpp"

namespace clackers::study {

/// What is made of the runs of methods beside their errors.
struct Extras {
  bool record = true;  ///< what only a record shows: motions, self-convergence
  bool times = true;   ///< each run made again for its processor time
};

/// The sentence of an objection without the name of the method, beside which it stands.
std::string objection_text(const methods::Method& method, const methods::Objection& objection);

/// Bins of the error against time of the run that is shown.
inline constexpr int history_bins = 400;

/// A method of the catalogue on a case.
class MethodCandidate : public Candidate {
 public:
  /// `tolerances` are the levels of an adaptive method. A method that objects to the case has its
  /// refusal. The case must outlive the candidate.
  MethodCandidate(std::shared_ptr<const methods::Method> method, const StudyCase& problem,
                  const std::vector<double>& tolerances, const Extras& extras);

  CandidateFacts facts() const override { return facts_; }
  double cost(const RunTask& task) const override;
  /// Measures the errors of a run and, if it finished, makes it again without for its processor time
  /// (short runs several times, for a time that the clock resolves), unless the extras leave that
  /// out: the time is then that of the run with its errors. What other methods have in common with this
  /// one is measured once.
  std::optional<Measured> run(const RunTask& task, TaskShare& share,
                              const std::atomic<bool>* interrupt) override;

 private:
  std::optional<Measured> measured(model::Run& run, const RunTask& task, TaskShare& share,
                                   const std::atomic<bool>* interrupt) const;
  std::optional<Measured> observed(model::Run& run, const RunTask& task, TaskShare& share,
                                   const std::atomic<bool>* interrupt) const;

  const StudyCase& problem_;
  std::shared_ptr<const methods::Method> method_;
  Extras extras_;
  CandidateFacts facts_;
  bool reports_impacts_ = true;
  std::string shared_run_;
  double spring_time_ = 0.0;  // contact time of a linear contact spring [s]; 0: it has none
};

}  // namespace clackers::study
