// Without libFuzzer: clackers_fuzz TARGET FILE_OR_FOLDER ... runs every file once.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "target.hpp"

namespace fs = std::filesystem;

namespace {

int count = 0;

void replay(const clackers::fuzz::Target& target, const fs::path& file) {
  std::printf("%s: ", file.c_str());
  std::fflush(stdout);  // the last line names the file that failed
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::puts(clackers::fuzz::run_input(target, bytes) ? "taken" : "refused");
  ++count;
}

}  // namespace

int main(int argc, char** argv) {
  const auto& target = clackers::fuzz::target(argc > 1 ? argv[1] : "");
  for (int i = 2; i < argc; ++i) {
    std::set<fs::path> files{argv[i]};
    if (fs::is_directory(argv[i])) files = {fs::directory_iterator(argv[i]), {}};
    for (const auto& file : files) replay(target, file);
  }
  if (count > 0) return 0;
  std::fputs("fuzz: no file was replayed\n", stderr);
  return 2;
}
