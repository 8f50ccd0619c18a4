#pragma once

#include <string_view>

/// The files that the html page is made of, embedded by embed.cmake.
namespace clackers::report::assets {

extern const std::string_view page_html;  ///< with {{slots}}
extern const std::string_view page_css;
extern const std::string_view page_js, figures_js, player_js, scene_js, theme_js;
/// Parts of page_html, also with {{slots}}.
extern const std::string_view section_html, table_html, figure_html, player_html, subject_html,
    self_html;
/// A record in a notebook, with {{slots}}, and its colours.
extern const std::string_view notebook_html, notebook_json;
/// The sources of the content security policy for the scripts above: 'sha256-...' each.
extern const std::string_view script_hashes;

/// Vega-Lite specifications with "$placeholders".
extern const std::string_view response_vl_json, convergence_vl_json, history_vl_json, work_vl_json,
    profile_vl_json, curves_vl_json;
extern const std::string_view history_rows_vl_json;  ///< a layer for response_vl_json

extern const std::string_view vega_min_js, vega_lite_min_js, vega_embed_min_js;
extern const std::string_view licences;  ///< of the three and what is in them

}  // namespace clackers::report::assets
