#pragma once

#include <memory>
#include <string_view>
#include <tuple>
#include <vector>

#include "clackers/methods/contact/event_driven_loop.hpp"
#include "clackers/methods/contact/penalty.hpp"
#include "clackers/methods/contact/reversal.hpp"
#include "clackers/methods/pair.hpp"
#include "clackers/methods/parameters.hpp"
#include "clackers/methods/scheme.hpp"

namespace clackers::methods {

/// Every contact treatment that an integrator can be joined with.
using Treatments = std::tuple<EventDriven, Reversal, Penalty>;

/// A row of the registry: what is told of an integrator, and how it is joined with a treatment.
struct IntegratorRow {
  std::string_view name;
  Entry (*entry)(std::string_view card);
  /// Throws InputError for parameters; `treatment` is a name out of Treatments.
  std::shared_ptr<const Method> (*join)(const Settings& settings, std::string_view treatment,
                                        const Settings& of_treatment);
};

/// A row of the registry: a method that stands alone.
struct MethodRow {
  std::string_view name;
  Entry (*entry)(std::string_view card);
  std::shared_ptr<const Method> (*make)(const Settings& settings);
};

namespace detail {

template <class Integrator, class Treatment>
void join_if_named(std::shared_ptr<const Method>& to, const Integrator& integrator,
                   std::string_view name, const Settings& settings) {
  if (name != Treatment::name) return;
  using Scheme = Pair<Integrator, Treatment>;
  to = std::make_shared<SchemeMethod<Scheme>>(Scheme{integrator, configured<Treatment>(settings)});
}

template <class Integrator, class... Every>
std::shared_ptr<const Method> join(const Integrator& integrator, std::string_view treatment,
                                   const Settings& settings, std::tuple<Every...>*) {
  std::shared_ptr<const Method> joined;
  (join_if_named<Integrator, Every>(joined, integrator, treatment, settings), ...);
  return joined;
}

}  // namespace detail

/// Defined for an integrator by `template IntegratorRow integrator_row<Name>();` in its source
/// file, where all its step loops are compiled.
template <class Integrator>
IntegratorRow integrator_row() {
  return {Integrator::name,
          [](std::string_view card) { return entry_of<Integrator>("integrator", card); },
          [](const Settings& settings, std::string_view treatment, const Settings& of_treatment) {
            return detail::join(configured<Integrator>(settings), treatment, of_treatment,
                                static_cast<Treatments*>(nullptr));
          }};
}

/// The same for a method that stands alone.
template <class Alone>
MethodRow method_row() {
  return {Alone::name, [](std::string_view card) { return entry_of<Alone>("method", card); },
          [](const Settings& settings) -> std::shared_ptr<const Method> {
            return std::make_shared<SchemeMethod<Alone>>(configured<Alone>(settings));
          }};
}

}  // namespace clackers::methods
