#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "clackers/base/parameter.hpp"

namespace clackers::methods {

/// A name with the parameters typed behind it.
struct Term {
  std::string name;
  Settings settings;
};

/// A method as typed, name[:parameter=value,...][+name[:parameter=value,...]].
struct MethodSpecification {
  Term first;                   ///< an integrator, or a standalone method
  std::optional<Term> contact;  ///< what follows the "+"
};

/// Takes a specification apart; a "+" separates only before a letter, so 1e+6 is a number. Names are
/// not looked up. Throws InputError for text outside the grammar and values that are neither a finite
/// number nor a word: a small letter, then small letters, digits and hyphens.
MethodSpecification parse_specification(std::string_view text);

/// The texts that a "+" before a letter separates: "newmark:beta=0" and "penalty:law=hertz".
std::vector<std::string_view> terms_of(std::string_view text);

/// The reverse for one name: the parameters that differ from their default, those that are NaN left
/// out.
std::string specification(std::string_view name, std::span<const Parameter> parameters,
                          const Settings& values);

}  // namespace clackers::methods
