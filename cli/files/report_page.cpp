#include "cli/files/report_page.hpp"

#include <fmt/format.h>

#include "cli/messages.hpp"

namespace clackers::cli {

ReportPage::ReportPage(const std::string& path, const CommonOptions& common,
                       OnInterrupt on_interrupt)
    : quiet_(common.quiet) {
  if (!path.empty()) file_ = std::make_unique<OutputFile>(path, on_interrupt);
}

bool ReportPage::write(const std::string& html) {
  return try_to_write([&] {
    file_->stream() << html;
    file_->commit();
    if (!quiet_) note(fmt::format("Wrote {}", file_->path()));
  });
}

}  // namespace clackers::cli
