#include "clackers/report/html/page.hpp"

#include <fmt/format.h>

#include "clackers/report/html/tables.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {

std::string lead_html(const record::CaseRecord& problem) {
  const auto plan = plan_text(problem);
  return fmt::format("{} {}.{}", escape(problem.problem.summary),
                     escape(length_text(problem.problem)),
                     plan.empty() ? "" : " " + escape(plan) + ".");
}

std::string overall_html(const record::Record& record) {
  const auto line = verdict_line(record);
  auto text = escape(line.counts);
  if (line.counts.empty() && !record.cases.empty() && !record.cases.front().subjects.empty())
    if (const auto found = finding(record.cases.front().subjects.front()))
      text = finding_html(*found);
  const auto causes = line.counts.empty() && record.cases.size() == 1
                          ? diagnoses_html(record.cases.front(), {})
                          : std::string();
  const bool has_cause = !causes.empty() && deciding_cause(record.cases.front().subjects.front());
  auto out = has_cause ? fmt::format("<p class=\"overall\">{}</p>\n{}<p>{}</p>\n", badge(line.word),
                                     causes, text)
                       : fmt::format("<p class=\"overall\">{} <span>{}</span></p>\n{}",
                                     badge(line.word), text, causes);
  if (record.interrupted)
    out +=
        "<p class=\"notice\" role=\"note\"><strong>Interrupted.</strong> Only what was finished is "
        "shown. <span class=\"code\">[interrupted]</span></p>\n";
  return out;
}

}  // namespace clackers::report
