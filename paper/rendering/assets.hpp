#pragma once

#include <string_view>

/// The files of page/, embedded by embed.cmake.
namespace clackers::paper::assets {

extern const std::string_view page_html, open_points_html, look_json,
    claims_json;                          ///< with {{slots}}
extern const std::string_view paper_css;  ///< beside the report's style sheet
extern const std::string_view render_js;  ///< run by node

}  // namespace clackers::paper::assets

/// The colours of the report's light page, which pictures have; embed.cmake reads them from its style
/// sheet.
namespace clackers::paper::light {

extern const char *const paper,
    *const ink, *const muted, *const faint, *const line,
                                                *const grid,
                                                    *const impact,
                                                        *const m1, *const m2, *const m3,
                                                                                  *const m4,
                                                                                      *const m7,
                                                                                          *const m8;

}  // namespace clackers::paper::light
