// What a state costs: to make it by a method, to know it exactly, to judge it, and to write it. Each
// beside a peer that does the same work, or less, in the same run. Asserts nothing.
//
//   clackers_benchmark_states [PROGRAM]     PROGRAM: the command clackers, for the rows on writing
#include <fmt/format.h>

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/util/copy.hpp>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/measure.hpp"
#include "benchmarks/naive_pair.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/measure/errors/error_sink.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/numerics/linear_algebra.hpp"
#include "clackers/numerics/testing/forced_target.hpp"

namespace clackers::benchmarks {
namespace {

using exact::SynchronizedPair;
using numerics::simd::ForcedTarget;

struct Row {
  std::string name;
  std::function<void()> work;  ///< once for all states
  std::size_t peer;            ///< row number
  std::vector<double> times;
};

// All take turns; prints the median of each and how many times faster than its peer it is.
void race(const std::string& title, double states, std::vector<Row> rows) {
  std::vector<int> repeats;
  for (const auto& row : rows) repeats.push_back(calibrate(row.work));
  for (int i = 0; i < runs; ++i)
    for (std::size_t j = 0; j < rows.size(); ++j)
      rows[j].times.push_back(time_of(rows[j].work, repeats[j]) / states);
  fmt::print("\n{}\n{:<44} {:>9}  {:>6}  peer\n", title, "", "ns/state", "ratio");
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const double own = median(rows[j].times), peer = median(rows[rows[j].peer].times);
    fmt::print("{:<44} {:>9.2f}", rows[j].name, own);
    if (rows[j].peer != j) fmt::print("  {:>6.2f}  {}", peer / own, rows[rows[j].peer].name);
    fmt::print("\n");
  }
}

// Damping leaves e^-20 at the end: no subnormal number, which takes ten times longer, is met.
void race_sampling(const NaivePair& p, double end) {
  const SynchronizedPair motion({.xi1 = p.xi1, .X = p.X, .t_end = end});
  std::vector<double> times(4096);
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i] = end * std::fmod(0.618033988749895 * double(i), 1.0);
  std::vector<double> grid(times);
  for (std::size_t i = 0; i < grid.size(); ++i) grid[i] = end / double(grid.size()) * double(i);
  std::vector<double> u(2 * times.size()), v(u), a(u);
  const auto sample = [&](const std::vector<double>& at, std::span<double> with_a) {
    motion.sample(at, model::Side::right, {u, v, with_a});
  };
  std::vector<Row> rows{
      {"Eq. (26) in a loop over <cmath>: u, v",
       [&] { naive_sample(p, times.data(), times.size(), u.data(), v.data()); },
       0,
       {}},
      {"one call of Motion::sample a state: u, v",
       [&] {
         for (const double& t : times)
           motion.sample({&t, 1}, model::Side::right, {{&u[0], 2}, {&v[0], 2}, {}});
       },
       0,
       {}}};
  for (const auto& target : numerics::simd::available_targets()) {
    for (const auto& [at, place] : {std::pair{&times, ""}, {&grid, ", equidistant"}})
      for (const auto& [with_a, parts] :
           {std::pair{std::span<double>(), ""}, {std::span(a), ", a"}})
        rows.push_back({fmt::format("Motion::sample on {}{}: u, v{}", target.name(), place, parts),
                        [&, target, at = at, with_a = with_a] {
                          const ForcedTarget forced(target);
                          sample(*at, with_a);
                        },
                        0,
                        {}});
  }
  race(fmt::format("Exact states: X = {}, xi1 = {}, t <= {}", p.X, p.xi1, end),
       double(times.size()), rows);
}

struct ReadingSink : model::Sink {
  double sum = 0.0;
  bool take(const model::SampleBlock& block) override {
    sum += block.u.back() + block.v.back();
    return true;
  }
  bool take(const model::ReportedImpact&) override { return true; }
};

// Boost.odeint's RK4 on (u1, u2, v1, v2)' = (v, -M^-1 C v - M^-1 K u); no impacts.
void integrate_without_impacts(const model::ImpactProblem<>& problem, double h, long steps) {
  using Array = std::array<double, 4>;
  const auto& s = problem.system;
  const Eigen::Matrix2d inverse = numerics::inverse(s.mass), stiffness = s.stiffness,
                        damping = s.damping, k = inverse * stiffness, c = inverse * damping;
  Array x{problem.start.u[0], problem.start.u[1], problem.start.v[0], problem.start.v[1]};
  boost::numeric::odeint::runge_kutta4<Array> stepper;
  const auto rate = [&](const Array& y, Array& d, double) {
    d = {y[2], y[3], -(c(0, 0) * y[2] + c(0, 1) * y[3]) - (k(0, 0) * y[0] + k(0, 1) * y[1]),
         -(c(1, 0) * y[2] + c(1, 1) * y[3]) - (k(1, 0) * y[0] + k(1, 1) * y[1])};
  };
  for (long i = 0; i < steps; ++i) stepper.do_step(std::cref(rate), x, double(i) * h, h);
  if (x[0] == 12345.0) fmt::print(" ");
}

