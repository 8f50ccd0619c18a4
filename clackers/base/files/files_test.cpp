#include "clackers/base/files/files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "clackers/base/testing/refusal.hpp"

namespace clackers {
namespace {

TEST(Files, AreReadAsTheyWereWritten) {
  const auto path = testing::TempDir() + "clackers_files_test";
  for (const auto& bytes : {std::string(200000, 'x') + std::string("\0\r\n", 3), std::string()}) {
    write_file(path, bytes);
    EXPECT_EQ(read_file(path), bytes);
  }
  ::unlink(path.c_str());
}

TEST(Files, MessageHasNameReasonAndHint) {
  EXPECT_REFUSED(read_file("/no/such/file", "Name another."), "cannot-read",
                 "cannot read /no/such/file: No such file or directory. Name another.");
  EXPECT_REFUSED(read_file("/"), "cannot-read", "cannot read /: Is a directory.");
  for (const std::size_t most : {std::size_t{100000}, longest_text})
    EXPECT_REFUSED(
        read_file("/dev/zero", "Name another.", most), "cannot-read",
        "cannot read /dev/zero: it is too large; allowed: " + std::to_string(most) + " bytes.");
  EXPECT_REFUSED(write_file("/no/such/file", "x"), "cannot-write",
                 "cannot write /no/such/file: No such file or directory.");
  EXPECT_REFUSED(write_file("/dev/full", "x"), "cannot-write", "No space left on device");
}

}  // namespace
}  // namespace clackers
