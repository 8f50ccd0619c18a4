#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "clackers/base/codes.hpp"

namespace clackers::paper {

/// Why some pictures are missing.
struct Missing {
  std::string sentence;  ///< what failed, what to install, what was written all the same
  Code code;             ///< no-renderer or render-failed
};

/// Draws each NAME.vl.json of `folder` as NAME.svg (node) and NAME.pdf (rsvg-convert). Nothing
/// else stays behind in the folder. Returns what could not be drawn; empty when all could.
std::vector<Missing> render(const std::filesystem::path& folder,
                            const std::vector<std::string>& names);

}  // namespace clackers::paper
