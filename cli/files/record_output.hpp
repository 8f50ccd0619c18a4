#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clackers/report/write.hpp"
#include "clackers/study/baseline.hpp"
#include "cli/files/paths.hpp"
#include "cli/files/results.hpp"

namespace clackers::cli {

/// The record of --baseline, which is of the same study; nothing for an empty path. Called before the
/// work: what cannot be compared must not be found out afterwards. Throws as read_record() and
/// study::require_same_study do.
std::optional<record::Record> baseline_of(const std::string& path, const auto& request) {
  if (path.empty()) return {};
  auto baseline = read_record(path, "baseline");
  study::require_same_study(request, baseline);
  return baseline;
}

/// What tables on a terminal show of a record.
struct RecordView {
  bool all_metrics = false, impacts = false;
  std::vector<std::string> only{};  ///< verdicts; empty: all
};

/// A record of verify or check with what changed since its baseline. The record must outlive it.
class RecordOutput {
 public:
  RecordOutput(const record::Record& record, const std::optional<record::Record>& baseline,
               const CommonOptions& options, const RecordView& view = {});

  std::string html() const;
  void write(Results& to) const;
  /// On standard error, where the format has no place for changes.
  void note_changes(report::Format format) const;

 private:
  const study::BaselineComparison* changes() const { return changes_ ? &*changes_ : nullptr; }

  const record::Record& record_;
  std::optional<study::BaselineComparison> changes_;
  bool quiet_;
  RecordView view_;
};

}  // namespace clackers::cli
