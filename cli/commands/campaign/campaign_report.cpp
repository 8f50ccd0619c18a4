#include <fmt/format.h>

#include "clackers/base/error.hpp"
#include "clackers/campaign/atlas.hpp"
#include "clackers/record/record.hpp"
#include "cli/commands/campaign/campaign_actions.hpp"
#include "cli/files/report_page.hpp"

namespace clackers::cli {

int report_campaign(const CampaignOptions& options, const std::string& line) {
  if (options.common.out.empty())
    throw InputError(fmt::format("campaign report writes a page: give it with --out. For example: "
                                 "clackers campaign report {} --out page.html",
                                 options.files.front()),
                     "bad-syntax");
  const auto store = open_database(options.files.front());
  ReportPage page(options.common.out, options.common, OnInterrupt::stop, "--out");
  const auto html = campaign::campaign_page(store, {}, "campaign report", record::provenance(line));
  return page.write(html) ? 0 : 4;
}

}  // namespace clackers::cli
