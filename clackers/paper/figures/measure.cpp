#include "clackers/paper/figures/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "clackers/study/verify.hpp"

namespace clackers::paper {

double largest_difference(const Series& one, const Series& other) {
  if (one.x != other.x || one.y.size() != other.y.size())
    throw std::logic_error("curves of different abscissae");
  double largest = 0.0;
  for (std::size_t i = 0; i < one.y.size(); ++i)
    largest = std::max(largest, std::abs(one.y[i] - other.y[i]));
  return largest;
}

int maxima(const Series& curve, double before) {
  int count = 0;
  for (std::size_t i = 1; i + 1 < curve.x.size() && curve.x[i] < before; ++i)
    count += curve.y[i] > curve.y[i - 1] && curve.y[i] >= curve.y[i + 1];
  return count;
}

Integrated integrate(const std::string& case_name, const cases::Settings& settings, double step) {
  study::VerifyRequest request;
  request.methods = {"rk4"};
  request.case_name = case_name;
  request.settings = settings;
  request.plan = {.coarsest = step, .levels = 1, .neighbours = 1};
  request.jobs = 1;
  const auto record = study::verify(request);
  const auto& score = record.methods.at(0).ladder.at(0).runs.at(0);
  Integrated out{.error = score.u_error, .expected = record.problem.impact_count};
  if (score.impacts) out.found = score.impacts->found;
  return out;
}

std::string words(const Integrated& run, double step) {
  const auto hits = run.expected == 0
                        ? std::string()
                        : fmt::format(", {} of {} collisions", run.found, run.expected);
  return fmt::format("rk4 with located impacts, step {} s: largest error {}{}", step,
                     number(run.error), hits);
}

std::string number(double value) { return fmt::format("{:.3g}", value); }

}  // namespace clackers::paper
