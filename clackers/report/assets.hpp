#pragma once

#include <string_view>

/// The files that the html page is made of, embedded by embed.cmake.
namespace clackers::report::assets {

extern const std::string_view page_html;  ///< with {{slots}}
extern const std::string_view page_css;
extern const std::string_view engines_html,
    engines_css;  ///< of `clackers engines`, the first with {{slots}}
/// Of `clackers explore`; runs_js needs nothing of synchronized_pair_js, explore_js both.
extern const std::string_view explore_html, explore_css, explore_json, synchronized_pair_js,
    runs_js, explore_js;
extern const std::string_view theme_js, figures_js, tools_js;  ///< of every page
extern const std::string_view svg_document_js, film_js;        ///< of films
extern const std::string_view page_js, scene_js, player_js;    ///< of records
extern const std::string_view atlas_js, atlas_matrix_js, atlas_panel_js, atlas_figures_js,
    atlas_css, atlas_html;
/// Parts of page_html, also with {{slots}}.
extern const std::string_view section_html, table_html, figure_html, player_html, subject_html,
    self_html;
/// A record in a notebook, with {{slots}}, and its colours.
extern const std::string_view notebook_html, notebook_json;
/// A script above as a source of the content security policy: 'sha256-...'. Throws std::logic_error
/// for any other text.
std::string_view hash_of(std::string_view script);

/// Vega-Lite specifications with "$placeholders".
extern const std::string_view response_vl_json, convergence_vl_json, history_vl_json, work_vl_json,
    profile_vl_json, curves_vl_json, impacts_vl_json;
extern const std::string_view atlas_ladder_vl_json, atlas_map_vl_json, atlas_work_vl_json;
extern const std::string_view history_rows_vl_json;  ///< a layer for response_vl_json

extern const std::string_view vega_min_js, vega_lite_min_js, vega_embed_min_js;
extern const std::string_view licences;  ///< of the three and what is in them

}  // namespace clackers::report::assets
