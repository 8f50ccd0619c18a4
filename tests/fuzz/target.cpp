#include "target.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "clackers/base/error.hpp"

namespace clackers::fuzz {
namespace {

constexpr auto table = std::to_array<Target>({
    {"history", read_history, mutate_numbers},
    {"result", read_history, nullptr},
    {"npy", read_npy, nullptr},
    {"events", read_events, mutate_numbers},
    {"specification", read_specification, nullptr},
    {"settings", read_settings, mutate_numbers},
    {"times", read_times, mutate_numbers},
    {"command", read_command, nullptr},
    {"record", read_record, mutate_numbers},
    {"check", check_and_report, mutate_numbers},
    {"problem", read_problem, mutate_numbers},
    {"campaign", read_campaign, mutate_numbers},
    {"atlas", show_results, mutate_numbers},
    {"query", query_database, nullptr},
});

}  // namespace

std::span<const Target> targets() { return table; }

const Target& target(std::string_view name) {
  const auto found = std::ranges::find(table, name, &Target::name);
  if (found != table.end()) return *found;
  std::fputs("fuzz: the first argument is a target:", stderr);
  for (const auto& each : table) std::fprintf(stderr, " %s", each.name.data());
  std::fputs("\n", stderr);
  std::exit(2);
}

bool run_input(const Target& target, std::string_view bytes) {
  try {
    target.run(bytes);
  } catch (const Error&) {
    return false;
  }
  return true;
}

void require(bool kept, const char* promise) {
  if (!kept) throw std::logic_error(promise);
}

MemoryFile::MemoryFile(std::string_view bytes)
    : descriptor_(::memfd_create("clackers-fuzz", MFD_CLOEXEC)),
      path_("/proc/self/fd/" + std::to_string(descriptor_)) {
  if (descriptor_ < 0 ||
      ::write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
    std::abort();
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

}  // namespace clackers::fuzz
