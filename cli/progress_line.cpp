#include "cli/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace clackers::cli {
namespace {

constexpr int line_width = 79;

// Blanks instead of an escape sequence, so that every terminal understands.
void put(const std::string& text) {
  std::fputs(fmt::format("\r{:<{}}\r{}", "", line_width, text).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

std::string duration_text(double seconds) {
  const auto s = static_cast<long long>(seconds + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

ProgressLine::ProgressLine(std::string what, bool quiet)
    : what_(std::move(what)),
      visible_(!quiet && ::isatty(STDERR_FILENO) != 0),
      start_(Clock::now()) {}

ProgressLine::~ProgressLine() {
  if (visible_) put("");
}

void ProgressLine::report(double share) {
  show(share, [](double) { return std::string(); });
}

void ProgressLine::report(double share, long long done, std::string_view unit) {
  show(share, [&](double elapsed) {
    return fmt::format(" {} {}, {:.0f}/s,", done, unit, double(done) / std::max(elapsed, 0.1));
  });
}

void ProgressLine::show(double share, const std::function<std::string(double)>& detail) {
  if (!visible_) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  if (share < share_) start_ = now;  // a new round of work
  share_ = share;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  auto line = fmt::format("{} {:3.0f} %,{} {} elapsed", what_, 100.0 * share, detail(elapsed),
                          duration_text(elapsed));
  // Before a twentieth is done the rest cannot be estimated.
  if (share >= 0.05)
    line += fmt::format(", about {} left", duration_text(elapsed * (1.0 - share) / share));
  put(line);
}

}  // namespace clackers::cli
