# The page of `clackers paper` and the script that draws, as one generated source file. Sets
# CLACKERS_PAPER_ASSETS to it.
set(paper_dir ${PROJECT_SOURCE_DIR}/clackers/paper)
set(paper_page ${paper_dir}/page/page.html ${paper_dir}/page/paper.css ${paper_dir}/page/render.js)
set(CLACKERS_PAPER_ASSETS ${PROJECT_BINARY_DIR}/clackers_paper_assets.cpp)
add_custom_command(
  OUTPUT ${CLACKERS_PAPER_ASSETS}
  COMMAND ${CMAKE_COMMAND} -D "FILES=${paper_page}" -D OUT=${CLACKERS_PAPER_ASSETS}
          -P ${paper_dir}/embed.cmake
  DEPENDS ${paper_page} ${paper_dir}/embed.cmake
  COMMENT "Embedding the page of the paper's figures"
  VERBATIM)
