#include "cli/files/baseline_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "clackers/base/error.hpp"
#include "clackers/study/record_json.hpp"
#include "cli/files/output_file.hpp"
#include "cli/interrupt.hpp"
#include "cli/system_error.hpp"

namespace clackers::cli {
namespace {

std::string read_all(const std::string& path) {
  // A copy of standard input, so that closing it at the end is right in both cases.
  const int number = path == "-" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3)
                                 : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (number < 0) fail_to_read(path, errno);
  const Descriptor descriptor(number);
  std::string text;
  std::array<char, 1 << 16> bytes;
  while (true) {
    if (interrupt_flag()) throw Interrupted();
    const auto count = ::read(number, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_to_read(path, errno);
    if (count == 0) return text;
    text.append(bytes.data(), static_cast<std::size_t>(count));
    if (text.size() > study::longest_record)
      throw InputError(fmt::format("baseline {}: is longer than {} bytes; allowed: json as written "
                                   "by clackers verify or check with --format json.",
                                   path, study::longest_record),
                       "not-a-record");
  }
}

}  // namespace

study::Record read_baseline(const std::string& path) {
  const auto text = read_all(path);
  try {
    return study::record_from_json(text, &interrupt_flag());
  } catch (const InputError& error) {
    throw InputError(fmt::format("baseline {}: {}", path, error.what()), error.code());
  }
}

}  // namespace clackers::cli
