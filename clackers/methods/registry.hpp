#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/methods/method.hpp"

namespace clackers::methods {

/// One `name=value` that a method's specification may carry.
struct Parameter {
  std::string name, default_value;  ///< the default, as it would be typed
  std::string allowed;              ///< "0 <= rho <= 1"
  std::string meaning;              ///< with its unit
};

/// What `clackers list` and `clackers show` tell of an integrator or a contact treatment.
struct Entry {
  std::string name;     ///< "newmark"
  std::string kind;     ///< "integrator", "contact" or "method" (brings its own integration)
  std::string summary;  ///< one line
  std::vector<Parameter> parameters;
  std::string card;  ///< the card of its header, as text
};

/// Everything registered, integrators first, then contact treatments, then whole methods.
std::span<const Entry> entries();

/// The method of a specification such as "newmark:beta=0.25+penalty:stiffness=1e6"; the grammar is the
/// command line's. Without "+contact" the treatment is event-driven. Throws InputError with
/// did-you-mean for names, and for parameters outside their range.
std::shared_ptr<const Method> method(std::string_view specification);

/// Every integrator joined with every treatment that takes it, and the methods that stand alone,
/// all with default parameters: the specifications.
std::vector<std::string> pairs();

/// The specifications judged when none is named: one of each kind.
std::vector<std::string> default_panel();

}  // namespace clackers::methods
