#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clackers/paper/figure.hpp"

namespace clackers::paper {

/// A figure with its picture as svg text, empty where it could not be drawn.
struct Drawn {
  Figure figure;
  std::string svg;
  std::vector<std::string> files;  ///< beside the page: "fig12.svg", ...
};

/// One self-contained html page: each figure with caption, claims, choices and links to its files,
/// and the open points. `command` is as typed.
std::string page(const std::vector<Drawn>& drawn, const std::string& command);

/// Bytes as base64, for a data address.
std::string base64(std::string_view bytes);

}  // namespace clackers::paper
