#include "bindings/c/guard.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace clackers::c_api {
namespace {

clackers_status status_of(const auto& thrown) {
  return guarded([&] { throw thrown; });
}

TEST(Guard, EveryExceptionBecomesAStatusWithTextAndCode) {
  EXPECT_EQ(status_of(InputError("a: no.", "not-odd")), CLACKERS_REFUSED);
  EXPECT_STREQ(clackers_last_error(), "a: no.");
  EXPECT_STREQ(clackers_last_error_code(), "not-odd");

  EXPECT_EQ(status_of(std::bad_alloc()), CLACKERS_OUT_OF_MEMORY);
  EXPECT_STREQ(clackers_last_error(), "clackers: out of memory; ask for less.");
  EXPECT_STREQ(clackers_last_error_code(), "out-of-memory");

  EXPECT_EQ(status_of(FileError("b: gone.", "cannot-read")), CLACKERS_REFUSED);
  EXPECT_STREQ(clackers_last_error(), "b: gone.");
  EXPECT_STREQ(clackers_last_error_code(), "cannot-read");

  EXPECT_EQ(status_of(std::logic_error("c")), CLACKERS_INTERNAL_ERROR);
  EXPECT_STREQ(clackers_last_error(), "c");
  EXPECT_STREQ(clackers_last_error_code(), "internal-error");

  EXPECT_EQ(status_of(7), CLACKERS_INTERNAL_ERROR);
  EXPECT_STREQ(clackers_last_error(), "clackers: an unknown exception.");
  EXPECT_STREQ(clackers_last_error_code(), "internal-error");
}

TEST(Guard, SuccessForgetsTheErrorBeforeIt) {
  status_of(std::logic_error("c"));
  EXPECT_EQ(guarded([] {}), CLACKERS_OK);
  EXPECT_STREQ(clackers_last_error(), "");
  EXPECT_STREQ(clackers_last_error_code(), "");
}

TEST(Guard, ALongTextIsKeptWhole) {
  const std::string text(10'000, 'x');
  status_of(std::logic_error(text));
  EXPECT_EQ(clackers_last_error(), text);
}

}  // namespace
}  // namespace clackers::c_api
