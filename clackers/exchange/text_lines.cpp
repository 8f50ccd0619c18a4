#include "clackers/exchange/text_lines.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "clackers/base/error.hpp"

namespace clackers::exchange {
namespace {

constexpr std::size_t block = std::size_t{1} << 20;
static_assert(block >= longest_line);

[[noreturn]] void fail(const std::string& path, int error) {
  throw FileError(fmt::format("{}: cannot read: {}.", path, std::strerror(error)), "cannot-read");
}

}  // namespace

std::string shown_name(const std::string& path) { return path == "-" ? "standard input" : path; }

TextLines::TextLines(const std::string& path, const std::atomic<bool>* interrupt)
    : path_(shown_name(path)), interrupt_(interrupt), bytes_(block + longest_line) {
  // A copy of standard input, so that closing it at the end is right in both cases.
  descriptor_ = path == "-" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3)
                            : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail(path_, errno);
  struct stat facts {};
  if (::fstat(descriptor_, &facts) != 0 || S_ISDIR(facts.st_mode)) {
    const int error = S_ISDIR(facts.st_mode) ? EISDIR : errno;
    ::close(descriptor_);
    fail(path_, error);
  }
  if (S_ISREG(facts.st_mode)) size_ = facts.st_size;
}

TextLines::~TextLines() { ::close(descriptor_); }

std::string TextLines::place() const { return fmt::format("{} line {}", path_, number_); }

void TextLines::check_block(std::size_t from) const {
  const std::string_view fresh{bytes_.data() + from, have_ - from};
  const bool first = consumed_ == 0 && from == 0;
  if (first && (fresh.starts_with("\xFF\xFE") || fresh.starts_with("\xFE\xFF")))
    throw InputError(path_ + " is text in UTF-16; allowed: UTF-8 or ASCII. Save it as UTF-8.",
                     "not-text");
  if (fresh.find('\0') != std::string_view::npos)
    throw InputError(path_ +
                         " is no text: it has a byte 0 in it; allowed: rows of numbers as text. "
                         "Export the history as text.",
                     "not-text");
}

// Moves what is left of the last block to the front and reads behind it.
bool TextLines::fill() {
  if (ended_) return false;
  std::memmove(bytes_.data(), bytes_.data() + at_, have_ - at_);
  have_ -= at_;
  at_ = 0;
  while (true) {
    if (interrupt_ != nullptr && *interrupt_) throw Error("interrupted", "interrupted");
    const auto count = ::read(descriptor_, bytes_.data() + have_, bytes_.size() - have_);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path_, errno);
    const auto from = have_;
    have_ += static_cast<std::size_t>(count);
    ended_ = count == 0;
    check_block(from);
    return !ended_;
  }
}

bool TextLines::next() {
  if (number_ == 0) {
    while (have_ < 3 && fill()) {
    }
    if (std::string_view(bytes_.data(), have_).starts_with("\xEF\xBB\xBF")) at_ = 3;
  }
  ++number_;
  std::size_t looked = 0;  // bytes behind at_ that hold no line feed
  const void* end = nullptr;
  while (true) {
    if (have_ > at_ + looked)
      end = std::memchr(bytes_.data() + at_ + looked, '\n', have_ - at_ - looked);
    if (end != nullptr) break;
    looked = have_ - at_;
    if (looked > longest_line) break;
    if (!fill()) break;
  }
  const char* const begin = bytes_.data() + at_;
  if (end == nullptr && at_ == have_) return false;
  const auto length = end != nullptr
                          ? static_cast<std::size_t>(static_cast<const char*>(end) - begin)
                          : have_ - at_;
  if (length > longest_line)
    throw InputError(
        fmt::format("{} is longer than {} bytes; allowed: one time a line.", place(), longest_line),
        "not-text");
  unended_ = end == nullptr && length > 0;
  at_ += length + (end != nullptr);
  consumed_ += static_cast<long long>(length) + 1;
  text_ = {begin, length};
  if (text_.ends_with('\r')) text_.remove_suffix(1);
  // Twice memchr is several times as fast as one search for either.
  const auto mark = std::min(text_.find('#'), text_.find('%'));
  comment_ = mark == std::string_view::npos ? std::string_view{} : text_.substr(mark + 1);
  text_ = text_.substr(0, mark);
  return true;
}

}  // namespace clackers::exchange
