#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace clackers::paper {

/// Fonts, colours and spacing of all figures, as Vega-Lite's "config".
nlohmann::ordered_json configuration();

/// The tick of a logarithmic axis as Vega expression: powers of ten, nothing between them.
std::string power_label();

}  // namespace clackers::paper
