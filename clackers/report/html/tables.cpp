#include "clackers/report/html/tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/report/assets.hpp"
#include "clackers/report/html/plot_style.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

std::string cell_html(const Column& shown, const Row& row) {
  const auto cell = shown.get(row);
  if (const auto* real = std::get_if<double>(&cell))
    return shown.kind == Kind::error ? html_scientific(*real) : html_number(*real, 4);
  if (const auto* whole = std::get_if<long long>(&cell)) return html_count(*whole);
  const auto* text = std::get_if<std::string>(&cell);
  if (text == nullptr) return "–";
  if (shown.kind == Kind::verdict) return badge(*text);
  const auto& impacts = row.score.worst.impacts;
  const bool is_wrong = shown.name == "impacts" && impacts && impacts->missed + impacts->extra > 0;
  return is_wrong ? fmt::format("<span class=\"wrong\">{}</span>", escape(*text)) : escape(*text);
}

// The name of a subject, html, as a link to its section.
std::string linked(const std::string& name, const Place& place, std::size_t subject) {
  if (!place.has_sections) return name;
  return fmt::format("<a href=\"#{}\">{}</a>", anchor(place, subject), name);
}

std::string findings_html(const record::CaseRecord& problem, const Place& place) {
  std::string out;
  const auto all = named_findings(groups_of(problem), [](const record::Subject& subject) {
    const auto found = finding(subject);
    return found ? std::vector{*found} : std::vector<Finding>{};
  });
  for (const auto& [subject, who, found] : all)
    out += fmt::format("<li>{}: {}</li>\n",
                       linked(escape(who), place, std::size_t(subject - problem.subjects.data())),
                       finding_html(found));
  return out.empty() ? out : "<ul class=\"remarks\">\n" + out + "</ul>\n";
}

// Of a page with one subject the finding and its causes stand at the head.
bool is_check(const record::CaseRecord& problem, const Place& place) {
  return place.suffix.empty() && problem.subjects.size() == 1 &&
         problem.subjects.front().kind == record::SubjectKind::histories;
}

}  // namespace

std::string diagnoses_html(const record::CaseRecord& problem, const Place& place) {
  std::string out;
  bool are_faults = false;
  for (std::size_t i = 0; i < problem.subjects.size(); ++i) {
    const auto& subject = problem.subjects[i];
    are_faults =
        are_faults || (!subject.diagnoses.empty() && subject.assessment.verdict != Verdict::agrees);
    const auto name = problem.subjects.size() == 1 ? std::string()
                                                   : linked(escape(subject.name), place, i) + ": ";
    for (const auto& cause : diagnosis_texts(subject))
      out += fmt::format("<li>{}{}</li>\n", name, finding_html(cause));
  }
  // Of methods that are what they claim causes explain, and accuse nobody.
  return out.empty() ? out
                     : fmt::format("<ul class=\"remarks{}\">\n{}</ul>\n",
                                   are_faults ? " diagnoses" : "", out);
}

namespace {

std::string failures_html(const record::CaseRecord& problem, const Place& place) {
  std::string out;
  for (std::size_t i = 0; i < problem.subjects.size(); ++i)
    for (const auto& failure : failure_texts(problem.subjects[i]))
      out += fmt::format("<li>{}: {}</li>\n", linked(escape(problem.subjects[i].name), place, i),
                         escape(failure));
  return out.empty() ? out : "<ul class=\"remarks\">\n" + out + "</ul>\n";
}

std::string notes_html(const record::CaseRecord& problem) {
  std::string out;
  for (const auto& subject : problem.subjects) {
    const auto who = problem.subjects.size() > 1 ? escape(subject.name) + ": " : std::string();
    for (const auto& note : note_texts(subject))
      out += fmt::format("<li>{}{}</li>\n", who, escape(note));
  }
  return out.empty()
             ? out
             : "<h3>What limits the assessment</h3>\n<ul class=\"remarks\">\n" + out + "</ul>\n";
}

std::string quantities_html(const std::string& caption, const std::vector<Quantity>& quantities) {
  if (quantities.empty()) return {};
  std::vector<std::vector<std::string>> rows;
  for (const auto& quantity : quantities)
    rows.push_back({fmt::format("<code>{}</code>", escape(quantity.name)),
                    quantity.text.empty() ? html_number(quantity.value, 10) : escape(quantity.text),
                    quantity.unit.empty()
                        ? std::string()
                        : fmt::format("<span class=\"unit\">{}</span>", escape(quantity.unit)),
                    escape(quantity.meaning)});
  const HtmlColumn columns[] = {{"Name", {}}, {"Value", {}, true}, {"Unit", {}}, {"Meaning", {}}};
  return html_table(caption, caption, columns, rows);
}

}  // namespace

