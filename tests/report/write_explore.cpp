// Writes the page of `clackers explore` to the file that is named, and beside it, with the ending .json, states
// of the exact motion at random times of 10,000 random pairs: [X, r, xi1, eta, t, u1, u2, v1, v2, scales of the four].
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>

#include "clackers/cases/case.hpp"
#include "clackers/report/write.hpp"

namespace {

nlohmann::json members() {
  std::mt19937 random(27u);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  auto all = nlohmann::json::array();
  for (int i = 0; i < 10000; ++i) {
    const double X = 2.0 * std::floor(uniform(0.0, 201.0)) + 1.0;
    const double limit = std::min(clackers::cases::admissibility(X, 1.0).r_star, 50.0);
    const double r = uniform(0.01, 0.99) * limit, xi1 = uniform(0.0, 0.5), eta = uniform(0.3, 1.0);
    const double end = uniform(1.0, 200.0), t = uniform(0.0, end);
    const auto pair = clackers::cases::make(
        "synchronized-pair", {{"X", X}, {"r", r}, {"xi1", xi1}, {"eta", eta}, {"t_end", end}});
    double u[2], v[2];
    pair.motion->sample(std::span(&t, 1), clackers::model::Side::right, {u, v, {}});
    const double omega = std::sqrt(1.0 - xi1 * xi1);
    const double size =
        std::exp(-xi1 * t) * std::pow(eta, std::floor(omega * t / std::numbers::pi + 0.5));
    all.push_back({X, r, xi1, eta, t, u[0], u[1], v[0], v[1], size, size * r / X, size, size * r});
  }
  return all;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::string page = arguments[1];
  std::ofstream file(page, std::ios::binary), numbers(page + ".json");
  file << clackers::report::explore({}, {});
  numbers << members();
  file.close();
  numbers.close();
  return file && numbers ? 0 : 4;
}
