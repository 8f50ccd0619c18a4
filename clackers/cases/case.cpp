#include "clackers/cases/case.hpp"

#include <algorithm>

#include "clackers/base/error.hpp"
#include "clackers/base/suggest.hpp"
#include "clackers/cases/builders.hpp"
#include "clackers/cases/parameters.hpp"

namespace clackers::cases {
namespace {

const Row& row(std::string_view name) {
  const auto found =
      std::ranges::find_if(table(), [&](const Row& one) { return one.entry.name == name; });
  if (found != table().end()) return *found;
  std::vector<std::string> names;
  for (const auto& one : table()) names.push_back(one.entry.name);
  refuse_name("case", name, names, "clackers list cases");
}

}  // namespace

std::span<const CaseEntry> entries() {
  static const auto all = [] {
    std::vector<CaseEntry> list;
    for (const auto& one : table()) list.push_back(one.entry);
    return list;
  }();
  return all;
}

std::string_view default_case() { return "three-parameter"; }

const CaseEntry& entry(std::string_view name) { return row(name).entry; }

Case make(std::string_view name, const Settings& settings, double threshold) {
  const auto& [entry, build] = row(name);
  if (!(threshold > 0.0 && threshold < 1.0))
    refuse(entry.name, "threshold", threshold, "0 < threshold < 1",
           "It is the share of the spectral peak from which a harmonic counts.");
  Case which;
  which.entry = &entry;
  which.values = complete(entry, settings);
  build(which, threshold);
  return which;
}

}  // namespace clackers::cases