std::string html_table(std::string_view label, std::string_view caption,
                       std::span<const HtmlColumn> columns,
                       const std::vector<std::vector<std::string>>& rows, std::string_view style) {
  const auto number = [](const HtmlColumn& column) {
    return column.is_number ? " class=\"number\"" : "";
  };
  std::string headings, lines;
  for (const auto& column : columns)
    headings += fmt::format(
        "<th scope=\"col\" role=\"columnheader\"{}>{}{}</th>", number(column),
        escape(column.heading),
        column.detail.empty() ? "" : fmt::format(" <small>{}</small>", escape(column.detail)));
  for (const auto& row : rows) {
    lines += fmt::format("<tr role=\"row\"><th scope=\"row\" role=\"rowheader\"{}>{}</th>",
                         number(columns[0]), row[0]);
    for (std::size_t c = 1; c < row.size(); ++c)
      lines += fmt::format("<td role=\"cell\" data-label=\"{}\"{}><span>{}</span></td>",
                           escape(columns[c].heading), number(columns[c]), row[c]);
    lines += "</tr>\n";
  }
  return fill(assets::table_html, {{"label", escape(label)},
                                   {"caption", escape(caption)},
                                   {"style", std::string(style)},
                                   {"headings", headings},
                                   {"rows", lines}});
}

std::string html_table(std::string_view label, std::string_view caption, const Table& table,
                       const std::function<std::string(const Row&)>& name_of,
                       std::string_view style) {
  std::vector<HtmlColumn> columns;
  for (const auto* shown : table.columns) {
    auto heading = std::string(shown->heading);
    heading[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(heading[0])));
    columns.push_back({std::move(heading),
                       shown->unit.empty() ? "" : fmt::format("[{}]", shown->unit),
                       is_number(shown->kind)});
  }
  std::vector<std::vector<std::string>> rows;
  for (const auto& row : table.rows) {
    auto& cells = rows.emplace_back();
    for (const auto* shown : table.columns)
      cells.push_back(cells.empty() ? name_of(row) : cell_html(*shown, row));
  }
  return html_table(label, caption, columns, rows, style);
}

std::string anchor(const Place& place, std::size_t subject) {
  return fmt::format("method{}-{}", place.suffix, subject + 1);
}

std::string badge(std::string_view word) {
  auto style = std::string(word);
  std::ranges::replace(style, ' ', '-');
  return fmt::format("<span class=\"badge {}\">{}</span>", style, escape(word));
}

std::string fact(std::string_view term, const std::string& html) {
  return html.empty() ? html : fmt::format("<dt>{}</dt><dd>{}</dd>\n", term, html);
}

std::string finding_html(const Finding& found) {
  return escape(found.sentence) +
         (found.code.empty()
              ? ""
              : fmt::format(" <span class=\"code\">[{}]</span>", escape(found.code)));
}

