#include "clackers/input/text/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>

#include "clackers/base/error.hpp"

namespace clackers::input {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t block = std::size_t{1} << 20;

[[noreturn]] void refuse_bytes(const std::string& name, std::string_view what,
                               std::string_view advice) {
  throw InputError(fmt::format("{} {}; allowed: rows of numbers as text. {}", name, what, advice),
                   "not-text");
}

// Where a comment begins. Twice memchr is several times as fast as one search for either.
std::size_t first_mark(std::string_view text) { return std::min(text.find('#'), text.find('%')); }

bool has_mark(std::string_view text) { return first_mark(text) != std::string_view::npos; }

// What the first bytes of a file say about its format, where that is not text.
void refuse_other_formats(const std::string& name, std::string_view bytes) {
  struct Format {
    std::string_view bytes, what, advice;
  };
  constexpr auto utf8 = "Save it as UTF-8."sv, decompress = "Decompress it first."sv;
  // UTF-32 with the smallest byte first begins like UTF-16.
  for (const auto& format : std::initializer_list<Format>{
           {"\xFF\xFE\0\0"sv, "is text in UTF-32", utf8},
           {"\0\0\xFE\xFF"sv, "is text in UTF-32", utf8},
           {"\xFF\xFE"sv, "is text in UTF-16", utf8},
           {"\xFE\xFF"sv, "is text in UTF-16", utf8},
           {"\x1F\x8B"sv, "is compressed with gzip",
            "Decompress it: gunzip -c FILE | clackers check -"},
           {"BZh"sv, "is compressed with bzip2", decompress},
           {"\xFD\x37zXZ"sv, "is compressed with xz", decompress},
           {"\x28\xB5\x2F\xFD"sv, "is compressed with zstd", decompress},
           {"PK\x03\x04"sv, "is a zip archive (npz) or a spreadsheet",
            "Export the history as csv or npy."},
           {"\x93NUMPY"sv, "is an array of NumPy", "Save it with numpy.savetxt."}})
    if (bytes.starts_with(format.bytes)) refuse_bytes(name, format.what, format.advice);
}

}  // namespace

// A small file needs no whole block.
TextLines::TextLines(InputFile file)
    : file_(std::move(file)),
      bytes_(file_.size() > 0 ? std::min(std::size_t(file_.size()) + 1, block) : block) {}

std::string TextLines::place() const { return fmt::format("{} line {}", name(), number_); }

// Moves what is left of the last block to the front and reads behind it.
bool TextLines::fill() {
  if (ended_) return false;
  if (at_ > 0) std::memmove(bytes_.data(), bytes_.data() + at_, have_ - at_);
  have_ -= at_;
  at_ = 0;
  has_marks_ = has_marks_ && has_mark(rest());
  if (have_ == bytes_.size()) bytes_.resize(2 * bytes_.size());
  const auto from = have_;
  have_ += file_.read(bytes_.data() + have_, bytes_.size() - have_);
  ended_ = have_ == from;
  has_marks_ = has_marks_ || has_mark(rest().substr(from));
  if (number_ > 0 && rest().substr(from).find('\0') != std::string_view::npos)
    refuse_bytes(name(), "is no text: it has a byte 0 in it", "Export the history as text.");
  return !ended_;
}

// Finds out what kind of text it is.
void TextLines::begin() {
  while (have_ < 6 && fill()) {
  }
  refuse_other_formats(name(), rest());
  number_ = 1;
  if (rest().find('\0') != std::string_view::npos)
    refuse_bytes(name(), "is no text: it has a byte 0 in it", "Export the history as text.");
  if (rest().starts_with("\xEF\xBB\xBF")) at_ = 3;
  // CR ends the lines of a file that has no LF among its first bytes.
  while (true) {
    const auto end = rest().find_first_of("\r\n");
    const bool is_known =
        end != std::string_view::npos && (rest()[end] == '\n' || end + 1 < rest().size());
    if (is_known || rest().size() > longest_line || !fill()) break;
  }
  if (rest().find('\r') != std::string_view::npos && rest().find('\n') == std::string_view::npos)
    line_end_ = '\r';
  number_ = 0;
}

bool TextLines::next() {
  if (number_ == 0) begin();
  ++number_;
  std::size_t length = std::string_view::npos, looked = 0;
  while (true) {
    length = rest().find(line_end_, looked);
    looked = have_ - at_;
    if (length != std::string_view::npos || looked > longest_line || !fill()) break;
  }
  if (length == std::string_view::npos && at_ == have_) {
    --number_;
    return false;
  }
  without_line_end_ = length == std::string_view::npos;
  length = std::min(length, have_ - at_);
  if (length > longest_line)
    refuse_bytes(place(), fmt::format("is longer than {} bytes", longest_line),
                 "End each row with a line feed.");
  text_ = rest().substr(0, length);
  at_ += length + !without_line_end_;
  consumed_ += static_cast<long long>(length) + 1;
  if (text_.ends_with('\r')) text_.remove_suffix(1);
  const auto mark = has_marks_ ? first_mark(text_) : std::string_view::npos;
  comment_ = mark == std::string_view::npos ? std::string_view{} : text_.substr(mark + 1);
  text_ = text_.substr(0, mark);
  return true;
}

}  // namespace clackers::input
