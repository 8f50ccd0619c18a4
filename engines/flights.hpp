// What programs share whose library locates events: y = (u, v), the equation of motion, the impact, rows.
//     PROGRAM PROBLEM.txt TOLERANCE HISTORY.csv [NAME=VALUE ...]
#pragma once

#include "door.hpp"

struct Flights : Door {
  static constexpr long rows = 2000;
  std::ofstream file;
  std::clock_t before = std::clock();
  long evaluations = 0;

  Flights(int count, char** words) : Door(count, words), file(out) {
    file.precision(17);
    file << 't';
    for (const char* name : {"u", "v"})
      for (std::size_t i = 1; i <= masses; ++i) file << ',' << name << i;
  }
  std::size_t size() const { return 2 * masses; }
  double tolerance() const { return given; }
  Row first() {
    Row y = problem["u"];
    y.insert(y.end(), problem["v"].begin(), problem["v"].end());
    return y;
  }
  /// The time of output row k.
  double at(long k) const {
    return k == rows ? end : start + (end - start) * double(k) / double(rows);
  }
  void derivative(const double* y, double* out) {
    ++evaluations;
    for (std::size_t i = 0; i < masses; ++i) {
      const auto& k = row("K", i + 1);
      const auto& c = row("C", i + 1);
      double sum = 0.0;
      for (std::size_t j = 0; j < masses; ++j) sum -= k[j] * y[j] + c[j] * y[masses + j];
      out[i] = y[masses + i];
      out[masses + i] = sum / row("M", i + 1)[i];
    }
  }
  double rate(std::size_t k, const double* y) {
    double sum = 0.0;
    for (std::size_t i = 0; i < masses; ++i) sum += row("direction", k)[i] * y[masses + i];
    return sum;
  }
  /// The first contact (from 1) that is open no more and closes; 0: none.
  std::size_t closed(const double* y, double slack = 0.0) {
    for (std::size_t k = 1; k <= contacts; ++k)
      if (gap(k, y) < slack && rate(k, y) < 0.0) return k;
    return 0;
  }
  /// Impact of contact k, with a row before and one behind.
  void impact(std::size_t k, double t, double* y) {
    write(t, y);
    double mass = 0.0;
    const auto& direction = row("direction", k);
    for (std::size_t i = 0; i < masses; ++i)
      mass += direction[i] * direction[i] / row("M", i + 1)[i];
    const double impulse = -(1.0 + row("restitution", k)[0]) * rate(k, y) / mass;
    for (std::size_t i = 0; i < masses; ++i)
      y[masses + i] += impulse * direction[i] / row("M", i + 1)[i];
    write(t, y);
  }
  void write(double t, const double* y) {
    file << '\n' << t;
    for (std::size_t i = 0; i < size(); ++i) file << ',' << y[i];
  }
  int close() {
    file << "\n# seconds " << double(std::clock() - before) / CLOCKS_PER_SEC << " evaluations "
         << evaluations << '\n';
    return file.flush() ? 0 : 1;
  }
};
