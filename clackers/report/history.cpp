#include "clackers/report/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/text.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

using record::Cell;

Cell finite(double value) { return std::isfinite(value) ? Cell(value) : Cell(); }
// For an axis of powers.
Cell positive(double value) { return value > 0.0 ? finite(value) : Cell(); }

// What is drawn of a subject.
struct Drawn {
  Cell order, error, evaluations, seconds;
};

Drawn drawn(const record::Subject& subject) {
  const auto& fit = subject.assessment.displacement;
  const auto score = record::worst_of_finest(subject).worst;
  return {fit.has_line ? finite(fit.order) : Cell(), positive(score.u_error),
          positive(double(score.work.force_evaluations)), positive(score.seconds)};
}

const study::SubjectChange* change_of(const study::BaselineComparison& changes,
                                      const std::string& case_name, const std::string& subject) {
  for (const auto& change : changes.subjects)
    if (change.case_name == case_name && change.name == subject && change.any()) return &change;
  return nullptr;
}

// The curves of one quantity, a column for each subject of any record.
class Curves {
 public:
  Curves(std::string schema, std::string title, record::Axes axes)
      : sheet_{std::move(schema),
               std::move(title),
               {{"record", "", "record, oldest first", record::ColumnKind::whole}},
               {},
               std::move(axes)} {}

  void add(long long record, const std::string& series, const Cell& value) {
    if (!std::holds_alternative<double>(value)) return;
    const auto known = std::ranges::find(sheet_.columns, series, &record::Column::name);
    const auto column = std::size_t(known - sheet_.columns.begin());
    if (known == sheet_.columns.end()) {
      sheet_.columns.push_back({series, "", ""});
      for (auto& row : sheet_.rows) row.emplace_back();
    }
    if (sheet_.rows.empty() || sheet_.rows.back()[0] != Cell(double(record))) {
      sheet_.rows.emplace_back(sheet_.columns.size());
      sheet_.rows.back()[0] = double(record);
    }
    sheet_.rows.back()[column] = value;
  }
  bool empty() const { return sheet_.rows.empty(); }
  record::Sheet take(std::span<const double> marks, std::span<const std::string> names) {
    sheet_.curves->x_names.assign(names.begin(), names.end());
    if (!marks.empty()) {
      sheet_.curves->marks.assign(marks.begin(), marks.end());
      sheet_.curves->mark_text = marks.size() == 1 ? "record in which something changed"
                                                   : "records in which something changed";
    }
    return std::move(sheet_);
  }

 private:
  record::Sheet sheet_;
};

const auto note = "Of the finest level.";

record::Axes axes(std::string quantity, bool is_log) {
  return {.log_y = is_log, .y = std::move(quantity), .note = note};
}

// "rk4, newmark", four at most.
std::string changed_names(const study::BaselineComparison& changes) {
  constexpr std::size_t most = 4;
  std::vector<std::string> names;
  for (const auto& change : changes.subjects)
    if (change.any() && std::ranges::find(names, change.name) == names.end())
      names.push_back(printable(change.name));
  const bool is_cut = names.size() > most;
  if (is_cut) names.resize(most);
  return fmt::format("{}{}", fmt::join(names, ", "), is_cut ? ", ..." : "");
}

// What changed last, and what the newest record says.
std::string answer(std::span<const record::Record> records, std::span<const std::string> names,
                   std::span<const study::BaselineComparison> changes) {
  const auto newest = fmt::format("The newest, {}: {}.", printable(names.back()),
                                  record::verdict_word(records.back()));
  const auto any = [](const auto& comparison) { return comparison.any(); };
  const auto count = std::ranges::count_if(changes, any);
  if (count == 0)
    return fmt::format("Nothing changed in {}. {}", counted(std::ssize(records), "record"), newest);
  std::size_t last = changes.size() - 1;
  while (!changes[last].any()) --last;
  const auto& subjects = changes[last].subjects;
  const auto more =
      count == 1 ? std::string()
                 : fmt::format(" Before that, {} brought changes.", counted(count - 1, "record"));
  return fmt::format(
      "From {} to {} {} of {} changed: {}.{} {}", printable(names[last]),
      printable(names[last + 1]), std::ranges::count_if(subjects, &study::SubjectChange::any),
      counted(std::ssize(subjects), "subject"), changed_names(changes[last]), more, newest);
}

