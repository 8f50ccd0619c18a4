#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/study/subject_study.hpp"

namespace clackers::study {

/// The subjects of one case.
struct CaseStudy {
  const StudyCase* problem;
  record::RefinementPlan steps;
  std::vector<std::unique_ptr<SubjectStudy>> subjects;
};

/// Runs, assesses, refines within `budget` [s] and explains the studies of all cases: one scheduler, one budget,
/// so many threads. False when the refinement was interrupted.
bool run_studies(std::vector<CaseStudy>& cases, double budget, int threads,
                 const Progress& progress, const std::atomic<bool>* interrupt);

}  // namespace clackers::study
