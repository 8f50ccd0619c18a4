#pragma once

#include <cstddef>
#include <vector>

#include "clackers/model/impact_problem.hpp"

namespace clackers::exact {

/// The equations B u = gap of contacts that stay closed, solved for as many displacements, the pivots: that
/// of row k is gaps[k] - sum over the others of shares[k][i] u_i. Forces p of the contacts that give B' p = r
/// are p_j = sum over k of inverse[k][j] r_pivot. By Gauss and Jordan's elimination with the largest
/// pivots; directions such as (1, -1, 0) stay exact.
template <class Number>
struct HeldContacts {
  using Row = std::vector<Number>;

  std::vector<std::size_t> pivots;
  std::vector<bool> is_pivot;  ///< of each displacement
  std::vector<Row> shares, inverse;
  Row gaps;

  /// `contacts` have linearly independent directions; size(x) is about |x|.
  HeldContacts(const std::vector<model::Contact<>>& contacts, std::size_t dof, auto&& size)
      : is_pivot(dof), inverse(contacts.size(), Row(contacts.size(), Number(0.0))) {
    const auto count = contacts.size();
    for (std::size_t k = 0; k < count; ++k) {
      shares.emplace_back(contacts[k].direction.begin(), contacts[k].direction.end());
      inverse[k][k] = Number(1.0);
      gaps.emplace_back(contacts[k].gap);
    }
    for (std::size_t k = 0; k < count; ++k) {
      std::size_t column = 0;
      for (std::size_t i = 1; i < dof; ++i)
        if (size(shares[k][i]) > size(shares[k][column])) column = i;
      pivots.push_back(column);
      is_pivot[column] = true;
      const Number pivot = shares[k][column];
      for (auto* row : {&shares[k], &inverse[k]})
        for (auto& entry : *row) entry = entry / pivot;
      gaps[k] = gaps[k] / pivot;
      for (std::size_t other = 0; other < count; ++other) {
        if (other == k) continue;
        const Number share = shares[other][column];
        subtract(shares[other], share, shares[k]);
        subtract(inverse[other], share, inverse[k]);
        gaps[other] = gaps[other] - share * gaps[k];
      }
    }
  }

 private:
  static void subtract(Row& from, const Number& share, const Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i) from[i] = from[i] - share * row[i];
  }
};

}  // namespace clackers::exact
