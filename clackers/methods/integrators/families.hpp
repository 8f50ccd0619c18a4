#pragma once

#include <vector>

#include "clackers/methods/registry.hpp"

// The families of integrators, each with its rows of the registry.
namespace clackers::methods {

std::vector<Row> alpha_methods();
std::vector<Row> runge_kutta_methods();

}  // namespace clackers::methods
