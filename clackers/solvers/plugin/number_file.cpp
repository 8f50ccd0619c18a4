#include "clackers/solvers/plugin/number_file.hpp"

#include <bit>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/base/npy_writer.hpp"

namespace clackers::solvers {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t most_buffered = 1 << 13;  // numbers

}  // namespace

NumberFile::NumberFile(std::filesystem::path path) : path_(std::move(path)), temporary_(path_) {
  temporary_ += ".part";
}

NumberFile::~NumberFile() {
  std::error_code error;
  std::filesystem::remove(temporary_, error);  // none after commit()
}

void NumberFile::set_names(std::vector<std::string> names) { names_ = std::move(names); }

void NumberFile::end_row() {
  if (buffer_.size() >= most_buffered) flush();
}

// The header of the rows so far; its length does not depend on them.
std::string NumberFile::header() const {
  constexpr long long most_rows = 1LL << 60;
  return npy_header(names_, static_cast<long long>(written_ / names_.size()), most_rows);
}

void NumberFile::flush() {
  if (!file_.is_open()) {
    file_.open(temporary_, std::ios::binary);
    file_ << header();
  }
  file_.write(reinterpret_cast<const char*>(buffer_.data()),
              static_cast<std::streamsize>(buffer_.size() * sizeof(double)));
  written_ += buffer_.size();
  buffer_.clear();
}

void NumberFile::commit() {
  flush();
  file_.seekp(0);
  file_ << header();
  file_.close();
  std::error_code error;
  if (file_) std::filesystem::rename(temporary_, path_, error);
  if (!file_ || error) throw FileError(path_.string() + ": cannot be written.", "cannot-write");
}

}  // namespace clackers::solvers
