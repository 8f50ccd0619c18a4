#include "cli/commands/dials.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"
#include "cli/values.hpp"

namespace clackers::cli {

report::Dials dials_of(const cases::Case& test_case) {
  const auto& name = test_case.entry->name;
  const auto value = [&](const char* of) { return double(value_of(test_case.values, of)); };
  if (name == "three-parameter")
    return {4.0 * value("N") + 1.0, value("xi1"), value("a_t"), 3.0, 1.0};
  if (name != "synchronized-pair")
    throw InputError("explore has dials for three-parameter and synchronized-pair, not for " +
                         name + ". Its motion: clackers respond " + name + " --report page.html",
                     "no-closed-form");
  for (const auto* fixed : {"m1", "k1", "A"})
    if (value(fixed) != 1.0)
      throw InputError(
          fmt::format("explore: {} = {}; the dials are for m1 = 1 kg, k1 = 1 N/m and A = 1 m.",
                      fixed, value(fixed)),
          "out-of-range");
  if (value("X") < 1.0 || value("eta") == 0.0)
    throw InputError("explore: X must be 1 or more and eta above 0; see clackers respond.",
                     "out-of-range");
  return {value("X"), value("xi1"), value("t_end") / 20.0, value("r"), value("eta")};
}

std::optional<report::Dials> usual_dials(const cases::Case& test_case) try {
  const auto dials = dials_of(test_case);
  const bool is_usual = dials.X <= 41.0 && dials.xi1 <= 0.3 && dials.a_t <= 5.0 && dials.r <= 4.5;
  return is_usual ? std::optional(dials) : std::nullopt;
} catch (const InputError&) {
  return {};
}

}  // namespace clackers::cli
