#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "clackers/record/record.hpp"
#include "clackers/record/sheet.hpp"

// The page of a campaign: a matrix of verdicts, methods by rows and systems by columns.
namespace clackers::report {

/// Results from one place: rows as a campaign's database has them. Both have the column "task", by
/// which a run belongs to a subject; `subjects` also has "set_NAME" for the parameters of its case.
/// Columns that the page does not show may be missing or left out.
struct AtlasPart {
  const record::Sheet* subjects = nullptr;
  record::RowSource* runs = nullptr;
  std::string file{};         ///< of both, in messages
  std::string origin{};       ///< who computed it; empty: the campaign of the page itself
  record::Provenance from{};  ///< of the runs
  std::string options{};      ///< of `clackers verify`, for the same steps: "--levels 5"
  /// What a command line says for a method that is no name of the catalogue: "--exec './solver {h}'". The
  /// page shows it as its author's, not to be copied unread.
  std::map<std::string, std::string> calls{};
};

/// What the page says beside its parts.
struct AtlasText {
  std::string command;        ///< "atlas" or "campaign report"
  std::string heading, lead;  ///< text
  std::string specification;  ///< of the campaign, as it was read
  record::Provenance from;    ///< who writes the page; its command writes it again
};

/// More cells than this, methods times systems, are more than a reader or a browser takes in.
inline constexpr long long most_cells = 20000;
/// Throws InputError (too-many-rows) for more.
void require_few_cells(long long cells);

/// One self-contained page that opens without a network: the matrix, and for each cell its
/// convergence, for each method maps over the parameters, for each system the Pareto front, and
/// performance profiles. Figures are drawn when they are asked for. Throws InputError for parts without
/// a subject, for more than most_cells, for a part that names a method on a system twice, and as
/// NamedCells does.
std::string atlas_page(std::span<const AtlasPart> parts, const AtlasText& text);

}  // namespace clackers::report