class History {
 public:
  explicit History(std::string answer) { versions_.title = std::move(answer); }
  void add(const std::string& name, const record::Record& record,
           const study::BaselineComparison* changes) {
    ++number_;
    if (changes != nullptr && changes->any()) marks_.push_back(double(number_));
    versions_.rows.push_back({number_, name, record.provenance.date, record.provenance.version,
                              std::string(record::verdict_word(record))});
    for (const auto& problem : record.cases)
      for (const auto& subject : problem.subjects)
        add(problem.problem.name, subject, record.cases.size() > 1, changes);
    if (changes == nullptr) return;
    for (const auto& change : changes->subjects)
      if (change.presence == study::SubjectChange::Presence::gone)
        table_.rows.push_back({number_, change.case_name, change.name, Cell(), Cell(), Cell(),
                               change_texts(change).front()});
  }
  std::vector<record::Sheet> sheets(std::span<const std::string> names) {
    std::vector<record::Sheet> all{std::move(versions_), std::move(table_)};
    for (auto* curves : {&orders_, &errors_, &work_, &times_})
      if (!curves->empty()) all.push_back(curves->take(marks_, names));
    return all;
  }

 private:
  void add(const std::string& case_name, const record::Subject& subject, bool several,
           const study::BaselineComparison* changes) {
    const auto values = drawn(subject);
    const auto series = several ? fmt::format("{} on {}", subject.name, case_name) : subject.name;
    orders_.add(number_, series, values.order);
    errors_.add(number_, series, values.error);
    work_.add(number_, series, values.evaluations);
    times_.add(number_, series, values.seconds);
    const auto* change =
        changes != nullptr ? change_of(*changes, case_name, subject.name) : nullptr;
    const auto words = change == nullptr ? std::vector<std::string>() : change_texts(*change);
    table_.rows.push_back({number_, case_name, subject.name,
                           std::string(record::verdict_word(subject)), values.order, values.error,
                           fmt::format("{}", fmt::join(words, " "))});
  }

  long long number_ = 0;
  std::vector<double> marks_;
  record::Sheet versions_{"clackers/versions/1",
                          "",
                          {{"number", "", ""},
                           {"record", "", ""},
                           {"date", "", ""},
                           {"clackers", "", ""},
                           {"verdict", "", ""}},
                          {}};
  record::Sheet table_{"clackers/history/1",
                       "What each found, and what changed since the record before",
                       {{"number", "", ""},
                        {"case", "", ""},
                        {"subject", "", ""},
                        {"verdict", "", ""},
                        {"order", "", ""},
                        {"error", "", ""},
                        {"changed", "", ""}},
                       {}};
  Curves orders_{"clackers/order/1", "Order", axes("order", false)};
  Curves errors_{"clackers/error/1", "Error in u", axes("error in u", true)};
  Curves work_{"clackers/evaluations/1", "Force evaluations", axes("force evaluations", true)};
  Curves times_{"clackers/seconds/1", "Processor time", axes("seconds", true)};
};

}  // namespace

std::vector<record::Sheet> history_sheets(std::span<const record::Record> records,
                                          std::span<const std::string> names,
                                          std::span<const study::BaselineComparison> changes) {
  History history(answer(records, names, changes));
  for (std::size_t i = 0; i < records.size(); ++i)
    history.add(names[i], records[i], i > 0 ? &changes[i - 1] : nullptr);
  return history.sheets(names);
}

}  // namespace clackers::report
