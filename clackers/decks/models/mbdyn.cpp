#include <fmt/format.h>

#include <cmath>

#include "clackers/base/number.hpp"
#include "clackers/decks/models/network.hpp"
#include "clackers/decks/rows.hpp"

namespace clackers::decks {
namespace {

// Nodes stand in a line, as far apart; the ground is at 0.
constexpr double line = 1000.0;

double place_of(int mass) { return line * (mass + 1); }

// A rod between two nodes, whose law has strains.
std::string rod(const Network& network, int label, int first, int second, double length,
                const std::string& law) {
  const auto node = [&](int mass) {
    return mass == ground ? int(network.masses.size()) + 1 : mass + 1;
  };
  return fmt::format("  joint: {}, rod, {}, {}, {}, {};\n", label, node(first), node(second),
                     exact_number(length), law);
}

std::string rods(const Network& network, int& label) {
  std::string text;
  for (const auto& link : network.links) {
    const double length = place_of(link.mass) - place_of(link.other);
    text += rod(
        network, ++label, link.mass, link.other, std::abs(length),
        fmt::format("linear viscoelastic, {}, {}", exact_number(link.stiffness * std::abs(length)),
                    exact_number(link.damping * std::abs(length))));
  }
  // No stiffness between two strains; of a pair that stands in the other order elongation closes the gap.
  for (const auto& stop : network.one_sided()) {
    const double length = place_of(stop.upper) - place_of(stop.lower);
    const double strain = stop.gap / length;
    const bool in_order = length > 0.0;
    text += rod(network, ++label, stop.upper, stop.lower, std::abs(length),
                fmt::format("double linear elastic, 0., {}, {}, {}",
                            in_order ? "1e6" : exact_number(strain),
                            in_order ? exact_number(strain) : "-1e6",
                            exact_number(stop.stiffness * std::abs(length))));
  }
  return text;
}

}  // namespace

std::vector<DeckFile> mbdyn(const Subject& subject) {
  const auto& problem = subject.problem;
  const auto network = network_of(subject, "mbdyn", {.loads = true});
  const auto levels = compliant_steps(network, problem);
  const auto n = int(network.masses.size());
  const auto h = exact_number(levels[0].value);
  std::string nodes, bodies, forces;
  for (int i = 0; i < n; ++i) {
    nodes += fmt::format("  structural: {}, dynamic displacement, {}, 0., 0., {}, 0., 0.;\n", i + 1,
                         exact_number(place_of(i) + problem.start.u[i]),
                         exact_number(problem.start.v[i]));
    bodies += fmt::format("  body: {0}, {0}, {1};\n", i + 1,
                          exact_number(network.masses[std::size_t(i)]));
  }
  nodes +=
      fmt::format("  structural: {}, static, 0., 0., 0., eye, 0., 0., 0., 0., 0., 0.;\n", n + 1);
  int joint = 0;
  auto joints = rods(network, joint);
  joints += fmt::format("  joint: {}, clamp, {}, node, node;\n", ++joint, n + 1);
  for (int number = 0; const auto& load : network.loads)
    forces += fmt::format(
        "  force: {}, absolute displacement, {}, 1., 0., 0., string, \"{}*cos({}*Time+{})\";\n",
        ++number, load.dof + 1, exact_number(load.amplitude), exact_number(load.frequency),
        exact_number(load.phase));
  const auto text = fmt::format(
      "{}# {}\n# A rod has strains: its stiffness is that of the spring times its length.\n"
      "begin: data;\n  problem: initial value;\nend: data;\n\n"
      "begin: initial value;\n  initial time: {};\n  final time: {};\n  time step: {};\n"
      "  method: crank nicolson;\n  tolerance: 1e-8;\n  max iterations: 50;\n"
      "  derivatives tolerance: 1e-6;\n  derivatives max iterations: 50;\nend: initial value;\n\n"
      "begin: control data;\n  skip initial joint assembly;\n  structural nodes: {};\n"
      "  rigid bodies: {};\n  joints: {};\n  forces: {};\nend: control data;\n\n"
      "begin: nodes;\n{}end: nodes;\n\nbegin: elements;\n{}{}{}end: elements;\n",
      head(subject, "mbdyn", "#"), stiffness_note(network), exact_number(problem.start.t),
      exact_number(problem.end), h, n + 1, n, joint, network.loads.size(), nodes, bodies, joints,
      forces);
  // Displacements of the positions; the last mass ends a time.
  const auto solve = fmt::format(
      "sed \"s/time step: .*;/time step: $2;/\" model.mbd > \"$1.mbd\"\n"
      "  mbdyn -s -f \"$1.mbd\" -o \"$1\" > \"$1.log\"\n"
      "  awk -v h=\"$2\" 'BEGIN {{ OFMT = CONVFMT = \"%.17g\"; printf \"t\"; for (i = 1; i <= {0}; ++i) "
      "printf \",u%d,v%d\", i, i; print \"\" }}\n"
      "    $1 == 1 {{ printf \"%.17g\", {1} + k++ * h }} $1 <= {0} {{ printf \",%.17g,%s\", $2 - {2} * "
      "($1 + 0), $8 }} $1 == {0} {{ print \"\" }}' \"$1.mov\" > \"$1.csv\"",
      n, exact_number(problem.start.t), line);
  return {{"model.mbd", text},
          run_script(subject, levels, solve, ".csv", compliant_claim(network))};
}

}  // namespace clackers::decks
