#include "clackers/methods/contact/moreau_jean.hpp"

#include <fmt/format.h>

#include <limits>

#include "clackers/base/error.hpp"
#include "clackers/methods/contact/moreau_jean_loop.hpp"
#include "clackers/methods/rows.hpp"

namespace clackers::methods {

const std::vector<ParameterOf<MoreauJean>>& MoreauJean::parameters() {
  static const std::vector<ParameterOf<MoreauJean>> all = {
      member_parameter<&MoreauJean::theta, MoreauJean>("theta", "1/2 <= theta <= 1",
                                                       "weight of the end of the step")};
  return all;
}

void MoreauJean::validate() const {
  if (!(theta >= 0.5 && theta <= 1.0))
    refuse(name, "theta", theta, "1/2 <= theta <= 1",
           "Below 1/2 undamped motion grows at every step size; use theta = 0.5 for no numerical "
           "dissipation.");
}

Facts MoreauJean::facts() const {
  return {spelled(*this),
          theta == 0.5 ? 2.0 : 1.0,
          true,
          std::numeric_limits<double>::infinity(),
          {Behaviour::irregular, 1.0, {}},
          true};
}

std::optional<Objection> MoreauJean::objection(const model::ImpactProblem<>& problem) const {
  const auto who = spelled(*this);
  if (problem.system.nonlinear)
    return Objection{
        fmt::format("{} with a nonlinear force: its step is one linear equation. Use a "
                    "method that iterates, such as newmark+event-driven.",
                    who),
        "linear-only"};
  return objection_to_closed_contacts(who, problem);
}

template MethodRow method_row<MoreauJean>();

}  // namespace clackers::methods
