// No step loop allocates: operator new is replaced for this program and counts while it is asked
// to.

#include <cstdlib>
#include <new>

#include "clackers/methods/testing/runs.hpp"

namespace {

thread_local bool is_counting = false;
thread_local long count = 0;

}  // namespace

// Not inlined: GCC would take the free() below for one that does not match this new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (is_counting) ++count;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace clackers::methods {
namespace {

struct CountingSink : model::Sink {
  long long impacts = 0;
  bool take(const model::SampleBlock&) override { return true; }
  bool take(const model::ReportedImpact&) override { return ++impacts, true; }
};

// n masses between n stops, started away from them.
model::ImpactProblem<> masses(int n, double eta, bool has_load) {
  model::ImpactProblem<> p;
  p.system.mass = p.system.stiffness = Eigen::MatrixXd::Identity(n, n);
  p.system.damping = 0.1 * p.system.mass;
  if (has_load) p.system.add_load = [](double t, std::span<double> f) { f[0] += 0.01 * t; };
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  b[0] = 1.0;
  p.contacts = {{b, 0.0, eta}};
  p.start = {0.0, Eigen::VectorXd::Constant(n, 1.0), Eigen::VectorXd::Zero(n)};
  p.end = 20.0;
  return p;
}

TEST(StepLoop, AllocatesNothingForAnyMethodAndSize) {
  for (const auto& name : pairs())
    for (const int n : {1, 2, 5})
      for (const double eta : {1.0, 0.0}) {
        const bool has_load = eta == 0.0 || n == 1;
        const auto problem = masses(n, eta, has_load);
        const auto chosen = method(name);
        if (chosen->objection(problem)) continue;
        // A penalty is a nonlinear force; Newton's iteration of general size may allocate.
        if (n > 2 && name.find("penalty") != std::string::npos) continue;
        // An eigenvalue problem for each set of active contacts; it takes no load.
        if (name == "piecewise-exact") continue;
        const auto prepared = chosen->prepare(problem, runs::resolution_of(*chosen, 0.01));
        CountingSink sink;
        is_counting = true;
        count = 0;
        const auto outcome = prepared->advance(sink);
        is_counting = false;
        EXPECT_EQ(count, 0) << name << ", n = " << n << ", eta = " << eta;
        EXPECT_TRUE(outcome.finished) << outcome.detail;
        EXPECT_GT(sink.impacts, 0) << name;
      }
}

}  // namespace
}  // namespace clackers::methods
