// How long `check` takes for a history of a million rows, and how much memory. The history is the
// exact motion of the default case with 17 digits, so that reading is as slow as it can be.
//
//     check_history [FILE]      keeps the history in FILE
#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "benchmarks/measure.hpp"
#include "clackers/exchange/history.hpp"
#include "clackers/report/format.hpp"
#include "clackers/study/check.hpp"

namespace clackers::benchmarks {
namespace {

constexpr long long rows = 1'000'000;

void write_history(const std::string& path) {
  const auto which = cases::make(cases::default_case());
  const double end = which.motion->end();
  std::ofstream out(path);
  out << "t,u1,v1,u2,v2\n";
  for (long long i = 0; i < rows; ++i) {
    const double t = end * double(i) / double(rows - 1);
    const auto now = which.motion->at(t, model::Side::right);
    out << fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", t, now.u[0], now.v[0], now.u[1],
                       now.v[1]);
  }
}

// The largest resident memory of this process so far [MB].
double peak_memory() {
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * 1024.0 / 1e6;
}

void run(const std::string& path) {
  write_history(path);
  fmt::print("{}, {}\n", processor(), compiler());
  fmt::print("{} rows of 5 columns, {:.0f} MB of text; before: {:.0f} MB resident\n", rows,
             double(std::filesystem::file_size(path)) / 1e6, peak_memory());
  const double before = processor_time();
  exchange::read_history(path, {.dof = 2, .columns = {}, .step = 0.0, .interrupt = nullptr});
  const double read = processor_time();
  fmt::print("read:  {:.2f} s, {:.0f} MB\n", (read - before) * 1e-9, peak_memory());
  study::CheckRequest request;
  request.files = {path};
  const auto record = study::check(request);
  const double whole = processor_time() - read;
  const auto word = [](bool reached) { return reached ? "reached" : "MISSED"; };
  const double memory = peak_memory();
  fmt::print("check: {:.2f} s  <= 3 s  {}; {:.0f} MB  <= 200 MB  {}\n", whole * 1e-9,
             word(whole < 3e9), memory, word(memory < 200.0));
  const auto& run = record.cases.front().subjects.front().levels.back().runs.back();
  fmt::print("error in u {}, {} metrics\n", report::scientific(run.score.u_error),
             run.metrics.size());
}

}  // namespace
}  // namespace clackers::benchmarks

int main(int argc, char** argv) {
  const bool keep = argc > 1;
  const std::string path =
      keep ? argv[1] : (std::filesystem::temp_directory_path() / "check_history.csv").string();
  clackers::benchmarks::run(path);
  if (!keep) std::remove(path.c_str());
}
