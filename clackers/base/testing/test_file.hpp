#pragma once

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "clackers/base/testing/refusal.hpp"

// For tests that read files.
namespace clackers {

/// A file with the given bytes that vanishes at the end of the test.
class TestFile {
 public:
  explicit TestFile(const std::string& bytes) {
    static int count = 0;
    path_ = (std::filesystem::temp_directory_path() /
             ("clackers-test-" + std::to_string(::getpid()) + "-" + std::to_string(++count)))
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

}  // namespace clackers
