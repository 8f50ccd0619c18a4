#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "clackers/study/check.hpp"

namespace clackers::study {

/// Histories in a folder that vanishes at the end of the test.
class Check : public testing::Test {
 protected:
  Check() : folder_(std::filesystem::temp_directory_path() / name()) {
    std::filesystem::create_directories(folder_);
  }
  ~Check() override { std::filesystem::remove_all(folder_); }

  static std::string name() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    return fmt::format("clackers-check-{}-{}", test->name(), std::random_device()());
  }

  // The exact response of the default case with an error in u1 of order 2 in 8 h: t, u1, v1, u2, v2,
  // row by row.
  static std::vector<double> numbers(double h, double factor = 0.0,
                                     const cases::Settings& settings = {}) {
    const auto problem = cases::make(cases::default_case(), settings);
    std::vector<double> numbers;
    for (long long i = 0; double(i) * h <= problem.motion->end(); ++i) {
      const double t = double(i) * h;
      const auto now = problem.motion->at(t, model::Side::right);
      const double error = factor * 64.0 * h * h * std::sin(t);
      numbers.insert(numbers.end(), {t, now.u[0] + error, now.v[0], now.u[1], now.v[1]});
    }
    return numbers;
  }

  static input::NumberColumns columns(const std::string& name, const std::vector<double>& numbers) {
    input::NumberColumns columns{name, numbers.size() / 5, {}};
    for (const auto* letter : {"t", "u1", "v1", "u2", "v2"})
      columns.columns.push_back({letter, numbers.data() + columns.columns.size(), 5});
    return columns;
  }

  std::string write(double h, double factor = 0.0, const std::string& end = "\n") {
    const auto values = numbers(h, factor);
    std::ostringstream text;
    text << "t,u1,v1,u2,v2";
    for (std::size_t i = 0; i < values.size(); i += 5)
      text << fmt::format("\n{},{},{},{},{}", values[i], values[i + 1], values[i + 2],
                          values[i + 3], values[i + 4]);
    const auto path = (folder_ / fmt::format("h{}.csv", h)).string();
    std::ofstream(path) << text.str() << end;
    return path;
  }

  std::filesystem::path folder_;
};

inline bool has(const record::Run& run, std::string_view code) {
  return std::ranges::count(run.file->notes, code, &Note::code) > 0;
}

}  // namespace clackers::study
