#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "clackers/base/number.hpp"
#include "clackers/decks/models/network.hpp"
#include "clackers/decks/rows.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::decks {
namespace {

using Call = std::vector<std::string>;  // a command and its words

constexpr auto tcl_steps = R"tcl(
set h [lindex $argv 0]
set steps [expr {round((@last@ - @t0@) / $h)}]
set h [expr {(@last@ - @t0@) / double($steps)}]
set file [open [lindex $argv 1] w]
puts -nonewline $file "t"
for {set i 1} {$i <= @n@} {incr i} {puts -nonewline $file ",u$i,v$i"}
for {set k 0} {$k <= $steps} {incr k} {
  if {$k > 0 && [analyze 1 $h] != 0} {puts stderr "step $k does not converge"; exit 1}
  puts -nonewline $file [format "\n%.17g" [expr {@t0@ + $k * $h}]]
  for {set i 1} {$i <= @n@} {incr i} {puts -nonewline $file [format ",%.17g,%.17g" [nodeDisp $i 1] [nodeVel $i 1]]}
}
puts $file ""
close $file
)tcl";

constexpr auto python_steps = R"py(
steps = round((@last@ - @t0@) / float(sys.argv[1]))
h = (@last@ - @t0@) / steps
with open(sys.argv[2], "w") as file:
    file.write("t" + "".join(f",u{i},v{i}" for i in range(1, @n@ + 1)))
    for k in range(steps + 1):
        if k > 0 and ops.analyze(1, h) != 0:
            sys.exit(f"step {k} does not converge")
        values = [@t0@ + k * h]
        for i in range(1, @n@ + 1):
            values += [ops.nodeDisp(i, 1), ops.nodeVel(i, 1)]
        file.write("\n" + ",".join(map(repr, values)))
    file.write("\n")
)py";

class Model {
 public:
  Model(const Subject& subject, std::string_view format)
      : subject_(subject), network_(network_of(subject, format, {.loads = true})) {}

  const Network& network() const { return network_; }

  std::vector<Call> calls() {
    const auto& [t, u, v] = subject_.problem.start;
    const auto n = int(network_.masses.size());
    add({"wipe"});
    add({"model", "basic", "-ndm", "1", "-ndf", "1"});
    for (int i = 0; i < n; ++i)
      add({"node", node(i), "0.0", "-mass", exact_number(network_.masses[std::size_t(i)])});
    add({"node", node(ground), "0.0"});
    add({"fix", node(ground), "1"});
    for (const auto& link : network_.links)
      element(link.other, link.mass,
              {"Elastic", next(), exact_number(link.stiffness), exact_number(link.damping)});
    for (const auto& stop : network_.one_sided()) contact(stop);
    for (const auto& load : network_.loads) add_load(load);
    const auto a = acceleration();
    for (int i = 0; i < n; ++i) {
      add({"setNodeDisp", node(i), "1", exact_number(u[i]), "-commit"});
      add({"setNodeVel", node(i), "1", exact_number(v[i]), "-commit"});
      add({"setNodeAccel", node(i), "1", exact_number(a[i]), "-commit"});
    }
    if (t != 0.0) add({"setTime", exact_number(t)});
    for (const Call& call : {Call{"constraints", "Plain"},
                             {"numberer", "Plain"},
                             {"system", "FullGeneral"},
                             {"test", "NormDispIncr", "1e-12", "100", "0"},
                             {"algorithm", "Newton"},
                             {"integrator", "Newmark", "0.5", "0.25"},
                             {"analysis", "Transient"}})
      add(call);
    return calls_;
  }

 private:
  void add(Call call) { calls_.push_back(std::move(call)); }
  std::string node(int mass) const {
    return std::to_string(mass == ground ? int(network_.masses.size()) + 1 : mass + 1);
  }
  std::string next() { return std::to_string(++tag_); }

