#pragma once

#include <nlohmann/json_fwd.hpp>

#include "clackers/study/record.hpp"

namespace clackers::report {

/// The most points of a curve in a figure; of a longer one, every stretch keeps its highest and its
/// lowest point.
inline constexpr std::size_t most_points = 1000;

study::Curve reduced(const study::Curve& curve, std::size_t most = most_points);

/// What the figures draw, by the name that their specifications use: "response", "collisions",
/// "runs", "levels", "slopes", "history". The errors of runs are whole, curves are rounded to six
/// digits. "runs" is {"columns", "rows"}, all others are rows as Vega-Lite reads them.
nlohmann::ordered_json figure_data(const study::Record& record);

/// The specifications by name: "response", "convergence", "history", "work-forces", "work-seconds".
/// Each names its data sets; colours are variables of page.css.
nlohmann::ordered_json figure_specifications(const study::Record& record);

}  // namespace clackers::report
