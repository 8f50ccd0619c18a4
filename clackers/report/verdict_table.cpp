#include "clackers/report/verdict_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "clackers/report/changes.hpp"
#include "clackers/report/digest.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/layout.hpp"
#include "clackers/report/self_words.hpp"

namespace clackers::report {
namespace {

Paint paint_of(std::string_view verdict) {
  if (verdict == "agrees") return Paint::green;
  if (verdict == "disagrees") return Paint::red;
  if (verdict == "not claimed") return Paint::plain;
  return Paint::yellow;
}

void print_wrapped(std::string_view text, std::string_view margin, std::ostream& out,
                   const Style& style) {
  const auto width = std::size_t(std::max(style.width, 20)) - margin.size();
  for (const auto& line : wrap(text, width)) out << margin << line << '\n';
}

std::vector<TextCell> cells_of(const study::MethodResult& method) {
  const auto d = digest(method);
  const auto word = verdict_word(method);
  const bool judged = method.refusal.empty();
  const auto dash = [](std::string text) { return text.empty() ? "-" : text; };
  const auto& fit = method.assessment.displacement;
  return {{typed_name(method), Paint::bold},
          {scientific(d.u_error)},
          {dash(judged ? order_text(fit, "") : "")},
          {d.impacts ? fmt::format("{}/{}", d.impacts->found, d.impacts->expected) : "-"},
          {d.impacts && d.impacts->matched > 0 ? scientific(d.impacts->worst_time_error) : "-"},
          {scientific(d.energy_error)},
          {d.runs > 0 ? short_count(d.force_evaluations) : "-"},
          {judged && d.runs > 0 ? std::string(to_string(fit.behaviour)) : "-"},
          // Only the longest word would cost every name two characters.
          {word == "interrupted" ? "stopped" : word, paint_of(word)}};
}

std::vector<TextColumn> columns() {
  std::vector<TextColumn> out{
      {"method", false},      {"error in u", true},       {"order\nseen", true},
      {"coll.\nfound", true}, {"time\nerror\n[s]", true}, {"energy\nerror", true},
      {"force\neval.", true}, {"behaviour", false},       {"verdict", false}};
  const std::size_t least_header[] = {8, 5, 5, 5, 5, 6, 5, 9, 7};
  for (std::size_t c = 0; c < out.size(); ++c) out[c].natural = out[c].least = least_header[c];
  return out;
}

void print_table(const study::Record& record, std::ostream& out, const Style& style) {
  std::vector<std::vector<TextCell>> rows;
  for (const auto& method : record.methods) rows.push_back(cells_of(method));
  auto layout = columns();
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c)
      layout[c].natural = std::max(layout[c].natural, display_width(row[c].text));
  // Numbers and the two words stay whole, only names are wrapped, unless the terminal is very
  // narrow.
  for (std::size_t c = 1; c < layout.size(); ++c) layout[c].least = layout[c].natural;
  layout.back().least = display_width("disagrees");
  const auto width = std::size_t(std::max(style.width, 1));
  if (!fit(layout, 1, width)) {
    for (auto& column : layout) column.least = 3;
    fit(layout, 1, width);
  }
  print_header(layout, 1, out, style);
  for (const auto& row : rows) print_row(layout, row, 1, out, style);
}

}  // namespace

void write_verdict_table(const study::Record& record, std::ostream& out, const Style& style,
                         const study::BaselineComparison* changes) {
  const auto& problem = record.problem;
  print_wrapped(case_text(problem), "", out, style);
  print_wrapped(fmt::format("{} s with {} collisions; fast period {} s", short_number(problem.end),
                            problem.impact_count, short_number(problem.fast_period, 4)),
                "", out, style);
  print_wrapped(ladder_text(record), "", out, style);
  if (record.interrupted)
    out << painted("INTERRUPTED: only what was finished is shown [interrupted]", Paint::yellow,
                   style)
        << '\n';
  out << '\n';
  print_table(record, out, style);
  out << '\n';
  print_wrapped(
      "Worst of the finest level's steps; errors relative to the initial envelope and "
      "energy; order ± 95 %.",
      "", out, style);
  bool first = true;
  for (const auto& method : record.methods)
    if (const auto said = remark(method)) {
      if (first) out << '\n';
      first = false;
      print_wrapped(fmt::format("{}: {} [{}]", typed_name(method), said->sentence, said->code), "",
                    out, style);
    }
  first = true;
  for (const auto& method : record.methods)
    if (const auto said = lie(method)) {
      if (first) out << '\n';
      first = false;
      const auto code = said->code.empty() ? "" : fmt::format(" [{}]", said->code);
      print_wrapped(fmt::format("{}: {}{}", typed_name(method), said->sentence, code), "", out,
                    style);
    }
  if (changes != nullptr) {
    out << '\n';
    write_changes(*changes, out, style);
  }
  const auto end = closing(record);
  out << '\n';
  print_wrapped(fmt::format("Of {}: {}.", counted_methods(record), end.sentence), "", out, style);
  // A command is for copying, so it is not broken; one that is too long is only referred to.
  auto last = fmt::format("Verdict: {}. Next: {}", end.word, end.next);
  if (display_width(last) > std::size_t(std::max(style.width, 20)))
    last = fmt::format("Verdict: {}. Next: {}", end.word, end.next_in_words);
  out << painted(last, paint_of(end.word), style) << '\n';
}

}  // namespace clackers::report
