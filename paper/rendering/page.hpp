#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "paper/figure.hpp"

namespace clackers::paper {

/// A figure with its picture as svg text, empty where it could not be drawn.
struct Drawn {
  Figure figure;
  std::string svg;
  std::vector<std::string> files;  ///< beside the page: "fig12.svg", ...
};

/// One self-contained html page: each figure with caption, claims, choices and links to its files,
/// and the points that the paper leaves open, with numbers computed here. `command` is as typed.
std::string page(const std::vector<Drawn>& drawn, const std::string& command);

/// The Vega-Lite specification of a figure, its data inside. Numbers are rounded to six digits; of a
/// long curve, every stretch keeps its highest and its lowest point.
nlohmann::ordered_json specification(const Figure& figure);

}  // namespace clackers::paper
