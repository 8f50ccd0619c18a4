// Writes the html page of the sample record to the file that is named: what the browser test opens.
#include <fstream>
#include <iostream>

#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/write.hpp"

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: write_sample FILE.html\n";
    return 2;
  }
  std::ofstream file(arguments[1], std::ios::binary);
  file << clackers::report::html(clackers::report::sample_record());
  file.close();
  return file ? 0 : 4;
}
