#pragma once

#include <string>
#include <string_view>

#include "clackers/base/files/toml_reader.hpp"

namespace clackers::model {

/// The table of a problem in one of the formats of problem_from_text(): JSON begins with {, lines
/// with dof=, which is no key of TOML. Throws InputError, `name` first, for other text (bad-syntax)
/// and for a problem with a law beside its rows (not-stated).
toml::table table_from(std::string_view text, const std::string& name);

}  // namespace clackers::model
