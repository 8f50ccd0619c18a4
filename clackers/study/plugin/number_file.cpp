#include "clackers/study/plugin/number_file.hpp"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "clackers/base/error.hpp"

namespace clackers::study {
namespace {

constexpr std::size_t most_buffered = 1 << 16;  // [bytes]

}  // namespace

NumberFile::NumberFile(std::filesystem::path path) : path_(std::move(path)), temporary_(path_) {
  temporary_ += ".part";
}

NumberFile::~NumberFile() {
  std::error_code error;
  std::filesystem::remove(temporary_, error);  // none after commit()
}

void NumberFile::add(std::string_view name) {
  buffer_ += name;
  buffer_ += ',';
}

void NumberFile::add(double value) { fmt::format_to(std::back_inserter(buffer_), "{},", value); }

void NumberFile::add(const double* values, int count) {
  for (int i = 0; i < count; ++i) add(values[i]);
}

void NumberFile::end_row() {
  buffer_.back() = '\n';  // instead of the last comma
  if (buffer_.size() >= most_buffered) flush();
}

void NumberFile::flush() {
  if (!file_.is_open()) file_.open(temporary_, std::ios::binary);
  file_ << buffer_;
  written_ += buffer_.size();
  buffer_.clear();
}

void NumberFile::commit() {
  flush();
  file_.close();
  std::error_code error;
  if (file_) std::filesystem::rename(temporary_, path_, error);
  if (!file_ || error) throw FileError(path_.string() + ": cannot be written.", "cannot-write");
}

}  // namespace clackers::study
