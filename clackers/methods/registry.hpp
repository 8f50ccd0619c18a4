#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/parameter.hpp"
#include "clackers/methods/integrator.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/treatment.hpp"

namespace clackers::methods {

/// What `clackers list` and `clackers show` print of an integrator or a contact treatment.
struct Entry {
  std::string name;     ///< "newmark"
  std::string kind;     ///< "integrator", "contact" or "method" (brings its own integration)
  std::string summary;  ///< one line
  std::vector<Parameter> parameters;
  std::string card;  ///< formula, order, stability, dissipation, memory, cost, source
};

/// A row of the registry: its entry, and how it is made of its parameters. One of the functions is
/// there; each throws InputError for parameters.
struct Row {
  Entry entry;
  std::function<std::shared_ptr<const Integrator>(const Settings&)> integrator;
  std::function<std::shared_ptr<const Treatment>(const Settings&)> treatment;
  std::function<std::shared_ptr<const Method>(const Settings&)> method;  ///< stands alone
};

/// The contact treatment of a specification that names none.
inline constexpr std::string_view default_treatment = "event-driven";

/// The name of a method in every output: as one would type it, without "+event-driven".
std::string short_name(const std::string& specification);

/// Everything registered, integrators first, then contact treatments, then whole methods.
std::span<const Entry> entries();

/// The card of everything registered; empty for another name.
std::string_view card(std::string_view name);

/// The integrator of a specification such as "newmark:beta=0.25", without a contact treatment. Throws
/// InputError like method().
std::shared_ptr<const Integrator> integrator(std::string_view specification);

/// The method of a specification such as "newmark:beta=0.25+penalty:stiffness=1e6"; the grammar is
/// the command line's. Without "+contact" the treatment is event-driven. Throws InputError with
/// did-you-mean for names, and for parameters outside their range.
std::shared_ptr<const Method> method(std::string_view specification);

/// Every integrator joined with every treatment that takes it, and the standalone methods,
/// all with default parameters; and every other variant of a treatment with the implicit and the
/// explicit integrator that begin the default panel: the specifications.
std::vector<std::string> pairs();

/// An entry with one of its parameters set to a word: "penalty:law=hertz".
struct Variant {
  std::string specification, summary;
};

/// The variants of an entry, without those that its defaults give.
std::vector<Variant> variants(const Entry& entry);

/// The specifications assessed when none is named: one of each kind.
std::vector<std::string> default_panel();

}  // namespace clackers::methods
