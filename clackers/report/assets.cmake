# What the html page is made of, as one generated source file: our own page and the locked libraries.
# Sets CLACKERS_REPORT_ASSETS to that file.

set(report_dir ${PROJECT_SOURCE_DIR}/clackers/report)
set(modules ${PROJECT_SOURCE_DIR}/tools/web/node_modules)
set(libraries
  ${modules}/vega/build/vega.min.js
  ${modules}/vega-lite/build/vega-lite.min.js
  ${modules}/vega-embed/build/vega-embed.min.js)
foreach(library IN LISTS libraries)
  if(NOT EXISTS ${library})
    message(FATAL_ERROR
      "The html report needs ${library}, which is not there. Run `npm ci` in tools/web first "
      "(it installs exactly what tools/web/package-lock.json names).")
  endif()
endforeach()

set(page
  ${report_dir}/page/page.html
  ${report_dir}/page/page.css
  ${report_dir}/page/engines.html
  ${report_dir}/page/engines.css
  ${report_dir}/page/section.html
  ${report_dir}/page/table.html
  ${report_dir}/page/figure.html
  ${report_dir}/page/player.html
  ${report_dir}/page/subject.html
  ${report_dir}/page/self.html
  ${report_dir}/page/notebook.html
  ${report_dir}/page/notebook.json
  ${report_dir}/page/theme.js
  ${report_dir}/page/tools.js
  ${report_dir}/page/page.js
  ${report_dir}/page/figures.js
  ${report_dir}/page/player.js
  ${report_dir}/page/scene.js
  ${report_dir}/page/svg_document.js
  ${report_dir}/page/film.js
  ${report_dir}/page/response.vl.json
  ${report_dir}/page/history_rows.vl.json
  ${report_dir}/page/convergence.vl.json
  ${report_dir}/page/history.vl.json
  ${report_dir}/page/work.vl.json
  ${report_dir}/page/curves.vl.json
  ${report_dir}/page/impacts.vl.json
  ${report_dir}/page/profile.vl.json
  ${report_dir}/page/explore/explore.html
  ${report_dir}/page/explore/explore.css
  ${report_dir}/page/explore/explore.json
  ${report_dir}/page/explore/synchronized_pair.js
  ${report_dir}/page/explore/runs.js
  ${report_dir}/page/explore/explore.js
  ${report_dir}/page/atlas/atlas.html
  ${report_dir}/page/atlas/atlas.css
  ${report_dir}/page/atlas/atlas.js
  ${report_dir}/page/atlas/atlas_matrix.js
  ${report_dir}/page/atlas/atlas_panel.js
  ${report_dir}/page/atlas/atlas_figures.js
  ${report_dir}/page/atlas/atlas_ladder.vl.json
  ${report_dir}/page/atlas/atlas_map.vl.json
  ${report_dir}/page/atlas/atlas_work.vl.json)

set(CLACKERS_REPORT_ASSETS ${PROJECT_BINARY_DIR}/clackers_report_assets.cpp)
add_custom_command(
  OUTPUT ${CLACKERS_REPORT_ASSETS}
  COMMAND ${CMAKE_COMMAND} -D "FILES=${page};${libraries}" -D MODULES=${modules}
          -D OUT=${CLACKERS_REPORT_ASSETS} -P ${report_dir}/embed.cmake
  DEPENDS ${page} ${libraries} ${report_dir}/embed.cmake
          ${PROJECT_SOURCE_DIR}/tools/web/package-lock.json
  COMMENT "Embedding the html report's page and libraries"
  VERBATIM)
