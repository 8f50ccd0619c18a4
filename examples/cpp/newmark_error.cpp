// How far Newmark's method is from the exact motion of a colliding pair, at several steps.
#include <clackers/base/error.hpp>
#include <clackers/cases/case.hpp>
#include <clackers/methods/registry.hpp>
#include <clackers/model/sink.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

// Compares every state of a run with the reference while it happens; stores nothing.
class LargestError : public clackers::model::Sink {
 public:
  explicit LargestError(const clackers::model::Motion& reference) : reference_(reference) {}

  bool take(const clackers::model::SampleBlock& block) override {
    for (std::size_t i = 0; i < block.t.size(); ++i) {
      const auto exact = reference_.at(block.t[i], clackers::model::Side::left);
      const auto u1 = block.u[i * static_cast<std::size_t>(block.dof)];
      largest_ = std::max(largest_, std::abs(u1 - exact.u[0]));
    }
    return true;
  }
  bool take(const clackers::model::ReportedImpact&) override { return true; }

  double largest() const { return largest_; }

 private:
  const clackers::model::Motion& reference_;
  double largest_ = 0.0;
};

}  // namespace

int main() try {
  const auto test_case = clackers::cases::make("three-parameter", {{"N", 1.0}, {"xi1", 0.05}});
  const auto newmark = clackers::methods::method("newmark:beta=0.25");
  for (const double steps : {1000.0, 2000.0, 4000.0}) {
    const double h = test_case.problem.end / steps;
    LargestError error(*test_case.motion);
    const auto outcome = newmark->prepare(test_case.problem, h)->advance(error);
    if (outcome.failed()) {
      std::fprintf(stderr, "h = %g s: %s\n", h, outcome.detail.c_str());
      return 1;
    }
    std::printf("h = %.4f s  largest error of u1 = %.2e m\n", h, error.largest());
  }
  return 0;
} catch (const clackers::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
