#pragma once

#include <iosfwd>
#include <vector>

#include "clackers/record/sheet.hpp"
#include "paper/figure.hpp"

namespace clackers::paper {

/// The numbers behind a figure as csv, unreduced: panel,series,x_name,x,y_name,y; numbers read back
/// to the same double. A vertical line has an empty y.
void write_csv(const Figure& figure, std::ostream& out);

/// Every claim of the figures with its verdict, a row each.
record::Sheet claims_of(const std::vector<Figure>& figures);

/// What `clackers list figures` shows.
record::Sheet list_figures();

/// "holds", "holds in part" (see Claim) or "differs".
const char* verdict_of(const Claim& claim);

}  // namespace clackers::paper