std::string verdicts_html(const record::CaseRecord& problem, const Place& place) {
  const auto first = departure_text(problem);
  auto out = first.empty() ? first : fmt::format("<p>{}</p>\n", escape(first));
  if (!is_check(problem, place)) out += diagnoses_html(problem, place);
  const auto methods = summary_table(problem, record::SubjectKind::method);
  if (!methods.rows.empty())
    out += html_table(
        "Verdict table",
        fmt::format(
            "Of each method the worst of the finest level's steps. Errors {}; order ± 95 %; "
            "impacts matched / exact. A dash: not measured.",
            error_scale_text),
        methods,
        [&](const Row& row) {
          const auto index = std::size_t(row.subject - problem.subjects.data());
          return fmt::format("<span class=\"named\">{}{}</span>", key_svg(plot_style(index)),
                             linked(breakable(escape(row.subject->name)), place, index));
        },
        "verdicts");
  out += failures_html(problem, place);
  const bool by_step = std::ranges::all_of(problem.subjects, [](const record::Subject& subject) {
    return subject.refined_by == record::RefinementParameter::step;
  });
  const auto histories = summary_table(problem, record::SubjectKind::histories);
  if (!histories.rows.empty())
    out += html_table("Histories",
                      std::string(by_step ? "Coarsest step" : "Loosest tolerance") +
                          " first. Errors relative to the largest envelope; v in the mean "
                          "over time; impacts matched / exact. A dash: not measured.",
                      histories, [](const Row& row) {
                        return breakable(escape(row.run->file ? short_path(row.run->file->file)
                                                              : row.subject->name));
                      });
  // Of `check` the finding stands at the head of the page.
  return out + (is_check(problem, place) ? std::string() : findings_html(problem, place)) +
         notes_html(problem);
}

std::string cases_html(const record::Record& record) {
  const HtmlColumn columns[] = {{"Case", {}},
                                {"Agree", {}, true},
                                {"Disagree", {}, true},
                                {"Not claimed", {}, true},
                                {"Undecided", {}, true},
                                {"Refused", {}, true},
                                {"Interrupted", {}, true}};
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < record.cases.size(); ++i) {
    const auto all = record::counts(record.cases[i]);
    auto& cells = rows.emplace_back();
    cells.push_back(fmt::format("<a href=\"#case-{}\">{}</a>", i + 1,
                                escape(case_text(record.cases[i].problem))));
    for (const int count :
         {all.agrees, all.disagrees, all.not_claimed, all.undecided, all.refused, all.interrupted})
      cells.push_back(html_count(count));
  }
  return html_table("Cases", "How many subjects of each case got which verdict.", columns, rows);
}

std::string changes_html(const study::BaselineComparison& changes) {
  auto out = fmt::format("<p>{}</p>\n", escape(change_summary(changes)));
  std::string rows;
  for (const auto& change : changes.subjects) {
    if (!change.any()) continue;
    rows += fmt::format("<dt>{}, {}</dt><dd><ul>", escape(change.case_name), escape(change.name));
    for (const auto& text : change_texts(change)) rows += fmt::format("<li>{}</li>", escape(text));
    rows += "</ul></dd>\n";
  }
  return rows.empty() ? out : out + "<dl class=\"changes\">\n" + rows + "</dl>\n";
}

std::string case_html(const record::CaseSummary& problem) {
  return fmt::format("<p><strong>{}</strong>: {} <small>{}</small></p>\n", escape(problem.name),
                     escape(problem.summary), escape(problem.equations)) +
         quantities_html("Parameters", problem.parameters) +
         quantities_html("Derived constants", problem.constants);
}

std::string again_html(const record::Provenance& provenance) {
  std::string out = fmt::format(
      "<div class=\"command\"><pre id=\"command\">{}</pre>"
      "<button type=\"button\" data-copy=\"command\">Copy</button></div>\n<dl class=\"facts\">\n",
      escape(provenance.command));
  out += fact("clackers", escape(provenance.version));
  out += fact("Compiler", escape(provenance.compiler));
  out += fact("Machine", escape(provenance.machine));
  out += fact("Processor", escape(provenance.processor));
  out += fact("Date", fmt::format("<time datetime=\"{0}\">{0}</time>", escape(provenance.date)));
  return out + "</dl>\n";
}

}  // namespace clackers::report
