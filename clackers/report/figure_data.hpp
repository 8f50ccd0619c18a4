#pragma once

#include <nlohmann/json_fwd.hpp>

#include "clackers/study/record.hpp"
#include "clackers/study/reduced_curve.hpp"

namespace clackers::report {

using study::most_points;
using study::reduced;

/// What the figures draw, by the name that their specifications use: "response", "collisions",
/// "runs", "levels", "slopes", "history", "profile". The errors of runs are whole, curves are rounded to six
/// digits. "runs" is {"columns", "rows"}, all others are rows as Vega-Lite reads them.
nlohmann::ordered_json figure_data(const study::Record& record);

/// The specifications by name: "response", "convergence", "history", and where there is something to
/// show, "work" and "profile". usermeta.counters are the titles of a figure's counters.
/// Each names its data sets; colours are variables of page.css.
nlohmann::ordered_json figure_specifications(const study::Record& record);

}  // namespace clackers::report
