#pragma once

#include <iosfwd>
#include <span>
#include <string_view>

#include "clackers/report/write.hpp"

namespace clackers::report {

/// A record for a person, at most style.width characters a line: of each case a table of methods,
/// one of histories with the metrics of the finest, and a sentence for each finding; of several cases
/// the performance profile; what changed since a baseline; a last line with the verdict and the next
/// command.
void write_text(const record::Record& record, std::ostream& out, const Style& style,
                const study::BaselineComparison* changes);

/// A record as LaTeX fragments for \input: of each case a table of its methods (tab:clackers-CASE)
/// and one of its histories (tab:clackers-check-CASE), with the package booktabs. Findings are notes
/// below.
void write_latex(const record::Record& record, std::ostream& out, const Style& style,
                 const study::BaselineComparison* changes);

/// A record as JUnit XML, which continuous-integration systems show: a suite a case, a test a
/// subject. A subject that disagrees is a failure with its finding; one that refused the case or
/// stays undecided is skipped with the reason; one that was interrupted is an error. `time` is
/// processor time [s]. What was measured stands in properties, as numbers that read back to the same
/// double. What changed since a baseline is the output of the suite.
void write_junit(const record::Record& record, std::ostream& out, const Style& style,
                 const study::BaselineComparison* changes);

// The ways to write rows. All read row by row, or block by block where the rows are numbers, and
// stop early when the stream fails. csv and json never print -0.

/// At most style.width characters a line: numbers to the right with at most six significant digits,
/// units below the names, long text wrapped. The widths are those of the first 1000 rows; a later
/// number that needs more gives up digits. Where even three digits do not fit, a row becomes a
/// block of lines "name: value unit".
void write_table(record::RowSource& rows, std::ostream& out, const Style& style);

/// RFC 4180 with line feeds: a header line, text quoted where it must be.
void write_csv(record::RowSource& rows, std::ostream& out);

/// {"schema", "title", "columns": [{"name", "unit", "meaning"}], "rows": [[...]]}, a row a line.
/// What is empty is null; infinities and NaN, which json does not have, are the texts "inf",
/// "-inf", "nan".
void write_json(record::RowSource& rows, std::ostream& out);

/// NumPy's file, version 1.0: a structured array of float64, one field a column, so that
/// numpy.load(FILE)["u1"] is a column and names are never separated from numbers. A side is -1, 0
/// or 1. Throws InputError for rows that hold text.
void write_npy(record::RowSource& rows, std::ostream& out);

/// {"schema", members, "sheets": [as above]}; `members` is their text, "problem": {...}, or empty.
void write_json(std::span<const record::Sheet> sheets, std::string_view schema,
                std::string_view members, std::ostream& out);

}  // namespace clackers::report
