#pragma once

#include <iosfwd>
#include <span>
#include <string_view>

#include "clackers/report/write.hpp"

namespace clackers::report {

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

/// {"schema", "problem", "sheets": [as above]}; `problem` is the text of a json object, or empty for
/// none.
void write_json(std::span<const record::Sheet> sheets, std::string_view schema,
                std::string_view problem, std::ostream& out);

}  // namespace clackers::report
