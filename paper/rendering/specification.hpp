#pragma once

#include <nlohmann/json_fwd.hpp>

#include "paper/figure.hpp"

namespace clackers::paper {

/// The Vega-Lite specification of a figure, its data inside. Numbers are rounded to six digits; of a
/// long curve, every stretch keeps its highest and its lowest point.
nlohmann::ordered_json specification(const Figure& figure);

}  // namespace clackers::paper
