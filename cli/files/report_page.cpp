#include "cli/files/report_page.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "clackers/base/error.hpp"
#include "cli/messages.hpp"

namespace clackers::cli {

ReportPage::ReportPage(const std::string& path, const CommonOptions& common,
                       OnInterrupt on_interrupt, std::string_view option)
    : quiet_(common.quiet) {
  const auto ending = std::filesystem::path(path).extension();
  if (!ending.empty() && ending != ".html" && ending != ".htm")
    refuse("clackers", option, path, "a page: FILE.html",
           fmt::format("Its figures are saved as SVG or PNG by their buttons, and a browser prints "
                       "it to PDF{}.",
                       option == "--report" ? "; tables: --format with --out" : ""),
           "bad-syntax");
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
