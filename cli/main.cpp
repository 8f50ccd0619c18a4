#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "clackers/base/error.hpp"
#include "cli/command.hpp"
#include "cli/files/output_stream.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"

namespace clackers::cli {
namespace {

// A file opened while 0, 1 or 2 is closed would become standard input or output. Read-only, so
// that writing to a closed standard output still fails.
void open_standard_descriptors() {
  for (int number = 0; number <= 2; ++number)
    if (::fcntl(number, F_GETFD) == -1) ::open("/dev/null", O_RDONLY);
}

int report(const std::exception& error, std::string_view code, int exit_code) {
  report_error(error.what(), code);
  return exit_code;
}

int guarded(const std::vector<std::string>& arguments) {
  try {
    return run_command_line(arguments);
  } catch (const InputError& error) {
    return report(error, error.code().name(), 2);
  } catch (const Error& error) {
    return report(error, error.code().name(), error.code() == Code("interrupted") ? 130 : 4);
  } catch (const BrokenPipe&) {
    return 0;
  } catch (const std::bad_alloc&) {
    report_error("not enough memory for this request; ask for less.", "out-of-memory");
    return 4;
  } catch (const std::filesystem::filesystem_error& error) {
    report_error(fmt::format("cannot use {}: {}. Name another file or folder.",
                             error.path1().string(), error.code().message()),
                 "system-failed");
    return 4;
  } catch (const std::system_error& error) {
    return report(error, "system-failed", 4);
  } catch (const std::exception& error) {
    report_error(fmt::format("a mistake in the program: {}. Please report it with your command.",
                             error.what()),
                 "internal-error");
    return 4;
  }
}

}  // namespace
}  // namespace clackers::cli

int main(int argc, char** argv) {
  clackers::cli::open_standard_descriptors();
  clackers::cli::catch_signals();
  return clackers::cli::guarded({argv + (argc > 0 ? 1 : 0), argv + argc});
}
