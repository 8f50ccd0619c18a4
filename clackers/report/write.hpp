#pragma once

#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/record.hpp"
#include "clackers/record/sheet.hpp"
#include "clackers/study/baseline.hpp"

namespace clackers::report {

enum class Format { table, csv, json, npy, junit, latex };

/// What there is to write: rows, rows of numbers alone, or a record.
enum class Content { rows, numbers, verdicts };

/// Name of a format and what it is, for the help.
struct FormatNote {
  std::string_view name, note;
};
std::vector<FormatNote> formats_of(Content content);

/// Throws InputError with did-you-mean for any text but the formats of the content.
Format format_from(std::string_view text, Content content = Content::rows);

/// How a table may look on the terminal at hand.
struct Style {
  bool color = false;
  int width = 80;
  bool all_metrics = false;         ///< of histories, not only those marked for reports
  bool impacts = false;             ///< of histories, as a table
  std::vector<std::string> only{};  ///< verdicts to show, "disagrees"; empty: all
};

/// Rows, one by one: a table at 80 columns, csv with a header line, or json with the schema, the
/// columns and the rows, or NumPy's file. Numbers of csv and json read back to the same double.
void write(record::RowSource& rows, Format format, std::ostream& out, const Style& style = {});

/// Several sheets, one below the other, curves of tables as pictures of characters; json: one object whose "sheets" holds all. `schema` names
/// it; `members`, the text of further ones such as "problem": {...}, stands in it as well.
void write(std::span<const record::Sheet> sheets, std::string_view schema, Format format,
           std::ostream& out, const Style& style = {}, std::string_view members = {});

/// A record of verify or check, of one case or several: tables with findings and a last line with
/// the verdict, a csv row for every run, its json, JUnit XML, or LaTeX tables. The formats that
/// shows_changes names also show what changed since a baseline.
void write(const record::Record& record, Format format, std::ostream& out, const Style& style = {},
           const study::BaselineComparison* changes = nullptr);
bool shows_changes(Format format);

/// What changed since a baseline: a summary, and a line for each change.
void write_changes(const study::BaselineComparison& changes, std::ostream& out,
                   const Style& style = {});

/// A record as one self-contained page that opens without a network.
std::string html(const record::Record& record, const study::BaselineComparison* changes = nullptr);

/// Where the dials of the page of `clackers explore` stand at first: a synchronized pair of
/// m1 = 1 kg, k1 = 1 N/m and u1(0) = 1 m over 20 a_t seconds.
struct Dials {
  double X = 9.0, xi1 = 0.05, a_t = 1.0, r = 3.0, eta = 1.0;
};

/// Sheets as such a page: tables, texts, and figures of the curves; `name` is what they are about.
/// With the `motion` of a case, which has no subjects, its response and animation stand first; with
/// `dials` they, and runs of methods, move with these.
std::string html(std::span<const record::Sheet> sheets, const std::string& name,
                 const record::Provenance& from, const record::CaseRecord* motion = nullptr,
                 const std::string& command = "show", const std::optional<Dials>& dials = {});

/// A page whose dials move the exact motion of a synchronized pair, and runs of methods beside it.
std::string explore(const Dials& dials, const record::Provenance& from);

/// Figures draw the displacements of this many masses at most, the first ones, and say so.
inline constexpr std::size_t most_drawn_masses = 9;

/// The displacements as a picture of characters, masses marked 1, 2, ..., impacts on the axis.
std::string plot(const record::Curve& response, std::span<const double> impact_times,
                 const Style& style = {});

}  // namespace clackers::report
