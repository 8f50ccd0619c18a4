#include <fmt/format.h>

#include "clackers/base/error.hpp"
#include "clackers/campaign/atlas.hpp"
#include "clackers/record/record.hpp"
#include "cli/commands/campaign/campaign_actions.hpp"
#include "cli/files/output_file.hpp"
#include "cli/messages.hpp"

namespace clackers::cli {

int report_campaign(const CampaignOptions& options, const std::string& line) {
  if (options.common.out.empty())
    throw InputError(fmt::format("campaign report writes a page: give it with --out. For example: "
                                 "clackers campaign report {} --out page.html",
                                 options.files.front()),
                     "bad-syntax");
  const auto store = open_database(options.files.front());
  OutputFile file(options.common.out, OnInterrupt::stop);
  file.stream() << campaign::campaign_page(store, {}, "campaign report", record::provenance(line));
  file.commit();
  if (!options.common.quiet) note(fmt::format("Wrote {}", options.common.out));
  return 0;
}

}  // namespace clackers::cli
