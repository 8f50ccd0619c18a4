#include "clackers/tables/citations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <regex>

#include "clackers/base/check.hpp"
#include "clackers/base/text.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/methods/method_specification.hpp"
#include "clackers/methods/registry.hpp"

#ifndef CLACKERS_RELEASED
#error "the build gives CLACKERS_RELEASED, the date in CITATION.cff"
#endif

namespace clackers::tables {
namespace {

constexpr std::string_view paper_key = "soroushian2018";
constexpr auto paper =
    R"(@article{soroushian2018,
  author = {Soroushian, A. and Ahmadi, G. and Amiri, S.},
  title = {A class of synchronized nonlinear two-{DOF} systems with a closed-form solution},
  journal = {Scientia Iranica, Transactions B: Mechanical Engineering},
  year = {2018}
}
)";

void add_once(std::vector<std::string>& list, const std::string& item) {
  if (std::ranges::find(list, item) == list.end()) list.push_back(item);
}

std::string replaced(const std::string& text, const char* pattern, const char* by) {
  return std::regex_replace(text, std::regex(pattern), by);
}

std::string name_of(const std::string& part) { return part.substr(0, part.find(':')); }

// The parts of a specification, with the treatment that an integrator alone has.
std::vector<std::string> parts_of(const std::string& specification) {
  std::vector<std::string> parts;
  for (const auto term : methods::terms_of(specification)) parts.emplace_back(term);
  const auto& all = methods::entries();
  const auto first = std::ranges::find(all, name_of(parts.front()), &methods::Entry::name);
  if (parts.size() == 1 && first != all.end() && first->kind == "integrator")
    parts.emplace_back(methods::default_treatment);
  return parts;
}

// The text behind "Source" on the card of a part, and the sources of the words that it chooses, in one line.
std::string source_of(const std::string& part) {
  const auto card = methods::card(name_of(part));
  const auto at = card.find("\nSource ");
  if (at == card.npos) return {};
  auto text = replaced(std::string(card.substr(at + 8)), "\\s+", " ");
  const auto entry = std::ranges::find(methods::entries(), name_of(part), &methods::Entry::name);
  for (const auto& parameter : entry->parameters)
    for (const auto& word : parameter.words)
      if ((part + ',').find(fmt::format("{}={},", parameter.name, word.name)) != part.npos)
        text += "; " + word.source;
  return text;
}

// "N. M. Newmark, J. Eng. Mech. Div. ASCE 85 (EM3), 67-94 (1959)", in its parts. Of a book `where` is
// its title and what follows.
struct Reference {
  std::vector<std::string> authors;
  std::string where, year;
};

Reference reference_of(const std::string& text) {
  static const std::regex name(
      R"(\s*((?:[A-Z][a-z]?\.[- ]?)+ ?[A-Za-z][A-Za-z' -]*(?: et al\.)?)\s*)");
  Reference reference;
  std::string rest = text;
  std::smatch found;
  for (auto comma = rest.find(','); comma != rest.npos; comma = rest.find(',')) {
    const auto item = rest.substr(0, comma);
    if (!std::regex_match(item, found, name)) break;
    reference.authors.push_back(found[1]);
    rest.erase(0, comma + 1);
  }
  if (std::regex_search(rest, found, std::regex(R"(\((\d{4})\))"))) {
    reference.year = found[1];
    reference.where = replaced(found.prefix(), "^ +| +$", "");
  }
  return reference;
}

std::string key_of(const Reference& reference) {
  auto name = replaced(reference.authors.front(), R"( et al\.)", "");
  name = name.substr(name.rfind(' ') + 1);
  std::ranges::transform(name, name.begin(),
                         [](char c) { return char(std::tolower(static_cast<unsigned char>(c))); });
  return name + reference.year;
}

// The entry behind its key.
std::string entry_of(const Reference& reference) {
  auto authors = fmt::format("{}", fmt::join(reference.authors, " and "));
  authors = replaced(authors, R"( et al\.)", " and others");
  auto fields = fmt::format("  author = {{{}}},\n", authors);
  static const std::regex article(R"((.*?) (\d+)(?: \(([^)]+)\))?, ([0-9][0-9 a-z-]*))");
  std::smatch found;
  if (std::regex_match(reference.where, found, article)) {
    fields +=
        fmt::format("  journal = {{{}}},\n  volume = {{{}}},\n", found[1].str(), found[2].str());
    if (found[3].matched) fields += fmt::format("  number = {{{}}},\n", found[3].str());
    fields += fmt::format("  pages = {{{}}},\n", replaced(found[4], "-", "--"));
  } else {
    const auto comma = reference.where.find(", ");
    fields += fmt::format("  title = {{{}}},\n", reference.where.substr(0, comma));
    if (comma != reference.where.npos)
      fields += fmt::format("  howpublished = {{{}}},\n", reference.where.substr(comma + 2));
  }
  return fmt::format("{}  year = {{{}}}\n}}\n", fields, reference.year);
}

