#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "clackers/base/error.hpp"

// For tests that read files.
namespace clackers::input {

/// A file with the given bytes that vanishes at the end of the test.
class TestFile {
 public:
  explicit TestFile(const std::string& bytes) {
    static int count = 0;
    path_ = (std::filesystem::temp_directory_path() /
             ("clackers-exchange-" + std::to_string(::getpid()) + "-" + std::to_string(++count)))
                .string();
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TestFile() { std::remove(path_.c_str()); }
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace clackers::input

/// Expects an Error with a code whose message holds a text.
#define EXPECT_REFUSED(statement, expected_code, text)                                    \
  do {                                                                                    \
    try {                                                                                 \
      statement;                                                                          \
      ADD_FAILURE() << "not refused";                                                     \
    } catch (const clackers::Error& error) {                                              \
      EXPECT_EQ(error.code().name(), expected_code) << error.what();                      \
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what(); \
    }                                                                                     \
  } while (false)
