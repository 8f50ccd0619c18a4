#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "clackers/study/candidate.hpp"

namespace clackers::study {

/// What was measured of the runs of a case that several methods make alike, by Method::shared_run() and
/// what was asked of the run. From any thread; two that ask at once may both make a run.
class SharedRuns {
 public:
  using Key = std::tuple<std::string, double, bool, bool, bool>;
  static Key key(std::string name, const RunTask& task) {
    return {std::move(name), task.resolution(), task.wanted.history_bins > 0, task.wanted.metrics,
            task.wanted.observation};
  }

  std::optional<Measured> find(const Key& key) const {
    const std::lock_guard lock(guard_);
    const auto kept = kept_.find(key);
    return kept == kept_.end() ? std::nullopt : std::optional(kept->second);
  }
  void keep(Key key, const Measured& measured) {
    const std::lock_guard lock(guard_);
    kept_.emplace(std::move(key), measured);
  }

 private:
  mutable std::mutex guard_;
  std::map<Key, Measured> kept_;
};

}  // namespace clackers::study
