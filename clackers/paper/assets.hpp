#pragma once

#include <string_view>

/// The files of page/, embedded by embed.cmake.
namespace clackers::paper::assets {

extern const std::string_view page_html;  ///< with {{slots}}
extern const std::string_view paper_css;  ///< beside the report's style sheet
extern const std::string_view render_js;  ///< run by node

}  // namespace clackers::paper::assets
