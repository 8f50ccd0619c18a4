#include "clackers/base/files/input_file.hpp"

#include <sys/stat.h>

#include <array>

#include "clackers/base/testing/test_file.hpp"

namespace clackers {
namespace {

std::string read(InputFile& file, std::size_t capacity) {
  std::string bytes(capacity, '\0');
  bytes.resize(file.read(bytes.data(), capacity));
  return bytes;
}

TEST(InputFile, ReadsItsFirstBytesAgain) {
  const TestFile test("abcdefgh");
  InputFile opened(test.path());
  EXPECT_EQ(opened.first_bytes(6), "abcdef");
  EXPECT_EQ(opened.first_bytes(2), "ab");
  EXPECT_EQ(opened.first_bytes(4), "abcd");
  InputFile file(std::move(opened));
  EXPECT_EQ(file.size(), 8);
  EXPECT_EQ(file.name(), test.path());
  EXPECT_EQ(read(file, 3), "abc");
  EXPECT_EQ(read(file, 3), "def");
  EXPECT_EQ(read(file, 3), "gh");
  EXPECT_EQ(read(file, 3), "");
}

TEST(InputFile, HasFewerFirstBytesWhereItIsShort) {
  const TestFile test("ab");
  InputFile file(test.path());
  EXPECT_EQ(file.first_bytes(6), "ab");
  EXPECT_EQ(read(file, 6), "ab");
}

TEST(InputFile, ReadsFromAnyPlaceWithoutMoving) {
  const TestFile test("abcdefgh");
  InputFile file(test.path());
  std::array<char, 4> bytes{};
  EXPECT_EQ(file.read_all_at(3, bytes.data(), 4), 4u);
  EXPECT_EQ(std::string(bytes.data(), 4), "defg");
  EXPECT_EQ(file.read_all_at(6, bytes.data(), 4), 2u);
  EXPECT_EQ(read(file, 2), "ab");
  EXPECT_EQ(file.read_all(bytes.data(), 4), 4u);
  EXPECT_EQ(std::string(bytes.data(), 4), "cdef");
  EXPECT_EQ(file.read_all(bytes.data(), 4), 2u);
}

TEST(InputFile, OfStandardInputBeginsWhereItStands) {
  const TestFile test("abcdefgh");
  ASSERT_NE(std::freopen(test.path().c_str(), "r", stdin), nullptr);
  ASSERT_EQ(::lseek(STDIN_FILENO, 2, SEEK_SET), 2);
  InputFile file("-");
  EXPECT_EQ(file.size(), 6);
  std::array<char, 2> bytes{};
  EXPECT_EQ(file.read_all_at(1, bytes.data(), 2), 2u);
  EXPECT_EQ(std::string(bytes.data(), 2), "de");
  EXPECT_EQ(read(file, 8), "cdefgh");
}

TEST(InputFile, WaitsForNobodyOnceAFlagIsUp) {
  const TestFile test("ab");
  const std::string pipe = test.path() + "-pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  static std::atomic<bool> interrupt;
  end_reading_on(interrupt);
  interrupt = true;
  EXPECT_REFUSED(read_file(pipe), "interrupted", "");
  EXPECT_EQ(read_file(test.path()), "ab") << "a regular file is there after a signal, too";
  EXPECT_REFUSED(InputFile(test.path(), &interrupt).size(), "interrupted", "");
  interrupt = false;
  ::unlink(pipe.c_str());
}

}  // namespace
}  // namespace clackers
