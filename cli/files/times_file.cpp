#include "cli/files/times_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <optional>
#include <string_view>

#include "clackers/base/error.hpp"
#include "cli/files/output_file.hpp"
#include "cli/interrupt.hpp"
#include "cli/system_error.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

// A line longer than this is no time; it keeps a wrong file (/dev/zero) from filling the memory.
constexpr std::size_t longest_line = 1000;

class Lines {
 public:
  Lines(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}

  /// The next line without its end, or nothing after the last.
  std::optional<std::string> next() {
    std::string line;
    ++number_;
    while (true) {
      if (at_ == have_ && !fill()) return line.empty() ? std::nullopt : std::optional(line);
      const char c = bytes_[at_++];
      if (c == '\n') return line;
      line += c;
      if (line.size() > longest_line)
        throw InputError(fmt::format("{} is longer than {} bytes; allowed: one time a line, in "
                                     "seconds.",
                                     place(), longest_line),
                         "not-a-number");
    }
  }
  /// "FILE line 3", of the last line.
  std::string place() const { return fmt::format("{} line {}", name_, number_); }

 private:
  bool fill() {
    while (true) {
      if (interrupt_flag()) throw Interrupted();
      const auto count = ::read(descriptor_, bytes_.data(), bytes_.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail_to_read(name_, errno);
      at_ = 0;
      have_ = static_cast<std::size_t>(count);
      return count > 0;
    }
  }

  int descriptor_;
  std::string name_;
  long long number_ = 0;
  std::array<char, 1 << 16> bytes_;
  std::size_t at_ = 0, have_ = 0;
};

std::string_view content(std::string_view line) {
  constexpr std::string_view blank = " \t\r\v\f";
  line = line.substr(0, line.find_first_of("#%"));
  const auto first = line.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(blank) + 1 - first);
}

}  // namespace

std::vector<double> read_times(const std::string& path, double end) {
  const bool standard = path == "-";
  const auto name = standard ? std::string("standard input") : path;
  // A copy of standard input, so that closing it at the end is right in both cases.
  const int number = standard ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3)
                              : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (number < 0) fail_to_read(name, errno);
  const Descriptor descriptor(number);
  Lines lines(number, name);
  std::vector<double> times;
  while (const auto line = lines.next()) {
    const auto text = content(*line);
    if (text.empty()) continue;
    const double t = read_number(lines.place(), text);
    if (!(t >= 0.0 && t <= end))
      refuse("clackers", lines.place(), t, fmt::format("0 <= t <= {} s", end),
             "Set t_end or a_t of the case for a longer run.", "time-outside");
    times.push_back(t);
  }
  if (times.empty())
    throw InputError(name + " has no times in it; allowed: one time a line, in seconds.",
                     "bad-syntax");
  return times;
}

}  // namespace clackers::cli