// A chain of n unit masses and springs, every second spring a contact that may close; and RK4 on it as one would
// write it in C.
model::ImpactProblem<> chain(Eigen::Index n, double gap) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::MatrixXd::Identity(n, n);
  p.system.stiffness = 2.0 * p.system.mass;
  for (Eigen::Index i = 1; i < n; ++i)
    p.system.stiffness(i, i - 1) = p.system.stiffness(i - 1, i) = -1.0;
  p.system.damping = 0.01 * p.system.stiffness;
  p.contacts = {model::contact_between(n, 0, 1)};
  p.contacts[0].gap = -gap;
  p.start = {0.0, Eigen::VectorXd::LinSpaced(n, 1.0, 0.0),
             Eigen::VectorXd::LinSpaced(n, 0.0, -1.0)};
  p.end = 50.0;
  return p;
}

void integrate_chain(const model::ImpactProblem<>& problem, double h, long steps) {
  const auto n = std::size_t(problem.dof());
  std::vector<double> u(problem.start.u.begin(), problem.start.u.end()),
      v(problem.start.v.begin(), problem.start.v.end()), x(u), y(v), du(u), dv(v), a(u);
  const auto rate = [&](const std::vector<double>& p, const std::vector<double>& q) {
    for (std::size_t i = 0; i < n; ++i) {
      double u_sum = 2.0 * p[i], v_sum = 2.0 * q[i];
      if (i > 0) u_sum -= p[i - 1], v_sum -= q[i - 1];
      if (i + 1 < n) u_sum -= p[i + 1], v_sum -= q[i + 1];
      a[i] = -u_sum - 0.01 * v_sum;
    }
  };
  for (long k = 0; k < steps; ++k) {
    du.assign(n, 0.0);
    dv.assign(n, 0.0);
    for (int stage = 0; stage < 4; ++stage) {
      rate(stage == 0 ? u : x, stage == 0 ? v : y);
      const double weight = stage == 0 || stage == 3 ? h / 6.0 : h / 3.0,
                   part = stage == 2 ? h : 0.5 * h;
      for (std::size_t i = 0; i < n; ++i) {
        const double speed = stage == 0 ? v[i] : y[i];
        du[i] += weight * speed;
        dv[i] += weight * a[i];
        x[i] = u[i] + part * speed;
        y[i] = v[i] + part * a[i];
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      u[i] += du[i];
      v[i] += dv[i];
    }
  }
  if (u[0] == 12345.0) fmt::print(" ");
}

void race_chains(Eigen::Index n) {
  const auto open = chain(n, 9.0), hits = chain(n, 0.0);
  constexpr long steps = 10000;
  const double h = open.end / double(steps);
  std::vector<Row> rows{
      {"banded RK4 in a loop, no contact", [&] { integrate_chain(open, h, steps); }, 0, {}}};
  const auto add = [&](const std::string& name, const model::ImpactProblem<>& problem,
                       const char* what) {
    const auto run = std::shared_ptr(methods::method(name)->prepare(problem, h));
    rows.push_back({name + what,
                    [run] {
                      ReadingSink sink;
                      run->advance(sink);
                    },
                    0,
                    {}});
  };
  for (const std::string name : {"rk4", "newmark", "generalized-alpha", "newmark+penalty"}) {
    add(name, open, ", gaps open");
    add(name, hits, ", impacts");
  }
  race(fmt::format("A step of a chain of {} masses", n), double(steps), rows);
}

void race_runs() {
  const SynchronizedPair motion({.t_end = 200.0});
  const auto problem = motion.problem();
  constexpr long steps = 200000;
  const double h = motion.end() / double(steps);
  measure::SharedStates shared(std::make_shared<const SynchronizedPair>(motion), problem.start.t);
  const auto* states = shared.of(h, steps);
  std::vector<Row> rows{{"one RK4 step of Boost.odeint, no impacts",
                         [&] { integrate_without_impacts(problem, h, steps); },
                         0,
                         {}}};
  for (const std::string name : {"rk4", "newmark", "generalized-alpha:rho=0.8", "bathe",
                                 "radau-iia-5", "exponential", "newmark+penalty"}) {
    const auto run = std::shared_ptr(methods::method(name)->prepare(problem, h));
    rows.push_back({"one step of " + name + ", impacts located",
                    [run] {
                      ReadingSink sink;
                      run->advance(sink);
                    },
                    0,
                    {}});
    rows.push_back({"the same, every state assessed",
                    [&, run] {
                      measure::ErrorSink sink(motion, problem, h, {.steps = steps});
                      run->advance(sink);
                    },
                    rows.size() - 1,
                    {}});
    rows.push_back({"the same beside shared states of the reference",
                    [&, run] {
                      measure::ErrorSink sink(motion, problem, h, {.states = states});
                      run->advance(sink);
                    },
                    rows.size() - 2,
                    {}});
  }
  race("Making states and assessing them: default pair, 200 000 steps", double(steps), rows);
}

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Rows of t, side and six numbers, as the command writes them, against fmt's loop over numbers that
// are there already and against a plain write of as many bytes.
void write_rows(const std::string& program) {
  namespace fs = std::filesystem;
  constexpr int samples = 1000000;
  const auto folder = fs::temp_directory_path();
  const auto file = [&](const char* name) { return (folder / name).string(); };
  const auto print = [](const char* name, double seconds, const std::string& path) {
    const double bytes = double(fs::file_size(path));
    fmt::print("{:<44} {:>9.2f}  {:>6.0f} MB/s  {:.2f} million rows/s\n", name, seconds,
               bytes / seconds * 1e-6, samples / seconds * 1e-6);
  };
  const auto respond = [&](const std::string& format) {
    return [&, format] {
      const auto command =
          fmt::format("'{}' respond three-parameter --samples {} --format {} --out '{}'", program,
                      samples, format, file(("clackers_benchmark." + format).c_str()));
      if (std::system(command.c_str()) != 0) fmt::print("failed: {}\n", command);
    };
  };
  fmt::print("\nWriting a million states (t, side, u, v, a of two masses)\n{:<44} {:>9}\n", "",
             "seconds");
  const SynchronizedPair motion({});
  const auto csv = file("clackers_benchmark.fmt");
  const double loop = seconds_of([&] {
    std::ofstream out(csv, std::ios::binary);
    fmt::memory_buffer buffer;
    double x[6];
    for (int i = 0; i < samples; ++i) {
      const double t = motion.end() * i / (samples - 1);
      if (i % 64 == 0) motion.sample({&t, 1}, model::Side::right, {{x, 2}, {x + 2, 2}, {x + 4, 2}});
      fmt::format_to(std::back_inserter(buffer), "{},,{},{},{},{},{},{}\n", t, x[0] + t, x[1] + t,
                     x[2] + t, x[3] + t, x[4] + t, x[5] + t);
      if (buffer.size() > 60000) {
        out.write(buffer.data(), std::streamsize(buffer.size()));
        buffer.clear();
      }
    }
    out.write(buffer.data(), std::streamsize(buffer.size()));
  });
  print("fmt's loop over given numbers", loop, csv);
  const double as_csv = seconds_of(respond("csv"));
  print("respond --format csv", as_csv, file("clackers_benchmark.csv"));
  const double as_npy = seconds_of(respond("npy"));
  if (fs::exists(file("clackers_benchmark.npy"))) {
    const auto npy = file("clackers_benchmark.npy");
    print("respond --format npy", as_npy, npy);
    const std::vector<char> bytes(fs::file_size(npy), 'x');
    const auto raw = file("clackers_benchmark.raw");
    const double disk = seconds_of([&] {
      std::ofstream(raw, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
    });
    print("as many bytes in one write", disk, raw);
  }
  for (const char* ending : {"fmt", "csv", "npy", "raw"})
    fs::remove(file((std::string("clackers_benchmark.") + ending).c_str()));
}

}  // namespace
}  // namespace clackers::benchmarks

int main(int argc, char** argv) {
  using namespace clackers::benchmarks;
  fmt::print("{}, {}\nmedian of {} alternated runs; processor time\n", processor(), compiler(),
             runs);
  race_sampling({0.05, 81.0}, 400.0);
  race_sampling({2e-5, 400001.0}, 1e6);
  race_runs();
  race_chains(10);
  race_chains(100);
  if (argc > 1) write_rows(argv[1]);
}
