#include "clackers/decks/deck.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/base/check.hpp"
#include "clackers/decks/rows.hpp"
#include "clackers/decks/text.hpp"
#include "clackers/model/nonlinear_springs.hpp"
#include "clackers/model/problem_file.hpp"

namespace clackers::decks {
namespace {

constexpr auto exact_unit = "the exact flights; in model exchange an event indicator and reinit";
std::string header(std::string_view name) {
  return fmt::format("echo '#include <{}>' | \"${{CC:-cc}}\" -E -xc -", name);
}
constexpr auto located = "located, Newton's law of restitution applied by the script";

/// All formats; a new one is a row here, its function in rows.hpp and its file.
const std::vector<Format> table = {
    {"scipy", "Python with SciPy's solve_ivp", located, "python3-scipy",
     R"("${PYTHON:-python3}" -c "import scipy.integrate")", scipy},
    {"octave", "Octave or MATLAB, ode45", located, "octave", "command -v octave-cli", octave},
    {"r", "R with deSolve's lsodar", located, "r-cran-desolve", "Rscript -e 'library(deSolve)'", r},
    {"cvode", "C with CVODE of SUNDIALS 6 or later", located, "libsundials-dev",
     header("cvode/cvode.h"), cvode},
    {"fmu2", "FMI 2.0, model exchange and co-simulation", exact_unit, "gcc zip",
     "command -v zip && " + header("dlfcn.h"), fmu2},
    {"fmu3", "FMI 3.0, model exchange and co-simulation", exact_unit, "gcc zip",
     "command -v zip && " + header("dlfcn.h"), fmu3},
    {"calculix", "CalculiX 2.20", "a spring in compression only (SPRINGA), of stated stiffness",
     "calculix-ccx", "command -v ccx", calculix},
    {"mujoco", "MuJoCo 2.2 or later",
     "limits of fixed tendons, solref of stated contact time and restitution", "libmujoco-dev",
     header("mujoco/mujoco.h"), mujoco},
    {"modelica", "Modelica, OpenModelica 1.20 or later",
     "an event and reinit, Newton's law of restitution", "", "command -v omc", modelica},
    {"opensees-tcl", "OpenSees 3.5 or later, Tcl",
     "a spring without tension (ENT), of stated stiffness", "", "command -v OpenSees",
     opensees_tcl},
    {"opensees-python", "OpenSeesPy 3.5 or later",
     "a spring without tension (ENT), of stated stiffness", "",
     R"("${PYTHON:-python3}" -c "import openseespy.opensees")", opensees_python},
    {"abaqus", "Abaqus/Standard", "a nonlinear spring in compression only, of stated stiffness", "",
     "command -v abaqus", abaqus},
    {"ls-dyna", "LS-DYNA, explicit", "a nonlinear spring in compression only, of stated stiffness",
     "", R"(command -v "${LS_DYNA:-ls-dyna}")", ls_dyna},
    {"code-aster", "Code_Aster 15 or later", "a stop (DIS_CONTACT) of stated stiffness", "",
     R"(command -v "${AS_RUN:-run_aster}")", code_aster},
    {"mbdyn", "MBDyn 1.7 or later", "a spring in compression only, of stated stiffness", "",
     "command -v mbdyn", mbdyn},
    {"sdf", "Gazebo, SDFormat",
     "no model: Gazebo takes only poses from <state>, no initial velocities", "", "", nullptr},
    {"julia", "Julia with OrdinaryDiffEq", located, "", "julia -e 'using OrdinaryDiffEq'", julia},
};

}  // namespace

std::span<const Format> formats() { return table; }

const Format& format_of(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& format : table) {
    if (format.name == name) return format;
    names.push_back(format.name);
  }
  refuse_name("format", name, names, "clackers export --list");
}

std::vector<DeckFile> deck(const Format& format, const Subject& subject) {
  if (format.write == nullptr) refuse_deck(format.name, format.contact);
  if (!subject.method.empty() && !format.name.starts_with("fmu"))
    refuse_deck(format.name, "a method goes into a unit only; use --to fmu2 or --to fmu3");
  if (!subject.problem.frictions.empty() || model::nonlinear_springs(subject.problem))
    refuse_deck(format.name, "its models have neither dry friction nor nonlinear springs yet");
  if (!subject.problem.unstated.empty())
    refuse_deck(format.name, "no row of the problem states " + subject.problem.unstated);
  auto files = format.write(subject);
  for (auto& file : files)
    if (file.name == "run")
      file.text = filled(
          file.text,
          {{"needs",
            fmt::format("{{ {}; }} > /dev/null 2>&1 || {{\n  echo \"run: needs {}{}.\" >&2\n"
                        "  exit 2\n}}",
                        format.probe, format.program,
                        format.needs.empty() ? ", which is not in Debian"
                                             : "; on Debian: apt-get install " + format.needs)}});
  if (subject.check.empty())
    files.push_back({"problem.json", model::problem_file_json("piecewise", subject.problem)});
  return files;
}

std::vector<std::string> file_names() {
  return {"run",
          "problem.json",
          "model.py",
          "model.m",
          "model.R",
          "model.c",
          "model.jl",
          "model.xml",
          "model.inp",
          "Model.mo",
          "model.tcl",
          "model.k",
          "model.comm",
          "model.mail",
          "model.mbd",
          "simulate.c",
          "modelDescription.xml",
          "buildDescription.xml"};
}

}  // namespace clackers::decks
