#include "clackers/report/check_html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "clackers/report/check_words.hpp"
#include "clackers/report/digest.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/html_metrics.hpp"
#include "clackers/report/html_parts.hpp"
#include "clackers/report/markup.hpp"

namespace clackers::report {
namespace {

struct Heading {
  std::string_view label, detail;
  bool number;
};

constexpr Heading headings[] = {{"Rows", "judged", true},
                                {"Step", "[s]", true},
                                {"Digits", "printed", true},
                                {"Error in u", "/ initial envelope", true},
                                {"Floor", "by printing", true},
                                {"Error in v", "in the mean", true},
                                {"Collisions", "matched / exact", true},
                                {"Collision time", "worst error [s]", true},
                                {"Collisions", "from", false}};

std::string row(const study::CheckedFile& file) {
  const auto& found = file.score.impacts;
  const bool wrong = found && found->missed + found->extra > 0;
  const std::string cells[] = {
      html_count(file.rows),
      html_number(file.score.step, 4),
      digits_text(file),
      html_scientific(file.score.u_error),
      html_scientific(file.printed_floor),
      html_scientific(file.score.v_error),
      found ? fmt::format("<span{}>{}\u202f/\u202f{}</span>", wrong ? " class=\"wrong\"" : "",
                          found->matched, found->expected)
            : "–",
      found && found->matched > 0 ? html_scientific(found->worst_time_error) : "–",
      std::string(to_string(file.collisions))};
  auto out = fmt::format("<tr><th scope=\"row\">{}</th>", breakable(escape(file.file)));
  for (std::size_t i = 0; i < std::size(headings); ++i)
    out += fmt::format("<td{}>{}</td>", headings[i].number ? " class=\"number\"" : "", cells[i]);
  return out + "</tr>\n";
}

std::string together(const study::CheckRecord& record) {
  if (record.files.size() < 2) return {};
  const auto& fit = record.assessment.displacement;
  const auto order = escape(order_text(fit, "\u202f"));
  return fmt::format(
      "<p>The {} histories together: <strong>{}</strong>{}{}.</p>\n", record.files.size(),
      escape(to_string(fit.behaviour)), order.empty() ? "" : ", order " + order,
      fit.reason.empty() ? ""
                         : fmt::format(" <span class=\"code\">[{}]</span>", escape(fit.reason)));
}

// Every note once, with the files it is about where they are not all.
std::string notes_of(const study::CheckRecord& record) {
  std::vector<std::pair<std::string, std::vector<std::string>>> notes;
  for (const auto& file : record.files)
    for (const auto& note : file.notes) {
      auto known = std::ranges::find(notes, note, [](const auto& entry) { return entry.first; });
      if (known == notes.end()) known = notes.insert(known, {note, {}});
      known->second.push_back(escape(file.file));
    }
  std::string out;
  for (const auto& [note, files] : notes)
    out += fmt::format(
        "<li>{}{}</li>\n",
        files.size() == record.files.size() ? "" : fmt::format("{}: ", fmt::join(files, ", ")),
        escape(note));
  return out;
}

}  // namespace

std::string histories_html(const study::CheckRecord& record) {
  std::string out =
      "<div class=\"scroll\" role=\"region\" aria-label=\"Histories\" tabindex=\"0\">\n<table>\n"
      "<caption>Coarsest step first. A dash: not measured.</caption>\n<thead><tr><th "
      "scope=\"col\">File</th>";
  for (const auto& [label, detail, number] : headings)
    out += fmt::format("<th scope=\"col\"{}>{} <small>{}</small></th>",
                       number ? " class=\"number\"" : "", label, detail);
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& file : record.files) out += row(file);
  out += "</tbody>\n</table>\n</div>\n" + together(record);
  const auto notes = notes_of(record);
  if (notes.empty()) return out;
  return out + "<h3>What limits the judgement</h3>\n<ul class=\"remarks\">\n" + notes + "</ul>\n";
}

std::string metrics_html(const study::CheckRecord& record) {
  const auto& finest = record.files.back();
  if (finest.metrics.empty())
    return "<p>Metrics need the displacements of all masses, which the file does not have.</p>\n";
  return fmt::format("<p>Of {}.</p>\n", escape(finest.file)) +
         metrics_table(finest.metrics, finest.file);
}

}  // namespace clackers::report
