#include "clackers/solvers/plugin/plugin_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string_view>

#include "clackers/base/error.hpp"

namespace clackers::solvers {
namespace {

constexpr auto entry_name = "clackers_plugin";

[[noreturn]] void refuse_plugin(const std::string& library, std::string_view what) {
  throw InputError(fmt::format("{}: {} See clackers_solver.h.", library, what), "not-a-plugin");
}

std::vector<double> rows_of(const Eigen::MatrixXd& matrix) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) values.push_back(matrix(i, j));
  return values;
}

}  // namespace

const clackers_solver& load_plugin(const std::string& library) {
  void* const handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr)
    throw InputError(fmt::format("{}; allowed: a shared library, made with -shared -fPIC.",
                                 std::string_view(::dlerror())),
                     "not-a-plugin");
  const auto entry = reinterpret_cast<decltype(&::clackers_plugin)>(::dlsym(handle, entry_name));
  if (entry == nullptr)
    refuse_plugin(library,
                  fmt::format("no function {}; allowed: a library that defines it.", entry_name));
  const clackers_solver* const solver = entry();
  if (solver == nullptr)
    refuse_plugin(library, fmt::format("{} returned null; allowed: a solver.", entry_name));
  if (solver->version < 1 || solver->version > CLACKERS_SOLVER_VERSION)
    refuse_plugin(library,
                  fmt::format("version = {}; allowed: 1 to {}. Compile it with the header of "
                              "this Clackers, or install a later Clackers.",
                              solver->version, CLACKERS_SOLVER_VERSION));
  if (solver->run == nullptr)
    refuse_plugin(library, "run = null; allowed: a function. Only prepare and free may be null.");
  if (solver->refines != CLACKERS_SOLVER_STEP && solver->refines != CLACKERS_SOLVER_TOLERANCE)
    refuse_plugin(library, fmt::format("refines = {}; allowed: CLACKERS_SOLVER_STEP ({}) and "
                                       "CLACKERS_SOLVER_TOLERANCE ({}).",
                                       solver->refines, int(CLACKERS_SOLVER_STEP),
                                       int(CLACKERS_SOLVER_TOLERANCE)));
  return *solver;
}

PluginProblem::PluginProblem(const model::ImpactProblem<>& problem)
    : mass_(rows_of(problem.system.mass)),
      damping_(rows_of(problem.system.damping)),
      stiffness_(rows_of(problem.system.stiffness)),
      u_(problem.start.u.begin(), problem.start.u.end()),
      v_(problem.start.v.begin(), problem.start.v.end()) {
  for (const auto& contact : problem.contacts) {
    directions_.insert(directions_.end(), contact.direction.begin(), contact.direction.end());
    gaps_.push_back(contact.gap);
    restitutions_.push_back(contact.restitution);
  }
  // data() of an empty vector need not be null.
  const auto first = [](const std::vector<double>& values) {
    return values.empty() ? nullptr : values.data();
  };
  problem_ = {.dof = static_cast<std::int32_t>(problem.dof()),
              .contacts = static_cast<std::int32_t>(problem.contacts.size()),
              .M = mass_.data(),
              .C = damping_.data(),
              .K = stiffness_.data(),
              .direction = first(directions_),
              .gap = first(gaps_),
              .restitution = first(restitutions_),
              .start = problem.start.t,
              .end = problem.end,
              .u = u_.data(),
              .v = v_.data()};
}

}  // namespace clackers::solvers
