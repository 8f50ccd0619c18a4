#include "clackers/exact/assembly/shaped_parameters.hpp"

#include <fmt/format.h>

#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/parameters.hpp"

namespace clackers::exact {

double require_whole(std::string_view who, std::string_view name, double value, double lowest,
                     double highest, std::string_view reason) {
  const auto rule = fmt::format("a whole number, {} <= {} <= {}", lowest, name, highest);
  if (!(value >= lowest && value <= highest)) refuse(who, name, value, rule, reason);
  if (value != std::floor(value)) refuse(who, name, value, rule, reason, "not-whole");
  return value;
}

double problem_bytes(double masses, double contacts) {
  return double(sizeof(double)) * masses * (3.0 * masses + contacts);
}

void require_problem_fits(std::string_view who, std::string_view name, double value, double masses,
                          double contacts) {
  const double bytes = problem_bytes(masses, contacts);
  if (bytes <= largest_problem) return;
  refuse(who, name, value, fmt::format("a problem of at most {} GB", largest_problem / 0x1p30),
         fmt::format("The mass, damping and stiffness matrices of {} masses and the rows of {} "
                     "contacts take {:.3g} GB.",
                     masses, contacts, bytes / 0x1p30));
}

double require_odd(std::string_view who, double X, std::string_view instead) {
  if (frequency_ratio(who, X).is_inverse)
    refuse(who, "X", X, fmt::format("an odd whole number from 1 to {:.0e}", largest_ratio), instead,
           "not-odd");
  return X;
}

}  // namespace clackers::exact
