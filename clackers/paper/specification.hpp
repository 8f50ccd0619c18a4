#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "clackers/paper/figure.hpp"

namespace clackers::paper {

/// The Vega-Lite specification of a figure, its data inside, in the colours of the report's light
/// page. Curves are rounded to six digits; of a long one, every stretch keeps its highest and its
/// lowest point.
nlohmann::ordered_json specification(const Figure& figure);

/// `text` with every "var(--name)" replaced by the light value that the report's style sheet gives
/// it. Throws std::logic_error for a name that it does not have.
std::string with_light_colors(const std::string& text);

}  // namespace clackers::paper
