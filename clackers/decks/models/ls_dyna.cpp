#include <fmt/format.h>

#include <cmath>

#include "clackers/base/number.hpp"
#include "clackers/decks/models/start_offset.hpp"
#include "clackers/decks/rows.hpp"

namespace clackers::decks {
namespace {

class Keywords {
 public:
  explicit Keywords(const Subject& subject)
      : subject_(subject), network_(network_of(subject, "ls-dyna", {})) {}

  std::vector<DeckFile> files() {
    const auto levels = compliant_steps(network_, subject_.problem);
    const auto& start = subject_.problem.start;
    const auto h = exact_number(levels[0].value);
    const auto n = int(network_.masses.size());
    add("{}$ {}\n$ Nodes stand where the masses are at the start; forces hold the springs: u is the coordinate.\n",
        head(subject_, "ls-dyna", "$"), stiffness_note(network_));
    add("*KEYWORD\n*CONTROL_TERMINATION\n{}\n", exact_number(subject_.problem.end - start.t));
    add("$ The step is at most curve 1: h, of explicit central differences.\n*CONTROL_TIMESTEP\n0.0, 0.9, 0, 0.0, 0.0, 1\n");
    curve(1, {{0.0, levels[0].value}, {2.0 * subject_.problem.end, levels[0].value}});
    add("*DATABASE_NODOUT\n{}, 1\n*DATABASE_HISTORY_NODE\n", h);
    for (int i = 0; i < n; ++i) add("{}{}", i + 1, i + 1 == n ? "\n" : ", ");
    add("*NODE\n");
    for (int i = 0; i < n; ++i) add("{}, {}, 0.0, 0.0, 0, 7\n", i + 1, exact_number(start.u[i]));
    add("{}, 0.0, 0.0, 0.0, 7, 7\n", n + 1);
    for (int i = 0; i < n; ++i) {
      add("*BOUNDARY_SPC_NODE\n{0}, 0, 0, 1, 1, 1, 1, 1\n*ELEMENT_MASS\n{1}, {0}, {2}\n", i + 1,
          ++element_, exact_number(network_.masses[std::size_t(i)]));
      add("*INITIAL_VELOCITY_NODE\n{}, {}, 0.0, 0.0\n", i + 1, exact_number(start.v[i]));
    }
    add("$ Deflections are those along x: displacement of the second node less that of the first.\n"
        "*DEFINE_SD_ORIENTATION\n1, 0, 1.0, 0.0, 0.0\n");
    for (const auto& link : network_.links) {
      if (link.stiffness != 0.0) part(link.other, link.mass, "SPRING_ELASTIC", link.stiffness);
      if (link.damping != 0.0) part(link.other, link.mass, "DAMPER_VISCOUS", link.damping);
    }
    for (const auto& stop : network_.one_sided()) {
      const double gap = gap_from_start(subject_, stop);
      curve(++curve_, {{gap - reach, -stop.stiffness * reach}, {gap, 0.0}, {gap + reach, 0.0}});
      part(stop.lower, stop.upper, "SPRING_NONLINEAR_ELASTIC", curve_);
    }
    curve(++curve_, {{0.0, 1.0}, {2.0 * subject_.problem.end, 1.0}});
    const auto held = held_forces(subject_);
    for (int i = 0; i < n; ++i)
      add("*LOAD_NODE_POINT\n{}, 1, {}, {}\n", i + 1, curve_, exact_number(held[i]));
    add("*END\n");
    const auto solve = fmt::format(
        "mkdir -p \"$1\"\n  sed \"s/{}/$2/\" model.k > \"$1/model.k\"\n"
        "  (cd \"$1\" && \"${{LS_DYNA:-ls-dyna}}\" i=model.k > log)\n  mv \"$1/nodout\" \"$1.nodout\"",
        h);
    return {{"model.k", text_},
            run_script(subject_, levels, solve, ".nodout",
                       fmt::format("--component coor1 {}", compliant_claim(network_)))};
  }

 private:
  template <class... Values>
  void add(fmt::format_string<Values...> form, const Values&... values) {
    text_ += fmt::vformat(form, fmt::make_format_args(values...));
  }
  void curve(int id, std::initializer_list<std::pair<double, double>> points) {
    add("*DEFINE_CURVE\n{}\n", id);
    for (const auto& [x, y] : points) add("{}, {}\n", exact_number(x), exact_number(y));
  }
  int node(int mass) const { return mass == ground ? int(network_.masses.size()) + 1 : mass + 1; }
  // A part of its own with its section and material, whose value is a number or a curve.
  void part(int first, int second, std::string_view material, auto value) {
    ++part_;
    add("*PART\n{0} {1}\n{1}, {1}, {1}\n*SECTION_DISCRETE\n{1}, 0\n0.0, 0.0\n*MAT_{0}\n{1}, {2}\n",
        material, part_, value);
    add("*ELEMENT_DISCRETE\n{}, {}, {}, {}, 1\n", ++element_, part_, node(first), node(second));
  }

  const Subject& subject_;
  Network network_;
  std::string text_;
  int element_ = 0, part_ = 0, curve_ = 1;
};

}  // namespace

std::vector<DeckFile> ls_dyna(const Subject& subject) { return Keywords(subject).files(); }

}  // namespace clackers::decks
