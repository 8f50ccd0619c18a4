#include "paper/rendering/files.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "clackers/base/error.hpp"

namespace clackers::paper {
namespace {

std::string text(const char* what, const std::filesystem::path& path, int error) {
  return std::string("cannot ") + what + ' ' + path.string() + ": " +
         (error == 0 ? "unknown reason" : std::strerror(error)) + '.';
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  errno = 0;
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), std::streamsize(bytes.size()));
  out.close();
  if (!out) throw FileError(text("write", path, errno), "cannot-write");
}

std::string read_file(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) throw FileError(text("read", path, errno), "cannot-read");
  return bytes;
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directory(path, error);
  if (error) throw FileError(text("write", path, error.value()), "cannot-write");
}

}  // namespace clackers::paper
