#include "clackers/report/html/film.hpp"

#include <nlohmann/json.hpp>

#include "clackers/report/assets.hpp"
#include "clackers/report/html/figure_data.hpp"

namespace clackers::report {

std::vector<FilmFile> film_files(const record::CaseRecord& problem) {
  if (!has_player(problem)) return {};
  std::string program;
  for (const auto part : {assets::svg_document_js, assets::scene_js, assets::film_js})
    program.append(part).append("\n");
  return {{"film.js", program},
          {"page.css", std::string(assets::page_css)},
          {"motion.json", player_data(problem).dump()}};
}

}  // namespace clackers::report
