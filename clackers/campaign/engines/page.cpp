#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "clackers/base/text.hpp"
#include "clackers/campaign/engines.hpp"
#include "clackers/report/assets.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::campaign {
namespace {

using record::Cell;
using report::escape;
using report::html_number;

// What cells of the page compare: a step of 1 ms, or a tolerance of 1e-8; 0.1 s of processor time.
constexpr auto task_sql =
    "SELECT s.task, s.behaviour, s.\"order\", s.reason, s.diagnosis, s.failure_code, s.refusal,"
    " (SELECT u_error FROM runs r WHERE r.task = s.task AND finished = 'yes' ORDER BY"
    "  max(coalesce(step / 1e-3, tolerance / 1e-8), coalesce(1e-3 / step, 1e-8 / tolerance)) LIMIT 1),"
    " (SELECT min(u_error) FROM runs r JOIN timings t USING (task, run) WHERE r.task = s.task"
    "  AND finished = 'yes' AND t.seconds BETWEEN 1e-9 AND 0.1),"
    " (SELECT \"metric:restitution-median\" FROM runs r WHERE r.task = s.task AND finished = 'yes'"
    "  ORDER BY run DESC LIMIT 1),"
    " (SELECT \"metric:restitution-smallest\" FROM runs r WHERE r.task = s.task AND finished = 'yes'"
    "  ORDER BY run DESC LIMIT 1),"
    " (SELECT \"metric:force-share-first\" FROM runs r WHERE r.task = s.task AND tolerance IS NULL"
    "  ORDER BY run LIMIT 1) FROM subjects s ORDER BY s.task";
constexpr auto work_sql =
    "SELECT r.task, t.seconds, r.u_error FROM runs r JOIN timings t USING (task, run)"
    " WHERE finished = 'yes' AND t.seconds BETWEEN 1e-3 AND 10 AND r.u_error BETWEEN 1e-13 AND 10 ORDER BY r.task, t.seconds";

struct Task {
  const record::Labels* labels = nullptr;
  std::size_t method = 0, system = 0;
  std::string behaviour, reason, cause, failure, refusal;
  double order = 0, at_step = 0, at_cost = 0, restitution = 0, smallest = 0, share = 0;
};

std::vector<std::vector<Cell>> rows_of(const Store& store, const char* sql) {
  const auto source = store.query(sql);
  std::vector<std::vector<Cell>> rows;
  for (std::vector<Cell> row; source->next(row);) rows.push_back(row);
  return rows;
}

std::string word_in(const Cell& cell) {
  const auto* word = std::get_if<std::string>(&cell);
  return word != nullptr ? *word : std::string();
}

std::vector<Task> tasks_of(const Store& store) {
  std::vector<Task> tasks;
  const auto& methods = store.specification().methods();
  for (const auto& row : rows_of(store, task_sql)) {
    const auto task = std::size_t(std::get<long long>(row[0]));
    const auto& labels = methods[task % methods.size()].labels;
    tasks.push_back({&labels, task % methods.size(), task / methods.size(), word_in(row[1]),
                     word_in(row[3]), word_in(row[4]), word_in(row[5]), word_in(row[6]),
                     record::number_in(row[2]), record::number_in(row[7]),
                     record::number_in(row[8]), record::number_in(row[9]),
                     record::number_in(row[10]), record::number_in(row[11])});
  }
  return tasks;
}

std::string label_of(const Task& task, const char* key) {
  const auto found = task.labels->find(key);
  return found == task.labels->end() ? std::string() : found->second;
}

// "stop:eta=0.7", as --case reads it.
std::string case_word(const System& system) {
  std::string set;
  for (const auto& [name, value] : system.settings)
    set += fmt::format("{}{}={}", set.empty() ? ":" : ",", name, value.text());
  return std::string(system.name) + set;
}

bool converges(const Task& task) {
  return !task.behaviour.empty() && clackers::converges(behaviour_from(task.behaviour));
}

std::string cell_html(const Task& task, const std::string& head) {
  const auto& word = task.behaviour;
  const auto kind = converges(task) ? "good" : word == "undecided" || word.empty() ? "open" : "bad";
  std::string out = fmt::format("<td class=\"{}\" data-head=\"{}\"><b>{}</b>", kind, escape(head),
                                word.empty() ? "not run" : word);
  if (!word.empty() && std::isfinite(task.order))
    out += fmt::format(", order {}", html_number(task.order, 2));
  const auto line = [&](const std::string& html) { out += "<small>" + html + "</small>"; };
  if (std::isfinite(task.at_step))
    line(fmt::format("error {}{}", html_number(task.at_step, 2),
                     std::isfinite(task.at_cost)
                         ? fmt::format(", in 0.1 s {}", html_number(task.at_cost, 2))
                         : std::string()));
  if (std::isfinite(task.restitution))
    line(task.smallest < 0.95 * task.restitution
             ? fmt::format("restitution {}, least {}", html_number(task.restitution, 3),
                           html_number(task.smallest, 3))
             : fmt::format("restitution {}", html_number(task.restitution, 3)));
  for (const auto& code : {task.cause.substr(0, task.cause.find(' ')), task.reason, task.failure})
    if (!code.empty()) {
      line(escape(code));
      break;
    }
  return out + "</td>";
}

std::string matrix(const std::vector<Task>& tasks, const std::vector<std::string>& cases) {
  std::string out =
      "<div class=\"scroll\"><table class=\"engines\"><thead><tr><th scope=\"col\">setting</th><th "
      "scope=\"col\">share of a force<small>in one step</small></th>";
  for (const auto& name : cases) out += fmt::format("<th scope=\"col\">{}</th>", escape(name));
  out += "</tr></thead><tbody>\n";
  std::map<std::size_t, std::map<std::size_t, const Task*>> rows;
  for (const auto& task : tasks) rows[task.method][task.system] = &task;
  std::string engine;
  for (const auto& [method, cells] : rows) {
    const auto& first = *cells.begin()->second;
    if (label_of(first, "id") != engine) {
      engine = label_of(first, "id");
      out += fmt::format(
          "<tr class=\"engine\"><th colspan=\"{}\" scope=\"rowgroup\" id=\"{}\">{} "
          "<small>{}, version {}, {}</small></th></tr>\n",
          cases.size() + 2, escape(engine), escape(label_of(first, "engine")),
          escape(label_of(first, "integrates")), escape(label_of(first, "version")),
          escape(label_of(first, "licence")));
    }
    double share = std::nan("");
    for (const auto& [system, task] : cells)
      if (!std::isfinite(share)) share = task->share;
    out += fmt::format(
        "<tr><th scope=\"row\">{}<small>{}</small></th><td data-head=\"share of a force\">{}</td>",
        escape(label_of(first, "setting")), escape(label_of(first, "why")), html_number(share, 3));
    for (std::size_t system = 0; system < cases.size(); ++system)
      out += cells.contains(system) ? cell_html(*cells.at(system), cases[system]) : "<td></td>";
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

// Error against processor time, a line for the best setting of each engine; names stand at the right, apart.
std::string work_svg(const Store& store, const std::vector<Task>& tasks, std::size_t system) {
  std::map<std::string, std::pair<double, std::size_t>> best;  // by engine: error, task
  const auto methods = store.specification().methods().size();
  for (const auto& task : tasks)
    if (task.system == system && std::isfinite(task.at_step)) {
      auto& found = best.try_emplace(label_of(task, "id"), task.at_step, task.method).first->second;
      if (task.at_step < found.first) found = {task.at_step, task.method};
    }
  std::map<std::size_t, std::vector<std::pair<double, double>>> points;
  for (const auto& row : rows_of(store, work_sql)) {
    const auto task = std::size_t(std::get<long long>(row[0]));
    if (task / methods == system)
      points[task % methods].emplace_back(70 + 165 * (3 + std::log10(record::number_in(row[1]))),
                                          20 + 32 * (1 - std::log10(record::number_in(row[2]))));
  }
  std::string out = fmt::format(
      "<svg class=\"work\" viewBox=\"0 0 960 510\" role=\"img\" aria-label=\"Error against processor "
      "time\">");
  for (int p = -3; p <= 1; ++p)
    out += fmt::format(
        "<path class=\"grid\" d=\"M{0} 20V468\"/><text x=\"{0}\" y=\"486\" "
        "text-anchor=\"middle\">1e{1} s</text>",
        70 + 165 * (3 + p), p);
  for (int p = -13; p <= 1; p += 2)
    out += fmt::format(
        "<path class=\"grid\" d=\"M70 {0}H730\"/><text x=\"62\" y=\"{0}\" "
        "text-anchor=\"end\" dy=\"4\">1e{1}</text>",
        20 + 32 * (1 - p), p);
  std::vector<std::pair<double, std::string>> names;
  std::size_t colour = 0;
  for (const auto& [engine, found] : best) {
    auto& line = points[found.second];
    if (line.empty()) continue;
    std::string path;
    for (const auto& [x, y] : line)
      path += fmt::format("{}{:.0f} {:.0f}", path.empty() ? "M" : "L", x, y);
    names.emplace_back(
        line.back().second,
        fmt::format("<path d=\"{}h0\" style=\"stroke: var(--m{})\"/>"
                    "<path d=\"M{:.0f} {:.0f}L762 {{0:.0f}}\" class=\"grid\"/><text x=\"766\" "
                    "y=\"{{0:.0f}}\" dy=\"4\">{}</text>",
                    path, 1 + colour++ % 8, line.back().first, line.back().second, escape(engine)));
  }
  std::ranges::sort(names);
  double y = 8.0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double left = 14.0 * double(names.size() - 1 - i);  // below it
    y = std::min(std::max(y + 14.0, names[i].first), 496.0 - left);
    out += fmt::format(fmt::runtime(names[i].second), y);
  }
  return out + "</svg>\n";
}

std::string facts_html(const std::vector<Task>& tasks) {
  std::string out = "<ol class=\"facts\">\n";
  std::set<std::string> seen;
  for (const auto& task : tasks)
    for (const auto& [key, sentence] : *task.labels)
      if (key.starts_with("fact ") && seen.insert(sentence).second)
        out += fmt::format(
            "<li>{}<pre class=\"run\">clackers engines run {} --setting {} --case {}</pre></li>\n",
            escape(sentence), escape(label_of(task, "id")), escape(label_of(task, "setting")),
            escape(key.substr(5)));
  return out + "</ol>\n";
}

}  // namespace

std::string engines_page(const Store& store, const record::Provenance& from) {
  const auto tasks = tasks_of(store);
  const auto& specification = store.specification();
  std::vector<std::string> cases;
  for (long long i = 0; i < specification.systems(); ++i)
    cases.push_back(case_word(specification.system(i)));
  std::map<std::size_t, bool> good;
  std::map<std::string, std::pair<bool, bool>> engines;  // the first setting, any setting
  for (const auto& task : tasks) {
    auto& all = good.try_emplace(task.method, true).first->second;
    all = all && (converges(task) || task.behaviour.empty());
  }
  for (const auto& [method, all] : good) {
    const auto& labels = specification.methods()[method].labels;
    const auto [found, is_new] =
        engines.try_emplace(labels.contains("id") ? labels.at("id") : "", all, all);
    if (!is_new) found->second.second |= all;
  }
  const auto firsts = std::ranges::count_if(engines, [](const auto& e) { return e.second.first; });
  const auto anys = std::ranges::count_if(engines, [](const auto& e) { return e.second.second; });
  std::string work;
  for (std::size_t system = 0; system < cases.size() && system < 2; ++system)
    work += fmt::format(
        "<section><h2>Error against processor time: {}</h2><p>Of each engine the setting with the "
        "smallest error; time without the start of the program [s], error in u.</p>{}</section>\n",
        escape(cases[system]), work_svg(store, tasks, system));
  return report::fill(
      report::assets::engines_html,
      {{"style", std::string(report::assets::page_css) + std::string(report::assets::engines_css)},
       {"as_they_come", fmt::format("{} of {}", firsts, engines.size())},
       {"in_some_setting", fmt::to_string(anys)},
       {"settings", report::counted(std::ssize(good), "setting")},
       {"engines", report::counted(std::ssize(engines), "engine")},
       {"cases", report::counted(std::ssize(cases), "case")},
       {"date", escape(from.date.substr(0, 10))},
       {"version", escape(from.version)},
       {"matrix", matrix(tasks, cases)},
       {"work", work},
       {"facts", facts_html(tasks)}});
}

}  // namespace clackers::campaign
