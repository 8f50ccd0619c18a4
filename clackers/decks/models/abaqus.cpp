#include <fmt/format.h>

#include <cmath>

#include "clackers/base/number.hpp"
#include "clackers/decks/models/start_offset.hpp"
#include "clackers/decks/rows.hpp"

namespace clackers::decks {
namespace {

class AbaqusInput {
 public:
  explicit AbaqusInput(const Subject& subject)
      : subject_(subject), network_(network_of(subject, "abaqus", {.loads = true})) {}

  std::vector<DeckFile> files() {
    const auto levels = compliant_steps(network_, subject_.problem);
    const auto& u = subject_.problem.start.u;
    const auto n = int(network_.masses.size());
    add("{}** {}\n** Nodes stand where the masses are at the start; forces hold the springs: u is the coordinate.\n",
        head(subject_, "abaqus", "**"), stiffness_note(network_));
    add("*HEADING\nClackers\n*NODE, NSET=MASSES\n");
    for (int i = 0; i < n; ++i) add("{}, {}, 0., 0.\n", i + 1, exact_number(u[i]));
    for (int i = 0; i < n; ++i)
      add("*ELEMENT, TYPE=MASS, ELSET=M{0}\n{1}, {0}\n*MASS, ELSET=M{0}\n{2}\n", i + 1, ++element_,
          exact_number(network_.masses[std::size_t(i)]));
    for (int number = 0; const auto& link : network_.links) {
      ++number;
      if (link.stiffness != 0.0) linear("SPRING", number, link, link.stiffness);
      if (link.damping != 0.0) linear("DASHPOT", number, link, link.damping);
    }
    for (int number = 0; const auto& stop : network_.one_sided()) contact(stop, ++number);
    for (int number = 0; const auto& load : network_.loads)
      if (++number; load.frequency > 0.0)  // A cos(w t) + B sin(w t)
        add("*AMPLITUDE, NAME=LOAD{}, DEFINITION=PERIODIC\n1, {}, 0., 0.\n{}, {}\n", number,
            exact_number(load.frequency), exact_number(std::cos(load.phase)),
            exact_number(-std::sin(load.phase)));
    add("*BOUNDARY\nMASSES, 2, 3\n*INITIAL CONDITIONS, TYPE=VELOCITY\n");
    for (int i = 0; i < n; ++i)
      add("{}, 1, {}\n", i + 1, exact_number(subject_.problem.start.v[i]));
    add("*STEP, INC=100000000\n*DYNAMIC, DIRECT, ALPHA=0.\n{}, {}\n*CLOAD\n",
        exact_number(levels[0].value),
        exact_number(subject_.problem.end - subject_.problem.start.t));
    const auto held = held_forces(subject_);
    for (int i = 0; i < n; ++i) add("{}, 1, {}\n", i + 1, exact_number(held[i]));
    for (int number = 0; const auto& load : network_.loads) {
      ++number;
      if (load.frequency > 0.0)
        add("*CLOAD, AMPLITUDE=LOAD{}\n{}, 1, {}\n", number, load.dof + 1,
            exact_number(load.amplitude));
      else
        add("*CLOAD\n{}, 1, {}\n", load.dof + 1,
            exact_number(load.amplitude * std::cos(load.phase)));
    }
    add("*NODE PRINT, NSET=MASSES, FREQUENCY=1, SUMMARY=NO\nCOOR1, V1\n*END STEP\n");
    const auto solve = fmt::format(
        "sed \"s/^{},/$2,/\" model.inp > \"$1.inp\"\n  abaqus job=\"$1\" interactive > \"$1.log\"",
        exact_number(levels[0].value));
    return {{"model.inp", text_},
            run_script(subject_, levels, solve, ".dat",
                       fmt::format("--component coor1 {}", compliant_claim(network_)))};
  }

 private:
  template <class... Values>
  void add(fmt::format_string<Values...> form, const Values&... values) {
    text_ += fmt::vformat(form, fmt::make_format_args(values...));
  }
  // SPRING1 and DASHPOT1 join a node and the ground, SPRING2 and DASHPOT2 two nodes.
  void element(std::string_view kind, std::string_view set, int mass, int other) {
    if (other == ground)
      add("*ELEMENT, TYPE={}1, ELSET={}\n{}, {}\n", kind, set, ++element_, mass + 1);
    else
      add("*ELEMENT, TYPE={}2, ELSET={}\n{}, {}, {}\n", kind, set, ++element_, mass + 1, other + 1);
  }
  void linear(std::string_view kind, int number, const Link& link, double value) {
    const auto set = fmt::format("{}{}", kind.front() == 'S' ? 'K' : 'C', number);
    element(kind, set, link.mass, link.other);
    add("*{}, ELSET={}\n{}\n{}\n", kind, set, link.other == ground ? "1" : "1, 1",
        exact_number(value));
  }
  // Force against the displacement of the first node less that of the second.
  void contact(const Stop& stop, int number) {
    const auto set = fmt::format("CONTACT{}", number);
    const bool reversed = stop.upper == ground;
    const double gap = gap_from_start(subject_, stop), force = stop.stiffness * reach;
    element("SPRING", set, reversed ? stop.lower : stop.upper, reversed ? ground : stop.lower);
    add("*SPRING, ELSET={}, NONLINEAR\n{}\n", set, reversed || stop.lower == ground ? "1" : "1, 1");
    if (reversed)
      add("0., {}\n0., {}\n{}, {}\n", -gap - reach, -gap, force, -gap + reach);
    else
      add("{}, {}\n0., {}\n0., {}\n", -force, gap - reach, gap, gap + reach);
  }

  const Subject& subject_;
  Network network_;
  std::string text_;
  int element_ = 0;
};

}  // namespace

std::vector<DeckFile> abaqus(const Subject& subject) { return AbaqusInput(subject).files(); }

}  // namespace clackers::decks
