#include "clackers/paper/rendering/files.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "clackers/base/error.hpp"

namespace clackers::paper {
namespace {

std::string reason(int error) { return error == 0 ? "unknown reason" : std::strerror(error); }

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw FileError("cannot write " + path.string() + ": " + reason(error) + ".", "cannot-write");
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view text) {
  errno = 0;
  std::ofstream out(path, std::ios::binary);
  out.write(text.data(), std::streamsize(text.size()));
  out.close();
  if (!out) fail(path, errno);
}

std::string read_file(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad())
    throw FileError("cannot read " + path.string() + ": " + reason(errno) + ".", "cannot-read");
  return text;
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directory(path, error);
  if (error) fail(path, error.value());
}

}  // namespace clackers::paper
