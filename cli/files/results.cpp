#include "cli/files/results.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "clackers/base/error.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/progress_line.hpp"

namespace clackers::cli {
namespace {

std::unique_ptr<OutputFile> file_of(const std::string& path, OnInterrupt on_interrupt) {
  if (path.empty()) return nullptr;
  if (path == "-")
    throw InputError("--out - is no file; without --out the result goes to standard output.",
                     "bad-syntax");
  return std::make_unique<OutputFile>(path, on_interrupt);
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

Results::Results(const CommonOptions& options, OnInterrupt on_interrupt, report::Content content)
    : format_(report::format_from(options.format, content)),
      quiet_(options.quiet),
      file_(file_of(options.out, on_interrupt)) {
  if (file_) return;
  standard_ = std::make_unique<OutputStream>(STDOUT_FILENO, "standard output", on_interrupt);
  style_ = standard_style(options.no_color);
}

std::ostream& Results::stream() { return file_ ? file_->stream() : *standard_; }

bool Results::is_terminal() const { return !file_ && ::isatty(STDOUT_FILENO) != 0; }

void Results::finish() {
  if (!file_) return standard_->finish();
  file_->commit();
  if (!quiet_) note(fmt::format("Wrote {}", file_->path()));
}

void write_rows(record::RowSource& rows, Results& results, const std::string& command, bool quiet) {
  // Rows on a terminal show the progress themselves.
  ProgressLine line(command, quiet || results.is_terminal());
  rows.progress = [&](double share) {
    if (interrupt_flag()) throw Interrupted();
    line.report(share);
  };
  report::write(rows, results.format(), results.stream(), results.style());
}

report::Style standard_style(bool no_color) {
  report::Style style;
  if (::isatty(STDOUT_FILENO) == 0) return style;
  const char* term = std::getenv("TERM");
  style.color = !no_color && !is_set("NO_COLOR") && std::string_view(term ? term : "") != "dumb";
  struct winsize window {};
  // Narrower than 40 is a terminal that does not know its width.
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col >= 40)
    style.width = window.ws_col;
  return style;
}

}  // namespace clackers::cli
