#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/record.hpp"
#include "clackers/record/sheet.hpp"
#include "clackers/report/groups.hpp"

// The one table of columns. Every output takes its names, units, meanings and values from here.
namespace clackers::report {

/// What a row of a table is about: a run, the worst of a level, or a subject by the worst of its
/// finest level.
struct Row {
  const record::CaseRecord* problem = nullptr;
  const record::Subject* subject = nullptr;
  int level = 0;                     ///< 1 is the coarsest; 0 of a subject
  record::LevelScore score;          ///< of one run: that run; NaN without any
  const record::Run* run = nullptr;  ///< of a run alone: its file and its metrics
};

Row run_row(const record::CaseRecord& problem, const record::Subject& subject, int level,
            const record::Run& run);
Row level_row(const record::CaseRecord& problem, const record::Subject& subject, int level);
Row subject_row(const record::CaseRecord& problem, const record::Subject& subject);

/// How the values of a column are shown to a person; csv, json and JUnit have them as they are.
enum class Kind {
  name,     ///< of a case, a subject or a file
  word,     ///< or a short text
  verdict,  ///< a word with a colour
  number,   ///< with few digits
  error,    ///< with a power of ten
  count,
};
/// Numbers stand to the right.
constexpr bool is_number(Kind kind) { return kind >= Kind::number; }

struct Column {
  std::string_view name, unit;  ///< in csv, json and JUnit; unit empty when dimensionless
  std::string_view heading;     ///< of tables for people
  std::string_view brief;       ///< the same where space is short; empty: the heading itself
  std::string_view meaning;
  Kind kind;
  bool in_rows;  ///< false: for tables alone, composed of other columns
  record::Cell (*get)(const Row&);

  std::string_view brief_heading() const { return brief.empty() ? heading : brief; }
};

/// All, in the order of csv.
std::span<const Column> columns();
/// One by its name. Throws std::logic_error for a name that no column has.
const Column& column(std::string_view name);

/// Whether all runs of a subject have the same value; these columns stand before the others.
bool is_of_subject(const Column& column);

/// A table for people.
struct Table {
  /// Above the rows of a group.
  struct Head {
    std::size_t row;  ///< the first of the group
    SubjectGroup group;
  };

  std::vector<const Column*> columns;
  std::vector<Row> rows;
  std::vector<Head> heads{};  ///< empty: the rows are no groups
};
/// A row a subject of the kind, in the order of groups_of(); for histories a row a file. `only` as
/// there.
Table summary_table(const record::CaseRecord& problem, record::SubjectKind kind,
                    const std::vector<std::string>& only = {});
/// The levels of one subject.
Table level_table(const record::CaseRecord& problem, const record::Subject& subject);

/// Every run of the cases as a row, a subject without runs as one row with its refusal. Metrics of
/// any run are columns "metric:NAME" behind the others.
record::Sheet run_sheet(std::span<const record::CaseRecord> cases, bool with_metrics = true);

/// The impacts of the subject's finest history as its rows show them.
record::Sheet impact_sheet(const record::Subject& subject);

/// What `clackers list columns` shows.
record::Sheet list_columns();

}  // namespace clackers::report