bool is_article(const std::string& entry) { return entry.find("journal = ") != entry.npos; }

// The sources of all parts of methods, each entry once, with the names that have it.
class Bibliography {
 public:
  void add(const std::string& part) {
    bool has_any = false;
    const auto source = source_of(part);
    for (std::size_t from = 0; from < source.size();) {
      const auto end = std::min(source.find(';', from), source.size());
      const auto reference = reference_of(source.substr(from, end - from));
      from = end + 1;
      if (reference.authors.empty() || reference.year.empty()) continue;
      has_any = true;
      if (key_of(reference) != paper_key) add(reference, name_of(part));
    }
    if (!has_any) add_once(without_, name_of(part));
  }
  std::string text() const {
    std::string text;
    for (const auto& [key, entry, parts] : entries_)
      text += fmt::format("\n% {}\n@{}{{{},\n{}", fmt::join(parts, ", "),
                          is_article(entry) ? "article" : "misc", key, entry);
    for (const auto& part : without_)
      text += fmt::format("\n% {}: no publication; see clackers show {}\n", part, part);
    return text;
  }

 private:
  struct Entry {
    std::string key, entry;
    std::vector<std::string> parts;
  };
  void add(const Reference& reference, const std::string& part) {
    const auto entry = entry_of(reference);
    auto known = std::ranges::find(entries_, entry, &Entry::entry);
    if (known == entries_.end()) {
      auto key = key_of(reference);
      const auto same = std::ranges::count_if(
          entries_, [&](const Entry& other) { return other.key.starts_with(key); });
      if (same > 0) key += char('a' + same);
      known = entries_.insert(entries_.end(), {key, entry, {}});
    }
    add_once(known->parts, part);
  }
  std::vector<Entry> entries_;
  std::vector<std::string> without_;
};

}  // namespace

Used used_in(const record::Record& record) {
  Used used;
  for (const auto& problem : record.cases) {
    add_once(used.cases, problem.problem.name);
    for (const auto& subject : problem.subjects)
      add_once(subject.kind == record::SubjectKind::method ? used.methods : used.others,
               subject.name);
  }
  return used;
}

Used used_of(std::span<const std::string> names) {
  Used used;
  std::vector<std::string> known;
  for (const auto& entry : cases::entries()) known.push_back(entry.name);
  for (const auto& entry : methods::entries()) known.push_back(entry.name);
  for (const auto& name : names) {
    const auto parts = parts_of(name);
    for (const auto& part : parts)
      if (std::ranges::find(known, name_of(part)) == known.end())
        refuse_name("method or case", name_of(part), known, "clackers list methods");
    add_once(methods::card(name_of(parts.front())).empty() ? used.cases : used.methods, name);
  }
  return used;
}

std::string bibtex(const Used& used) {
  const std::string released = CLACKERS_RELEASED;
  auto text = fmt::format(
      "@software{{clackers,\n  author = {{{{The Clackers developers}}}},\n  title = {{Clackers: exact motions of "
      "colliding structures, and verdicts on time-integration methods}},\n  version = {{{}}},\n  date = {{{}}},\n"
      "  year = {{{}}}\n}}\n\n{}",
      record::provenance("").version, released, released.substr(0, 4), paper);
  Bibliography methods;
  for (const auto& method : used.methods)
    for (const auto& part : parts_of(method)) methods.add(part);
  text += methods.text();
  for (const auto& name : used.cases)
    text += fmt::format("\n% case {}: {}, {}\n", name,
                        cases::entry(name).equations.starts_with("Eq") ? paper_key : "clackers",
                        cases::entry(name).equations);
  for (const auto& name : used.others)
    text += fmt::format("\n% {}: no method of Clackers; cite its authors\n", name);
  return text;
}

}  // namespace clackers::tables
