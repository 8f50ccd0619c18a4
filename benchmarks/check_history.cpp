// How long `check` takes for a history of a million rows, and how much memory: as text, as a NumPy
// file and in memory. The history is the exact motion of the default case; its text has 17 digits, so
// that reading is as slow as it can be.
//
//     check_history [FOLDER]      keeps the files in FOLDER
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

#include "benchmarks/measure.hpp"
#include "clackers/input/history.hpp"
#include "clackers/report/format.hpp"
#include "clackers/study/check.hpp"

namespace clackers::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t rows = 1'000'000;
constexpr std::array names = {"t", "u1", "v1", "u2", "v2"};

// Row by row.
std::vector<double> history() {
  const auto problem = cases::make(cases::default_case());
  const double end = problem.motion->end();
  std::vector<double> numbers;
  numbers.reserve(rows * names.size());
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = end * double(i) / double(rows - 1);
    const auto now = problem.motion->at(t, model::Side::right);
    numbers.insert(numbers.end(), {t, now.u[0], now.v[0], now.u[1], now.v[1]});
  }
  return numbers;
}

void write_csv(const fs::path& path, std::span<const double> numbers) {
  std::ofstream out(path);
  out << fmt::format("{}\n", fmt::join(names, ","));
  for (; !numbers.empty(); numbers = numbers.subspan(names.size()))
    out << fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", numbers[0], numbers[1],
                       numbers[2], numbers[3], numbers[4]);
}

void write_npy(const fs::path& path, std::span<const double> numbers) {
  std::string fields;
  for (const auto* name : names) fields += fmt::format("('{}', '<f8'), ", name);
  const auto header =
      fmt::format("{{'descr': [{}], 'fortran_order': False, 'shape': ({},)}}\n", fields, rows);
  std::ofstream out(path, std::ios::binary);
  out << "\x93NUMPY\x01" << '\0' << char(header.size() % 256) << char(header.size() / 256)
      << header;
  out.write(reinterpret_cast<const char*>(numbers.data()), std::streamsize(numbers.size_bytes()));
}

input::NumberColumns columns_of(const std::vector<double>& numbers) {
  input::NumberColumns columns{"history 1", numbers.size() / names.size(), {}};
  for (const auto* name : names)
    columns.columns.push_back(
        {name, numbers.data() + columns.columns.size(), std::ptrdiff_t(names.size())});
  return columns;
}

// The largest resident memory of this process so far [MB].
double peak_memory() {
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * 1024.0 / 1e6;
}

// In a process of its own, since the peak of memory never falls.
void measure(const char* kind, const input::Source& source, double most_memory) {
  std::fflush(nullptr);
  if (const auto child = ::fork(); child != 0) {
    ::waitpid(child, nullptr, 0);
    return;
  }
  const double start = processor_time(), before = peak_memory();
  const auto expected = input::read_history(source, {.dof = 2}).motion.t.size();
  const double read = processor_time();
  study::CheckRequest request;
  request.subjects[0].files = {source};
  const auto record = study::check(request);
  const double whole = processor_time() - read, memory = peak_memory() - before;
  const auto word = [](bool reached) { return reached ? "reached" : "MISSED"; };
  fmt::print("{:<8} {:>8.2f} {:>8.2f}  <= 3 s  {}  {:>6.0f}  <= {:.0f} MB  {}\n", kind,
             (read - start) * 1e-9, whole * 1e-9, word(whole < 3e9), memory, most_memory,
             word(memory < most_memory));
  const auto& run = record.cases.front().subjects.front().levels.back().runs.back();
  if (expected != rows || run.file->rows != static_cast<long long>(rows) || run.metrics.empty() ||
      run.score.u_error > 0.0)
    fmt::print("{}: the history is not the exact one: {} rows, error in u {}\n", kind,
               run.file->rows, scientific(run.score.u_error));
  std::fflush(nullptr);
  ::_exit(0);
}

void run(const fs::path& folder) {
  const auto csv = folder / "check_history.csv", npy = folder / "check_history.npy";
  fmt::print("{}, {}\n", processor(), compiler());
  fmt::print("{} rows of {} columns; processor time [s], memory beside the caller's [MB]\n", rows,
             names.size());
  fmt::print("{:<8} {:>8} {:>8} {:>25}\n", "", "read", "check", "memory");
  const auto numbers = history();
  write_csv(csv, numbers);
  write_npy(npy, numbers);
  measure("csv", csv.string(), 200.0);
  measure("npy", npy.string(), 200.0);
  measure("memory", columns_of(numbers), 200.0);
}

}  // namespace
}  // namespace clackers::benchmarks

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  const bool keep = argc > 1;
  const auto folder =
      keep ? fs::path(argv[1])
           : fs::temp_directory_path() / fmt::format("clackers-check-history-{}", ::getpid());
  fs::create_directories(folder);
  clackers::benchmarks::run(folder);
  if (!keep) fs::remove_all(folder);
}