  // The strain of a zeroLength element is the displacement of its second node less that of its first.
  void element(int first, int second, Call material) {
    const auto tag = material[1];
    material.insert(material.begin(), "uniaxialMaterial");
    add(material);
    add({"element", "zeroLength", tag, node(first), node(second), "-mat", tag, "-dir", "1"});
  }
  // ENT takes no tension; a strain of its own moves it to the gap.
  void contact(const Stop& stop) {
    const auto inner = next();
    Call material{"ENT", inner, exact_number(stop.stiffness)};
    if (stop.gap != 0.0) {
      material.insert(material.begin(), "uniaxialMaterial");
      add(material);
      material = {"InitStrainMaterial", next(), inner, exact_number(-stop.gap)};
    }
    element(stop.lower, stop.upper, material);
  }
  void add_load(const model::HarmonicForce& load) {
    const auto tag = next();
    const auto factor = exact_number(load.amplitude);
    if (load.frequency > 0.0)
      add({"timeSeries", "Trig", tag, "0.0", "1e300",
           exact_number(2.0 * std::numbers::pi / load.frequency), "-shift",
           exact_number(load.phase + 0.5 * std::numbers::pi), "-factor", factor});
    else
      add({"timeSeries", "Constant", tag, "-factor",
           exact_number(load.amplitude * std::cos(load.phase))});
    add({"pattern", "Plain", tag, tag});
    add({"load", node(load.dof), "1.0"});
  }
  // At the start: Newmark's method takes it from there.
  Eigen::VectorXd acceleration() const {
    const auto& p = subject_.problem;
    Eigen::VectorXd force = -p.system.stiffness * p.start.u - p.system.damping * p.start.v;
    for (const auto& load : network_.loads)
      force[load.dof] += load.amplitude * std::cos(load.frequency * p.start.t + load.phase);
    return numerics::solved(p.system.mass, force);
  }

  const Subject& subject_;
  Network network_;
  std::vector<Call> calls_;
  int tag_ = 0;
};

// The load of a pattern stands in its braces.
std::string tcl_line(const Call& call) {
  if (call[0] == "load") return fmt::format("  {}\n}}\n", fmt::join(call, " "));
  return fmt::format("{}{}\n", fmt::join(call, " "), call[0] == "pattern" ? " {" : "");
}

std::string python_line(const Call& call) {
  std::vector<std::string> words;
  for (std::size_t i = 1; i < call.size(); ++i)
    words.push_back(looks_numeric(call[i]) ? call[i] : "\"" + call[i] + "\"");
  return fmt::format("ops.{}({})\n", call[0], fmt::join(words, ", "));
}

std::vector<DeckFile> files(const Subject& subject, std::string_view format, const char* name,
                            std::string first, std::string (*line)(const Call&),
                            std::string_view last, std::string_view solve) {
  Model model(subject, format);
  auto text = head(subject, format, "#") + "# " + stiffness_note(model.network()) + "\n" + first;
  for (const auto& call : model.calls()) text += line(call);
  const auto& problem = subject.problem;
  text += filled(last, {{"last", exact_number(problem.end)},
                        {"t0", exact_number(problem.start.t)},
                        {"n", std::to_string(problem.dof())}});
  return {{name, text},
          run_script(subject, compliant_steps(model.network(), problem), solve, ".csv",
                     compliant_claim(model.network()))};
}

}  // namespace

std::vector<DeckFile> opensees_tcl(const Subject& subject) {
  return files(subject, "opensees-tcl", "model.tcl", "", tcl_line, tcl_steps,
               "OpenSees model.tcl \"$2\" \"$1.csv\"");
}

std::vector<DeckFile> opensees_python(const Subject& subject) {
  return files(subject, "opensees-python", "model.py",
               "import sys\n\nimport openseespy.opensees as ops\n\n", python_line, python_steps,
               "\"${PYTHON:-python3}\" model.py \"$2\" \"$1.csv\"");
}

}  // namespace clackers::decks
