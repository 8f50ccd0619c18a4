#include "clackers/input/history_columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"

namespace clackers::input {
namespace {

// For a message: of many names the first.
std::string joined(const std::vector<std::string>& names) {
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    text += (i == 0 ? "" : ", ") + printable(names[i]);
  return names.size() > most ? text + fmt::format(" and {} more", names.size() - most) : text;
}

class Finder {
 public:
  Finder(const std::string& path, const std::vector<std::string>& names)
      : path_(path), names_(names), used_(names.size()) {}

  HistoryColumns::Column find(std::initializer_list<std::string> specifications) {
    HistoryColumns::Column found;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (std::ranges::find(specifications, names_[i]) == specifications.end()) continue;
      if (found)
        throw InputError(fmt::format("{}: column {} appears twice; name the other one _ with "
                                     "--columns.",
                                     path_, names_[i]),
                         "no-column");
      found = i;
      used_[i] = true;
    }
    return found;
  }

  /// The columns x1, x2, ... of all masses, or x alone for one mass.
  std::vector<HistoryColumns::Column> of_masses(const std::string& letter, int dof) {
    std::vector<HistoryColumns::Column> found;
    for (int j = 1; j <= dof; ++j) {
      const auto name = letter + std::to_string(j);
      found.push_back(dof == 1 ? find({name, letter}) : find({name}));
    }
    return found;
  }

  std::vector<std::string> unused() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (!used_[i] && names_[i] != "_") names.push_back(names_[i]);
    return names;
  }

 private:
  const std::string& path_;
  const std::vector<std::string>& names_;
  std::vector<bool> used_;
};

// All or nothing: what is known of some masses only is left out, with a note.
void require_all(std::vector<HistoryColumns::Column>& columns, const std::string& code,
                 std::vector<Note>& notes) {
  const auto given = [](const HistoryColumns::Column& c) { return c.has_value(); };
  if (std::ranges::all_of(columns, given)) return;
  if (std::ranges::any_of(columns, given)) notes.push_back({.code = code});
  columns.clear();
}

}  // namespace

HistoryColumns history_columns(const std::string& path, const std::vector<std::string>& names,
                               const HistoryOptions& options, std::vector<Note>& notes) {
  Finder finder(path, names);
  HistoryColumns columns;
  columns.t = finder.find({"t", "time"});
  columns.side = finder.find({"side"});
  columns.u = finder.of_masses("u", options.dof);
  columns.v = finder.of_masses("v", options.dof);
  columns.a = finder.of_masses("a", options.dof);
  if (std::ranges::none_of(columns.u, [](const auto& c) { return c.has_value(); }))
    throw InputError(fmt::format("{} has no column {}; its columns: {}. Name them with --columns "
                                 "t,u1,... (_ skips one).",
                                 path, options.dof == 1 ? "u1" : "u1 or u2", joined(names)),
                     "no-column");
  if (!columns.t && !(options.step > 0.0))
    throw InputError(fmt::format("{} has no column t; its columns: {}. Name it with --columns "
                                 "t,u1,..., or give the time between rows with --steps.",
                                 path, joined(names)),
                     "no-column");
  require_all(columns.v, "velocities-incomplete", notes);
  require_all(columns.a, "accelerations-incomplete", notes);
  if (const auto unused = finder.unused(); !unused.empty())
    notes.push_back({.code = "columns-not-used", .text = joined(unused)});
  return columns;
}

}  // namespace clackers::input
