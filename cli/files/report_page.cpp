#include "cli/files/report_page.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "clackers/base/error.hpp"
#include "cli/messages.hpp"
#include "cli/survived.hpp"

namespace clackers::cli {

ReportPage::ReportPage(const std::string& command, const std::string& path,
                       const CommonOptions& common, OnInterrupt on_interrupt)
    : quiet_(common.quiet) {
  if (path.empty()) return;
  const auto absolute = [](const std::string& given) {
    return std::filesystem::absolute(given).lexically_normal();
  };
  if (!common.out.empty() && absolute(path) == absolute(common.out))
    throw InputError(command + " --report and --out name the same file; give each its own.",
                     "bad-syntax");
  file_ = std::make_unique<OutputFile>(path, on_interrupt);
}

bool ReportPage::write(const std::string& html) {
  return survived([&] {
    file_->stream() << html;
    file_->commit();
    if (!quiet_) note(fmt::format("Wrote {}", file_->path()));
  });
}

}  // namespace clackers::cli
