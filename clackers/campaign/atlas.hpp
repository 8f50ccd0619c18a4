#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/campaign/specification.hpp"
#include "clackers/campaign/store.hpp"
#include "clackers/record/provenance.hpp"
#include "clackers/record/sheet.hpp"

// The atlas: the campaign that ships with the product, its page, and results of others in it.
namespace clackers::campaign {

/// The text of the specification that `clackers atlas` runs.
std::string_view atlas_specification();

/// The text of a specification with other methods on the same systems and ladder.
std::string with_methods(const std::string& text, std::span<const MethodEntry> methods);

/// Results that another atlas can take in: the finished tasks of a campaign with what is needed to
/// compute them again.
struct AtlasResults {
  std::string origin;                        ///< who computed them
  record::Provenance from;                   ///< with what, where and when
  std::string options;                       ///< of `clackers verify`, for the same steps
  std::map<std::string, std::string> calls;  ///< see report::AtlasPart
  std::string specification;
  record::Sheet subjects, runs;
};
AtlasResults results_of(const Store& store, const std::string& origin,
                        const record::Provenance& from);

/// Results as the text of a json file, schema "clackers/atlas-results/1", and back; `name` stands in
/// messages. Throws InputError for what is no such file: bad-syntax, not-a-campaign, other-version.
std::string results_text(const AtlasResults& results);
AtlasResults results_from(const std::string& text, const std::string& name);

/// The page of a campaign, with the results of others beside it. `command` is what writes it, "atlas";
/// `from` has the whole line. Throws InputError where no task is finished.
std::string campaign_page(const Store& store, std::span<const AtlasResults> others,
                          const std::string& command, const record::Provenance& from);

}  // namespace clackers::campaign
