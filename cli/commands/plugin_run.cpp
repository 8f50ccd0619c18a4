#include "cli/commands/plugin_run.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <cstdlib>
#include <exception>
#include <filesystem>

#include "clackers/base/error.hpp"
#include "clackers/solvers/plugin.hpp"

namespace clackers::cli {

std::vector<std::string> plugin_host_words() {
  constexpr auto link = "/proc/self/exe";
  std::error_code error;
  const auto program = std::filesystem::read_symlink(link, error);
  if (error)
    throw FileError(fmt::format("{}: {}; plug-ins need it.", link, error.message()), "cannot-read");
  return {program.string(), std::string(plugin_run_flag)};
}

int run_plugin(const std::vector<std::string>& arguments) {
  // Ours would turn a crash of the library into a message and an exit code.
  for (int number = 1; number < SIGRTMIN; ++number) ::signal(number, SIG_DFL);
  std::set_terminate(std::abort);
  return solvers::host_plugin(arguments) ? 0 : 4;
}

}  // namespace clackers::cli
