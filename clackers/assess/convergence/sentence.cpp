#include "clackers/assess/convergence/sentence.hpp"

#include <fmt/format.h>

#include "clackers/base/codes.hpp"

namespace clackers::assess {
namespace {

std::string range(const LadderFit& fit) {
  return fmt::format("from h = {:.3g} s to {:.3g} s", fit.steps[std::size_t(fit.first_level)],
                     fit.steps[std::size_t(fit.last_level)]);
}

std::string order(const LadderFit& fit) {
  return fmt::format("h^{:.2f} (+- {:.2f})", fit.order, fit.spread);
}

std::string because(const std::string& reason) {
  const auto* entry = find_code(reason);
  return entry == nullptr ? std::string() : fmt::format(" {}", entry->meaning);
}

}  // namespace

std::string describe(const LadderFit& fit, std::string_view what) {
  switch (fit.behaviour) {
    case Behaviour::exact:
      return fmt::format("The {} lies at the rounding floor at every level.", what);
    case Behaviour::proper:
    case Behaviour::reduced:
      return fmt::format("The {} falls as {} {}.", what, order(fit), range(fit));
    case Behaviour::irregular:
      return fmt::format(
          "The {} scatters by a factor of {:.2g} between neighbouring steps; its upper envelope "
          "falls as {} {}.",
          what, fit.scatter, order(fit), range(fit));
    case Behaviour::stagnating:
      return fmt::format("The {} stays at {:.2g} {}.{}", what, fit.floor, range(fit),
                         because(fit.reason));
    case Behaviour::divergent:
      return fmt::format("The method diverges.{}", because(fit.reason));
    case Behaviour::undecided:
      break;
  }
  return fmt::format("Nothing can be said.{}", because(fit.reason));
}

std::string describe(const Claim& claim) {
  switch (claim.behaviour) {
    case Behaviour::proper:
    case Behaviour::reduced:
      return fmt::format("{} of order {:g}", to_string(claim.behaviour), claim.order);
    case Behaviour::irregular:
      return fmt::format("irregular with an envelope of order {:g}", claim.order);
    case Behaviour::undecided:
      return "nothing";
    default:
      break;
  }
  const auto reason = claim.reason.empty() ? std::string() : fmt::format(" ({})", claim.reason);
  return fmt::format("{}{}", to_string(claim.behaviour), reason);
}

}  // namespace clackers::assess
