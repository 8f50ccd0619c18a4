#pragma once

#include <string>
#include <vector>

#include "clackers/record/record.hpp"

namespace clackers::report {

struct FilmFile {
  std::string name, text;
};

/// What draws the frames of a film: the motion of a case, and shown runs beside it. In a folder with these
/// files `node film.js . FRAMES PIXELS` writes 00001.svg, 00002.svg, ..., PIXELS wide. Empty where the
/// structure has no drawing.
std::vector<FilmFile> film_files(const record::CaseRecord& problem);

}  // namespace clackers::report
