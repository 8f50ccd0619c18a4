#include <fmt/format.h>

#include <deque>
#include <filesystem>

#include "clackers/campaign/atlas.hpp"
#include "clackers/campaign/atlas/results.hpp"
#include "clackers/report/atlas.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::campaign {
namespace {

std::string heading_of(const Store& store, const std::string& command) {
  if (command == "atlas") return "Atlas of methods through impacts";
  return fmt::format("Campaign {}", std::filesystem::path(store.path()).stem().string());
}

std::string lead_of(const Store& store, std::size_t others) {
  const auto& specification = store.specification();
  const auto finished = store.finished().size();
  auto lead =
      fmt::format("{} on {}.", report::counted(std::ssize(specification.methods()), "method"),
                  report::counted(specification.systems(), "system"));
  if (finished < specification.tasks())
    lead += fmt::format(" {} of {} tasks are finished.", finished, specification.tasks());
  if (others > 0)
    lead +=
        fmt::format(" With {} of others.", report::counted(static_cast<long long>(others), "file"));
  return lead;
}

report::AtlasPart part_of(const AtlasResults& results, record::RowSource& runs) {
  return {&results.subjects, &runs, results.origin, results.from, results.options, results.calls};
}

}  // namespace

std::string campaign_page(const Store& store, std::span<const AtlasResults> others,
                          const std::string& command, const record::Provenance& from) {
  const auto& specification = store.specification();
  report::require_few_cells(store.finished().size());  // before they are read
  const auto subjects = sheet_of(*store.rows(TableName::subjects));
  const auto runs = store.rows(TableName::runs);
  std::vector<report::AtlasPart> parts{{&subjects,
                                        runs.get(),
                                        {},
                                        from,
                                        ladder_options(specification.ladder()),
                                        calls_of(specification, subjects)}};
  std::deque<record::SheetRows> sheets;
  for (const auto& results : others)
    parts.push_back(part_of(results, sheets.emplace_back(results.runs)));
  return report::atlas_page(parts, {command, heading_of(store, command),
                                    lead_of(store, others.size()), specification.text(), from});
}

}  // namespace clackers::campaign
