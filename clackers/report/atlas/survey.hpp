#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "clackers/measure/errors/score.hpp"
#include "clackers/report/atlas.hpp"

namespace clackers::report {

/// A case with values of its parameters: a column of the matrix.
struct SurveySystem {
  std::string name;  ///< of the case
  std::vector<std::pair<std::string, record::Cell>> settings;

  /// "N=2,xi1=0.05", as --set reads it; empty without any.
  std::string settings_text() const;
  bool operator==(const SurveySystem&) const = default;
};

/// A row of the matrix.
struct SurveyMethod {
  std::string name, treatment;
  std::size_t part = 0;

  bool operator==(const SurveyMethod&) const = default;
};

/// A cell of the matrix.
struct SurveySubject {
  std::size_t method = 0, system = 0;
  std::size_t part = 0, row = 0;  ///< of its sheet of subjects
  measure::Ladder ladder;         ///< empty for a method that was refused
  bool by_tolerance = false;
};

/// The rows of all parts, put together.
struct Survey {
  std::vector<SurveySystem> systems;    ///< in the order in which they are met
  std::vector<SurveyMethod> methods;    ///< the same
  std::vector<SurveySubject> subjects;  ///< part by part, in the order of their rows
};
/// Throws as atlas_page().
Survey survey_of(std::span<const AtlasPart> parts);

/// Reads cells by the names of their columns. Rows may come from anybody: what no page can show throws
/// InputError (not-a-number, out-of-range, unknown-name).
class NamedCells {
 public:
  /// `who` stands in messages: "FILE: runs".
  NamedCells(const std::vector<record::Column>& columns, std::string who);
  /// Text of a column that may be missing or empty; of behaviours and verdicts one of their words.
  std::string text(const std::vector<record::Cell>& row, const std::string& column) const;
  /// A number, 0 or more but for an order; NaN where there is none.
  double number(const std::vector<record::Cell>& row, const std::string& column) const;
  /// 0 where there is none; up to `most`.
  long long whole(const std::vector<record::Cell>& row, const std::string& column,
                  double most = 1e15) const;
  const std::string& who() const { return who_; }

 private:
  const record::Cell* find(const std::vector<record::Cell>& row, const std::string& column) const;

  std::map<std::string, std::size_t, std::less<>> places_;
  std::string who_;
};

}  // namespace clackers::report
