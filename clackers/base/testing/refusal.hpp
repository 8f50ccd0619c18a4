#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <string_view>

#include "clackers/base/error.hpp"

namespace clackers::test {

/// "message [code]" of the Error that `call` throws, or "accepted".
std::string refusal_of(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    return std::string(error.what()) + " [" + std::string(error.code().name()) + "]";
  }
  return "accepted";
}

/// Whether a refusal has this code and its message all `words`.
inline ::testing::AssertionResult is_refusal(const std::string& refusal, std::string_view code,
                                             std::initializer_list<std::string_view> words) {
  if (refusal.find(" [" + std::string(code) + "]") == std::string::npos)
    return ::testing::AssertionFailure() << "expected code " << code << ": " << refusal;
  for (const auto word : words)
    if (refusal.find(word) == std::string::npos)
      return ::testing::AssertionFailure() << "\"" << word << "\" is not in: " << refusal;
  return ::testing::AssertionSuccess();
}

}  // namespace clackers::test

/// EXPECT_REFUSED(call, code, words...): `call` must throw clackers::Error with the code, and its
/// message must hold each of the words.
#define EXPECT_REFUSED(call, code, ...)     \
  EXPECT_TRUE(::clackers::test::is_refusal( \
      ::clackers::test::refusal_of([&] { static_cast<void>(call); }), code, {__VA_ARGS__}))
