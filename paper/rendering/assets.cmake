# The page of `clackers paper`, the script that draws and the light colours of the report's style
# sheet, as one generated source file. Sets CLACKERS_PAPER_ASSETS to it.
set(paper_dir ${PROJECT_SOURCE_DIR}/paper/rendering)
set(paper_page ${paper_dir}/page/page.html ${paper_dir}/page/open_points.html ${paper_dir}/page/paper.css
  ${paper_dir}/page/look.json ${PROJECT_SOURCE_DIR}/paper/claims/claims.json ${paper_dir}/page/render.js)
set(paper_colors ${PROJECT_SOURCE_DIR}/clackers/report/page/page.css)
set(CLACKERS_PAPER_ASSETS ${PROJECT_BINARY_DIR}/clackers_paper_assets.cpp)
add_custom_command(
  OUTPUT ${CLACKERS_PAPER_ASSETS}
  COMMAND ${CMAKE_COMMAND} -D "FILES=${paper_page}" -D COLORS=${paper_colors}
          -D OUT=${CLACKERS_PAPER_ASSETS} -P ${paper_dir}/embed.cmake
  DEPENDS ${paper_page} ${paper_colors} ${paper_dir}/embed.cmake
  COMMENT "Embedding the page of the paper's figures"
  VERBATIM)
