// What reads and writes records: `check` with every output, and the record of --baseline.
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "clackers/base/error.hpp"
#include "clackers/base/files/json.hpp"
#include "clackers/record/record_json.hpp"
#include "clackers/report/write.hpp"
#include "clackers/study/baseline.hpp"
#include "clackers/study/check.hpp"
#include "cli/values.hpp"
#include "target.hpp"

namespace clackers::fuzz {
namespace {

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> out;
  for (;;) {
    const auto at = text.find(separator);
    out.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return out;
    text.remove_prefix(at + separator.size());
  }
}

// Longer runs of the case only take longer.
bool is_short(const cases::Settings& settings) {
  return std::ranges::all_of(settings, [](const auto& setting) {
    const auto& [name, value] = setting;
    if (value.is_word()) return true;
    if (name == "t_end") return value <= 3000.0;
    if (name == "a_t" || name == "X" || name == "N") return value <= 100.0;
    return true;
  });
}

// A line "key value" of the first section.
void set_option(std::string_view line, study::CheckRequest& request) {
  const auto blank = line.find(' ');
  const auto key = line.substr(0, blank);
  const auto value = blank == line.npos ? std::string() : std::string(line.substr(blank + 1));
  if (key == "case") request.case_name = value;
  if (key == "set") request.settings = cli::read_settings({value});
  if (key == "expect") request.expect = study::claim_from(value);
  if (key == "tolerance") request.tolerance = cli::read_number("tolerance", value);
  if (key == "step") request.steps.push_back(cli::read_number("step", value));
  if (key == "columns")
    for (const auto name : split(value, ",")) request.columns.emplace_back(name);
}

// Fields of a csv line by RFC 4180; a quoted line feed never stands in ours.
std::size_t fields(std::string_view line) {
  std::size_t count = 1;
  bool quoted = false;
  for (const char c : line) {
    quoted = quoted != (c == '"');
    count += c == ',' && !quoted;
  }
  return count;
}

void write_as(const record::Record& record, std::string_view name) {
  std::ostringstream out;
  const auto format = report::format_from(std::string(name), report::Content::verdicts);
  report::write(record, format, out);
  const auto text = out.str();
  require(!text.empty(), "every format writes something");
  if (format == report::Format::json) (void)parse_json(text);  // it can be read
  if (format == report::Format::csv) {
    auto lines = split(text, "\n");
    lines.pop_back();
    for (const auto line : lines)
      require(fields(line) == fields(lines.front()), "csv has the same fields in every line");
  }
}

void survives(const record::Record& record) {
  const auto json = record::to_json(record);
  require(record::to_json(record::record_from_json(json)) == json, "a record survives its json");
  require(!study::compare(record, record).any(), "a record does not differ from itself");
}

void write_all(const record::Record& record, std::size_t length) {
  const int code = record::exit_code(record);
  require(code == 0 || code == 1 || code == 3 || code == 130, "a verdict has an exit code");
  std::size_t output = 0;
  const auto chosen = [&] { return every_output || length % 7 == output++; };
  for (const auto* name : {"table", "csv", "json", "junit", "latex"})
    if (chosen()) write_as(record, name);
  if (chosen()) survives(record);
  if (chosen()) require(report::html(record).ends_with("</html>\n"), "a page is complete");
}

}  // namespace

// Sections between lines "---": options, then histories, and events that begin with a line "events".
void check_and_report(std::string_view bytes) {
  const auto sections = split(bytes, "---\n");
  study::CheckRequest request;
  for (const auto line : split(sections.front(), "\n")) set_option(line, request);
  if (!is_short(request.settings)) return;
  std::vector<std::unique_ptr<MemoryFile>> files;
  for (std::size_t i = 1; i < std::min<std::size_t>(sections.size(), 9); ++i) {
    constexpr std::string_view mark = "events\n";
    const bool events = sections[i].starts_with(mark);
    files.push_back(std::make_unique<MemoryFile>(sections[i].substr(events ? mark.size() : 0)));
    (events ? request.events : request.subjects.front().files).push_back(files.back()->path());
  }
  write_all(study::check(request), bytes.size());
}

// What --baseline does with a file.
void read_record(std::string_view bytes) { survives(record::record_from_json(std::string(bytes))); }

}  // namespace clackers::fuzz
