#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "clackers/decks/models/network.hpp"
#include "clackers/decks/rows.hpp"

namespace clackers::decks {
namespace {

constexpr auto simulate = R"c(@head@// Build: cc simulate.c -lmujoco -lm
// Usage: ./simulate model.xml STEP HISTORY.csv
#include <math.h>
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>

// mass, amplitude [N], frequency [rad/s], phase
static const double loads[][4] = {@loads@{0}};

int main(int count, char** words) {
  char error[1000] = "";
  if (count < 4) return 2;
  mjModel* m = mj_loadXML(words[1], NULL, error, sizeof error);
  FILE* file = fopen(words[3], "w");
  if (m == NULL || file == NULL) {
    fprintf(stderr, "%s\n", error);
    return 2;
  }
  mjData* d = mj_makeData(m);
  mj_resetDataKeyframe(m, d, 0);  // without it the masses start at rest
  const double start = d->time, last = @last@;
  const long steps = lround((last - start) / atof(words[2]));
  m->opt.timestep = (last - start) / steps;
  fputc('t', file);
  for (int i = 0; i < m->nv; ++i) fprintf(file, ",u%d", i + 1);
  for (int i = 0; i < m->nv; ++i) fprintf(file, ",v%d", i + 1);
  for (long k = 0;; ++k) {
    const double t = start + (last - start) * k / steps;
    fprintf(file, "\n%.17g", t);
    for (int i = 0; i < m->nv; ++i) fprintf(file, ",%.17g", d->qpos[i]);
    for (int i = 0; i < m->nv; ++i) fprintf(file, ",%.17g", d->qvel[i]);
    if (k == steps) break;
    mju_zero(d->qfrc_applied, m->nv);
    for (const double* load = loads[0]; load[0] > 0.0; load += 4)
      d->qfrc_applied[(int)load[0] - 1] += load[1] * cos(load[2] * t + load[3]);
    mj_step(m, d);
  }
  fputc('\n', file);
  return fclose(file) == 0 ? 0 : 1;
}
)c";

std::string ends(int plus, int minus) {
  std::string text;
  if (plus != ground) text += fmt::format("<joint joint=\"u{}\" coef=\"1\"/>", plus + 1);
  if (minus != ground) text += fmt::format("<joint joint=\"u{}\" coef=\"-1\"/>", minus + 1);
  return text + "</fixed>\n";
}

std::string numbers(const Eigen::VectorXd& values) {
  return fmt::format("{}", fmt::join(values.begin(), values.end(), " "));
}

}  // namespace

std::vector<DeckFile> mujoco(const Subject& subject) {
  const auto& problem = subject.problem;
  const auto network =
      network_of(subject, "mujoco", {.restitution = true, .loads = true, .springs = false});
  const auto levels = compliant_steps(network, problem);
  auto xml = fmt::format(
      "<!--\n{}  {}\n-->\n<mujoco>\n  <option timestep=\"{}\" gravity=\"0 0 0\"/>\n  <worldbody>\n",
      head(subject, "mujoco", " "), stiffness_note(network), levels[0].value);
  for (std::size_t i = 0; i < network.masses.size(); ++i)
    xml += fmt::format(
        "    <body><joint name=\"u{}\" type=\"slide\" axis=\"1 0 0\"/><inertial pos=\"0 0 0\" mass=\"{}\" "
        "diaginertia=\"1 1 1\"/></body>\n",
        i + 1, network.masses[i]);
  xml += "  </worldbody>\n  <tendon>\n";
  for (const auto& link : network.links)
    xml += fmt::format("    <fixed stiffness=\"{}\" damping=\"{}\" springlength=\"0\">",
                       link.stiffness, link.damping) +
           ends(link.mass, link.other);
  if (!network.contacts.empty())
    xml +=
        "    <!-- solref = -stiffness -damping of a unit mass: an oscillator whose half period is the contact. -->\n";
  for (const auto& contact : network.contacts) {
    const double half = std::numbers::pi / network.contact_time, eta = contact.restitution;
    const double decay = eta > 0.0 ? -std::log(eta) / network.contact_time : half;
    const double square = eta > 0.0 ? half * half + decay * decay : half * half;
    xml +=
        fmt::format(
            "    <fixed limited=\"true\" range=\"{} 1e6\" solreflimit=\"{} {}\" solimplimit=\"0.9999 0.9999 0.001\">",
            contact.gap, -square, -2.0 * decay) +
        ends(contact.upper, contact.lower);
  }
  xml += fmt::format(
      "  </tendon>\n  <keyframe><key time=\"{}\" qpos=\"{}\" qvel=\"{}\"/></keyframe>\n</mujoco>\n",
      problem.start.t, numbers(problem.start.u), numbers(problem.start.v));
  std::string loads;
  for (const auto& f : network.loads)
    loads += fmt::format("{{{}, {}, {}, {}}}, ", f.dof + 1, f.amplitude, f.frequency, f.phase);
  return {{"model.xml", xml},
          {"simulate.c", filled(simulate, {{"head", head(subject, "mujoco", "//")},
                                           {"loads", loads},
                                           {"last", fmt::format("{}", problem.end)}})},
          run_script(subject, levels, "./simulate model.xml \"$2\" \"$1.csv\"", ".csv",
                     compliant_claim(network, "--expect proper:1"),
                     "\"${CC:-cc}\" -O2 -o simulate simulate.c -lmujoco -lm")};
}

}  // namespace clackers::decks
