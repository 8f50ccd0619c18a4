#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/campaign/specification.hpp"
#include "clackers/campaign/store.hpp"
#include "clackers/record/record.hpp"
#include "clackers/record/sheet.hpp"

// The atlas: the campaign that ships with the product, its page, and results of others in it.
namespace clackers::campaign {

/// The text of the specification that `clackers atlas` runs.
std::string_view atlas_specification();

/// The text of a specification with other methods on the same systems and ladder.
std::string with_methods(const std::string& text, std::span<const MethodEntry> methods);

/// Throws InputError, with the file's name, for a database whose rows no page can show: bad-syntax,
/// unknown-name, not-a-campaign.
void require_results(const Store& store);

/// The page of a campaign, with the databases of others beside it. `command` is what writes it,
/// "atlas"; `from` has the whole line. Throws InputError where no task is finished.
std::string campaign_page(const Store& store, std::span<const Store> others,
                          const std::string& command, const record::Provenance& from);

/// What `clackers verify` is given for the ladder of a specification: "--levels 5
/// --samples-per-level 4".
std::string ladder_options(const Ladder& ladder);

}  // namespace clackers::campaign
