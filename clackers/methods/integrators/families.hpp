#pragma once

#include <array>
#include <vector>

#include "clackers/methods/registry.hpp"

namespace clackers::methods {

std::vector<Row> alpha_methods();
std::vector<Row> collocation_methods();
std::vector<Row> diagonally_implicit_methods();
std::vector<Row> multistep_methods();
std::vector<Row> explicit_methods();
std::vector<Row> structure_dependent_methods();
std::vector<Row> runge_kutta_methods();
std::vector<Row> composition_methods();
std::vector<Row> coupled_stages_methods();
std::vector<Row> energy_momentum_methods();
std::vector<Row> embedded_pairs();

/// The families of integrators, each with its rows of the registry.
inline constexpr std::array families{
    alpha_methods,           collocation_methods, diagonally_implicit_methods,
    multistep_methods,       explicit_methods,    structure_dependent_methods,
    runge_kutta_methods,     composition_methods, coupled_stages_methods,
    energy_momentum_methods, embedded_pairs};

}  // namespace clackers::methods
