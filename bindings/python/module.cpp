#include "bindings/python/bind.hpp"

#ifndef CLACKERS_VERSION
#error "the build gives CLACKERS_VERSION, the version of the project"
#endif

PYBIND11_MODULE(_core, core) {
  using namespace clackers::python;
  core.attr("version") = CLACKERS_VERSION;
  bind_errors(core);
  bind_problem(core);
  bind_case(core);
  bind_response(core);
  bind_impacts(core);
  bind_quantities(core);
  bind_tables(core);
  bind_inputs(core);
  bind_record(core);
  bind_study(core);
}
