#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/parameter.hpp"
#include "clackers/methods/method.hpp"

namespace clackers::methods {

/// What `clackers list` and `clackers show` print of an integrator or a contact treatment.
struct Entry {
  std::string name;     ///< "newmark"
  std::string kind;     ///< "integrator", "contact" or "method" (brings its own integration)
  std::string summary;  ///< one line
  std::vector<Parameter> parameters;
  std::string card;  ///< the card of its header, as text
};

/// A row of the registry: the entry of a type, and how a method is made of it.
struct Row {
  Entry entry;
  /// Of an integrator the method with this treatment, empty for an unknown treatment; of a standalone
  /// method the method itself; nullptr for a contact treatment. Throws InputError for
  /// parameters.
  std::shared_ptr<const Method> (*make)(const Settings& settings, std::string_view treatment,
                                        const Settings& of_treatment);
};

/// The row of a type, defined in rows.hpp and compiled in the source of the type.
template <class T>
Row row();

/// Everything registered, integrators first, then contact treatments, then whole methods.
std::span<const Entry> entries();

/// The card of a method as it stands above its type, taken from the header at build time. Empty for
/// a name that is not registered.
std::string_view card(std::string_view name);

/// The method of a specification such as "newmark:beta=0.25+penalty:stiffness=1e6"; the grammar is
/// the command line's. Without "+contact" the treatment is event-driven. Throws InputError with
/// did-you-mean for names, and for parameters outside their range.
std::shared_ptr<const Method> method(std::string_view specification);

/// Every integrator joined with every treatment that takes it, and the standalone methods,
/// all with default parameters: the specifications.
std::vector<std::string> pairs();

/// The specifications assessed when none is named: one of each kind.
std::vector<std::string> default_panel();

}  // namespace clackers::methods
