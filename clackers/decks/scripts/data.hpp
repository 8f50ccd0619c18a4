#pragma once

#include <string>
#include <string_view>

#include "clackers/model/impact_problem.hpp"

namespace clackers::decks {

/// How a language writes numbers.
struct Syntax {
  std::string_view comment;    ///< "#"
  std::string_view table;      ///< a matrix by rows, with @name@, @values@ and @columns@
  std::string_view vector;     ///< a list, with @name@ and @values@
  std::string_view number;     ///< with @name@ and @value@
  std::string_view line;       ///< what ends a line within a list: "", " ..."
  std::string_view nothing{};  ///< the values of an empty list
};

/// A table of its own.
std::string list_of(std::string_view name, const Eigen::MatrixXd& rows, const Syntax& syntax);

/// The problem as assignments in a language: M, C, K, u0, v0, t0, last, and the tables contacts, springs
/// and loads, each with comments. Throws InputError (linear-only) for forces that are no numbers.
std::string data(const model::ImpactProblem<>& problem, const Syntax& syntax);

}  // namespace clackers::decks
