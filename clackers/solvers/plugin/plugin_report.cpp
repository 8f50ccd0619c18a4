#include "clackers/solvers/plugin/plugin_report.hpp"

#include <fmt/format.h>

#include <fstream>

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"

namespace clackers::solvers {

void write(const PluginReport& report, const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  file << fmt::format("{}\n{}\n{}\n{}\n{}\n", report.stage, report.code, printable(report.sentence),
                      printable(report.name), report.by_tolerance ? "tolerance" : "step");
  if (!file.flush()) throw FileError(path.string() + ": cannot be written.", "cannot-write");
}

PluginReport read_plugin_report(const std::filesystem::path& path) {
  PluginReport report;
  std::ifstream file(path, std::ios::binary);
  std::string stage, refines;
  if (!std::getline(file, stage)) return report;
  report.stage = std::move(stage);
  std::getline(file, report.code);
  std::getline(file, report.sentence);
  std::getline(file, report.name);
  std::getline(file, refines);
  report.by_tolerance = refines == "tolerance";
  return report;
}

}  // namespace clackers::solvers
