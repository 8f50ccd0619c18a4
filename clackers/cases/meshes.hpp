#pragma once

#include <vector>

#include "clackers/cases/row.hpp"
#include "clackers/exact/bodies/bar_mesh.hpp"

// What all cases have in common whose problem is the mesh of a continuum.
namespace clackers::cases {

/// Of a case with one bar or half a string. The exact motion of 4000 elements takes some 40 s and 2.5 GB, both of which
/// grow as n^2.
inline constexpr double most_exact_elements = 4000.0;

/// The mesh of what the case has as bars already, as what methods get.
void use_mesh(Case& test_case, const Values& value, const exact::MeshedBars& meshed);
void use_mesh(Case& test_case, const Values& value, exact::BarMesh mesh, double most_exact);

/// When the contact of the number of the continuum begins or ends, as a constant.
void add_contact(Case& test_case, int number, const numerics::Bounded& t, bool closes);

/// elements, mass, eta and t_end of so many bars, or half strings.
std::vector<Parameter> mesh_parameters(bool is_string, double end, std::size_t bars = 1);

}  // namespace clackers::cases
