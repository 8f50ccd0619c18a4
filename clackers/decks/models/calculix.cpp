#include <fmt/format.h>

#include "clackers/base/number.hpp"
#include "clackers/decks/models/network.hpp"
#include "clackers/decks/rows.hpp"

namespace clackers::decks {
namespace {

// Nodes stand in a line, so far apart that they never pass each other; 0 is the ground.
constexpr double distance = 1000.0;

std::string real(double value) {
  auto text = exact_number(value);
  return text.find_first_of(".e") == text.npos ? text + "." : text;
}

class Input {
 public:
  explicit Input(const Subject& subject)
      : subject_(subject), network_(network_of(subject, "calculix", {})) {}

  std::vector<DeckFile> files() {
    const auto levels = compliant_steps(network_, subject_.problem);
    add("{}** {}\n", head(subject_, "calculix", "**"), stiffness_note(network_));
    nodes();
    masses();
    links();
    stops();
    add("*BOUNDARY\nMASSES, 2, 3\n{}, 1, 3\n", node(ground));
    initial("DISPLACEMENT", subject_.problem.start.u);
    initial("VELOCITY", subject_.problem.start.v);
    const double span = subject_.problem.end - subject_.problem.start.t;
    add("** The average acceleration of Newmark in steps of the first number.\n*STEP, NLGEOM, INC=100000000\n"
        "*DYNAMIC, DIRECT, ALPHA=0.\n{}, {}\n*NODE PRINT, NSET=MASSES\nU, V\n*END STEP\n",
        real(levels[0].value), real(span));
    const auto solve =
        fmt::format("sed \"s/^{},/$2,/\" model.inp > \"$1.inp\"\n  ccx -i \"$1\" > \"$1.log\"",
                    real(levels[0].value));
    return {{"model.inp", text_},
            run_script(subject_, levels, solve, ".dat", compliant_claim(network_),
                       "export OMP_NUM_THREADS=1")};
  }

 private:
  template <class... Values>
  void add(fmt::format_string<Values...> form, const Values&... values) {
    text_ += fmt::vformat(form, fmt::make_format_args(values...));
  }
  int node(int mass) const { return mass == ground ? int(network_.masses.size()) + 1 : mass + 1; }
  double place(int mass) const { return distance * (mass + 1); }

  void nodes() {
    add("*NODE, NSET=MASSES\n");
    for (int i = 0; i < int(network_.masses.size()); ++i)
      add("{}, {}, 0., 0.\n", node(i), real(place(i)));
    add("*NODE, NSET=GROUND\n{}, 0., 0., 0.\n", node(ground));
  }
  void masses() {
    for (int i = 0; i < int(network_.masses.size()); ++i)
      add("*ELEMENT, TYPE=MASS, ELSET=M{0}\n{1}, {0}\n*MASS, ELSET=M{0}\n{2}\n", node(i),
          ++element_, real(network_.masses[std::size_t(i)]));
  }
  // A pair of nodes with their order in the line.
  void spring(std::string_view set, int first, int second) {
    add("*ELEMENT, TYPE=SPRINGA, ELSET={}\n{}, {}, {}\n", set, ++element_, node(first),
        node(second));
  }
  void links() {
    for (int number = 0; const auto& link : network_.links) {
      ++number;
      if (link.stiffness != 0.0) {
        spring(fmt::format("K{}", number), link.mass, link.other);
        add("*SPRING, ELSET=K{}\n\n{}\n", number, real(link.stiffness));
      }
      if (link.damping != 0.0)
        add("*ELEMENT, TYPE=DASHPOTA, ELSET=C{0}\n{1}, {2}, {3}\n*DASHPOT, ELSET=C{0}\n\n{4}\n",
            number, ++element_, node(link.mass), node(link.other), real(link.damping));
    }
  }
  // Force against elongation: of a pair that stands in the other order both have the other sign.
  void stops() {
    for (int number = 0; const auto& stop : network_.one_sided()) {
      const auto set = fmt::format("CONTACT{}", ++number);
      const bool in_order = place(stop.upper) > place(stop.lower);
      const double k = stop.stiffness, reach = 0.5 * distance;
      spring(set, stop.upper, stop.lower);
      add("*SPRING, ELSET={}, NONLINEAR\n", set);
      if (in_order)
        add("{}, {}\n0., {}\n0., {}\n", real(-k * reach), real(stop.gap - reach), real(stop.gap),
            real(stop.gap + reach));
      else
        add("0., {}\n0., {}\n{}, {}\n", real(-stop.gap - reach), real(-stop.gap), real(k * reach),
            real(-stop.gap + reach));
    }
  }
  void initial(std::string_view kind, const Eigen::VectorXd& values) {
    add("*INITIAL CONDITIONS, TYPE={}\n", kind);
    for (int i = 0; i < int(values.size()); ++i) add("{}, 1, {}\n", node(i), real(values[i]));
  }

  const Subject& subject_;
  Network network_;
  std::string text_;
  int element_ = 0;
};

}  // namespace

std::vector<DeckFile> calculix(const Subject& subject) { return Input(subject).files(); }

}  // namespace clackers::decks
