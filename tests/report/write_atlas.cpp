// Writes the page of a made-up atlas to the file that is named: what the browser test opens.
#include <array>
#include <fstream>
#include <iostream>

#include "clackers/report/testing/sample_atlas.hpp"

int main(int count, char** arguments) {
  using namespace clackers;
  if (count != 2) {
    std::cerr << "usage: write_atlas FILE.html\n";
    return 2;
  }
  auto own = report::sample_atlas(), other = report::sample_atlas(1, 1);
  for (auto& row : own.subjects.rows)  // a range divides into long numbers
    if (row[3] == record::Cell(0.1)) row[3] = 0.35 / 3.0;
  other.subjects.rows.resize(1);
  other.runs.rows.resize(8);
  record::SheetRows first(own.runs), second(other.runs);
  std::array parts{report::sample_part(own, first),
                   report::sample_part(other, second, "A. <b>Author</b>")};
  parts[1].calls["newmark"] = "--exec './theirs <i>{h}</i>' --name newmark";
  std::ofstream file(arguments[1], std::ios::binary);
  file << report::atlas_page(parts, report::sample_atlas_text());
  file.close();
  return file ? 0 : 4;
}
