#include "cli/files/baseline_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "clackers/base/error.hpp"
#include "clackers/study/verify.hpp"
#include "cli/files/output_file.hpp"
#include "cli/interrupt.hpp"
#include "cli/system_error.hpp"

namespace clackers::cli {
namespace {

// A record takes some 100 kB a method on the default ladder (720 kB for the default panel). What is
// two thousand times longer is another file (/dev/zero), which must not fill the memory.
constexpr std::size_t longest_record = 200'000'000;

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
    if (text.size() > longest_record)
      throw InputError(fmt::format("baseline {}: is longer than {} bytes; allowed: json as written "
                                   "by clackers verify --format json.",
                                   path, longest_record),
                       "not-a-record");
  }
}

}  // namespace

study::Record read_baseline(const std::string& path) {
  const auto text = read_all(path);
  try {
    return study::record_from_json(text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("baseline {}: {}", path, error.what()), error.code());
  }
}

}  // namespace clackers::cli
