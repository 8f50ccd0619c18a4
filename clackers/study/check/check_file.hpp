#pragma once

#include <atomic>

#include "clackers/study/check.hpp"

namespace clackers::study {

/// One history of a request before it is read.
struct CheckTask {
  std::string file;
  std::string events;  ///< empty: none given
  double step = 0.0;   ///< of --steps [s], 0: not given
};

/// Reads one history and judges it against the case, all metrics included. Throws as check() does.
CheckedFile check_file(const CheckTask& task, const std::vector<std::string>& columns,
                       const cases::Case& which, const CaseSummary& summary,
                       const std::atomic<bool>* interrupt);

}  // namespace clackers::study
