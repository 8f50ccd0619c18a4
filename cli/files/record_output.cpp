#include "cli/files/record_output.hpp"

#include <sstream>

#include "cli/messages.hpp"

namespace clackers::cli {

RecordOutput::RecordOutput(const record::Record& record,
                           const std::optional<record::Record>& baseline,
                           const CommonOptions& options, const RecordView& view)
    : record_(record), quiet_(options.quiet), view_(view) {
  if (baseline) changes_ = study::compare(record, *baseline);
}

std::string RecordOutput::html() const { return report::html(record_, changes()); }

void RecordOutput::write(Results& to) const {
  auto style = to.style();
  style.all_metrics = view_.all_metrics;
  style.impacts = view_.impacts;
  style.only = view_.only;
  report::write(record_, to.format(), to.stream(), style, changes());
  to.finish();
}

void RecordOutput::note_changes(report::Format format) const {
  if (!changes_ || quiet_ || report::shows_changes(format)) return;
  std::ostringstream text;
  report::write_changes(*changes_, text, {});
  std::istringstream lines(text.str());
  for (std::string line; std::getline(lines, line);) note(line);
}

}  // namespace clackers::cli
