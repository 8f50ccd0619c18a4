#include "clackers/decks/deck.hpp"

#include <algorithm>

#include "clackers/base/check.hpp"
#include "clackers/decks/rows.hpp"
#include "clackers/model/problem_file.hpp"

namespace clackers::decks {
namespace {

constexpr auto located = "located, Newton's law of restitution applied by the script";

/// All formats; a new one is a row here, its function in rows.hpp and its file.
const std::vector<Format> table = {
    {"scipy", "Python with SciPy's solve_ivp", located, "python3-scipy", scipy},
    {"octave", "Octave or MATLAB, ode45", located, "octave", octave},
    {"r", "R with deSolve's lsodar", located, "r-cran-desolve", r},
    {"cvode", "C with CVODE of SUNDIALS 6 or later", located, "libsundials-dev", cvode},
    {"calculix", "CalculiX 2.20", "a spring in compression only (SPRINGA), of stated stiffness",
     "calculix-ccx", calculix},
    {"mujoco", "MuJoCo 2.2 or later",
     "limits of fixed tendons, solref of stated contact time and restitution", "libmujoco-dev",
     mujoco},
    {"modelica", "Modelica, OpenModelica 1.20 or later",
     "an event and reinit, Newton's law of restitution", "", modelica},
    {"opensees-tcl", "OpenSees 3.5 or later, Tcl",
     "a spring without tension (ENT), of stated stiffness", "", opensees_tcl},
    {"opensees-python", "OpenSeesPy 3.5 or later",
     "a spring without tension (ENT), of stated stiffness", "", opensees_python},
    {"abaqus", "Abaqus/Standard", "a nonlinear spring in compression only, of stated stiffness", "",
     abaqus},
    {"ls-dyna", "LS-DYNA, explicit", "a nonlinear spring in compression only, of stated stiffness",
     "", ls_dyna},
    {"julia", "Julia with OrdinaryDiffEq", located, "", julia},
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
  auto files = format.write(subject);
  if (subject.check.empty())
    files.push_back({"problem.json", model::problem_file_json("piecewise", subject.problem)});
  return files;
}

std::vector<std::string> file_names() {
  return {"run",       "problem.json", "model.py",  "model.m",  "model.R",   "model.c", "model.jl",
          "model.xml", "simulate.c",   "model.inp", "Model.mo", "model.tcl", "model.k"};
}

}  // namespace clackers::decks
