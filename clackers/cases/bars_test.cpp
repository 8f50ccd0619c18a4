#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/cases/testing/characteristics.hpp"
#include "clackers/cases/testing/constants.hpp"
#include "clackers/exact/bodies/bar_contact.hpp"
#include "clackers/exact/testing/taylor_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::cases {
namespace {

using exact::testing_oracle::Box;
using exact::testing_oracle::trials;
using model::Side;

// How long the mesh of a bar with tau = 1 touches the wall, in its first contact.
double contact_time(const Case& mesh) {
  const auto& motion = *mesh.motion;
  if (!mesh.problem.contacts.empty()) {
    const auto closed = motion.closed_contacts().at(0);
    return closed.until - closed.from;
  }
  // The node beside the massless one has the gap of the contact.
  const double gap = constant(mesh, "gap"), begin = constant(mesh, "t_closes1");
  const auto depth = [&](double t) { return motion.at(t, Side::right).u[0] + gap; };
  double inside = begin + 0.5, outside = inside;
  while (depth(outside) < 0.0) outside += 0.01;
  for (inside = outside - 0.01; outside - inside > 1e-13;) {
    const double middle = 0.5 * (inside + outside);
    (depth(middle) < 0.0 ? inside : outside) = middle;
  }
  return inside - begin;
}

// Mass and stiffness of line elements. What a contact node without mass has is its neighbour's mass, and no
// stiffness: the spring of its contact stands for its element.
void assemble(const model::Mesh& mesh, Eigen::MatrixXd& mass, Eigen::MatrixXd& stiffness) {
  for (const auto& element : mesh.elements) {
    const auto& a = mesh.nodes.at(element.left);
    const auto& b = mesh.nodes.at(element.right);
    const double h = b.x - a.x, m = element.density * h, k = element.stiffness / h;
    EXPECT_EQ(a.body, b.body);
    EXPECT_GT(h, 0.0);
    const bool is_whole = (a.dof || a.is_fixed) && (b.dof || b.is_fixed),
               is_spread = mesh.mass == model::NodeMass::consistent;
    for (const auto* node : {&a, &b}) {
      if (!node->dof) continue;
      mass(*node->dof, *node->dof) += is_spread ? m / 3.0 : is_whole ? m / 2.0 : m;
      if (is_whole) stiffness(*node->dof, *node->dof) += k;
    }
    if (!a.dof || !b.dof) continue;
    for (const auto& [i, j] : {std::pair{*a.dof, *b.dof}, {*b.dof, *a.dof}}) {
      if (is_spread) mass(i, j) += m / 6.0;
      stiffness(i, j) -= k;
    }
  }
}

Case bar_at_wall(double elements, const char* mass, double eta = 0.0) {
  return make("bar-wall", {{"elements", elements}, {"mass", mass}, {"eta", eta}});
}

TEST(BarCases, MeshesLeaveTheWallWhenTheirModesDo) {
  struct Row {
    double n, massless, lumped, consistent;
  };
  for (const auto& row : {Row{2, 2.33102849323, 2.09858458239, 1.84115498302},
                          Row{4, 2.18866586781, 2.08314169926, 1.87725737289},
                          Row{8, 2.10267652947, 2.05476486111, 1.93837476640},
                          Row{16, 2.05766864381, 2.03702511913, 1.95633866955}}) {
    EXPECT_NEAR(contact_time(bar_at_wall(row.n, "massless")), row.massless, 1e-11) << row.n;
    EXPECT_NEAR(contact_time(bar_at_wall(row.n, "lumped")), row.lumped, 1e-11) << row.n;
    EXPECT_NEAR(contact_time(bar_at_wall(row.n, "consistent")), row.consistent, 1e-11) << row.n;
  }
}

// A uniform mesh whose contact node is held has the modes sin(i (2k - 1) pi/(2 n)); a plastic impact
// leaves the velocities that are orthogonal to it.
struct HeldModes {
  int n;
  bool consistent;
  std::vector<double> omega, share;  // of each mode
  HeldModes(int elements, bool spread) : n(elements), consistent(spread) {
    for (int k = 1; k <= n; ++k) {
      const double th = (2 * k - 1) * std::numbers::pi / (2 * n);
      omega.push_back(2 * n * std::sin(th / 2) *
                      (consistent ? std::sqrt(3.0 / (2.0 + std::cos(th))) : 1.0));
      double norm = 0.0, load = 0.0;
      for (int i = 1; i <= n; ++i) {
        const double phi = std::sin(i * th), end = i == n ? 0.5 : 1.0;
        load += end * phi;
        norm += (consistent ? 2.0 / 3.0 : 1.0) * end * phi * phi;
        if (consistent && i < n) norm += phi * std::sin((i + 1) * th) / 3.0;
      }
      share.push_back(load / norm);
    }
  }
  double mode(int k, int i) const { return std::sin(i * (2 * k + 1) * std::numbers::pi / (2 * n)); }
  double u(int i, double s) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < omega.size(); ++k)
      sum -= share[k] * mode(int(k), i) * std::sin(omega[k] * s) / omega[k];
    return sum;
  }
  double force(double s) const {
    double a = 0.0;
    for (std::size_t k = 0; k < omega.size(); ++k)
      a += share[k] * mode(int(k), 1) * std::sin(omega[k] * s) * omega[k];
    return -n * u(1, s) + (consistent ? a / (6.0 * n) : 0.0);
  }
};

TEST(BarCases, MeshesMoveAsTheirClosedModes) {
  Box box(91);
  for (int trial = 0; trial < trials(6); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 91, trial " << trial);
    const int n = trial == 0 ? 150 : trial == 1 ? 1500 : int(box.uniform(2.0, 17.0));
    const bool consistent = box.one_in(2);
    const HeldModes modes(n, consistent);
    const double V = box.decades(-1.0, 1.0), L = box.decades(-1.0, 1.0), E = box.decades(-1.0, 1.0),
                 rho = box.decades(-1.0, 1.0), A = box.decades(-1.0, 1.0),
                 tau = L * std::sqrt(rho / E), d = V * tau * box.uniform(0.01, 1.0);
    const auto mesh = make("bar-wall", {{"V", V},
                                        {"L", L},
                                        {"E", E},
                                        {"rho", rho},
                                        {"A", A},
                                        {"d", d},
                                        {"elements", n},
                                        {"mass", consistent ? "consistent" : "lumped"},
                                        {"t_end", d / V + 3.0 * tau}});
    const auto closed = mesh.motion->closed_contacts().at(0);
    EXPECT_NEAR(closed.from, d / V, 1e-13 * (d / V + tau));
    EXPECT_NEAR(modes.force((closed.until - closed.from) / tau), 0.0, 1e-9);
    EXPECT_GT(closed.until - closed.from, 1.8 * tau);
    for (int i = 0; i < 8; ++i) {
      const double s = box.uniform(0.02, 1.8), t = d / V + s * tau;
      EXPECT_GT(modes.force(s), -1e-9);
      const auto state = mesh.motion->at(t, Side::right), bound = mesh.motion->error_bound(t);
      EXPECT_LT(bound.u.maxCoeff(), (n > 8 ? 1e-15 * (n + 30.0) : 1e-9) * (d + V * tau));
      for (int node = 1; node <= n; ++node)
        EXPECT_NEAR(state.u[node], -d + V * tau * modes.u(node, s),
                    bound.u[node] + 1e-13 * (d + V * tau));
      EXPECT_NEAR(mesh.motion->contact_forces(t, Side::right)[0],
                  modes.force(s) * A * std::sqrt(E * rho) * V,
                  1e-10 * n * A * std::sqrt(E * rho) * V);
    }
  }
}

// The motion of a mesh with mass on its contact nodes against series with 90 digits that know no modes, up to `end`.
struct Shares {
  double worst = 0.0, largest_bound = 0.0;
  int unsimulated = 0;

  void compare(const Case& mesh, double end) {
    exact::testing_oracle::TaylorSimulator simulator(mesh.problem);
    for (int k = 1; k <= 12; ++k) {
      const double t = k * end / 12.0;
      try {
        while (simulator.next(t)) {
        }
      } catch (const std::logic_error&) {
        ++unsimulated;
        return;
      }
      const auto known = simulator.at(t);
      const auto now = mesh.motion->at(t, Side::right), bound = mesh.motion->error_bound(t);
      largest_bound = std::max(largest_bound, bound.u.maxCoeff());
      const auto share = [&](const auto& is, double found, double allowed) {
        worst = std::max(worst, double(abs(is - found)) / (allowed + 1e-40));
      };
      for (Eigen::Index i = 0; i < mesh.problem.dof(); ++i) {
        share(known.u[i], now.u[i], bound.u[i]);
        share(known.v[i], now.v[i], bound.v[i]);
      }
      EXPECT_LE(worst, 1.0) << t;
    }
  }
};

TEST(BarCases, MeshesMoveAsTheTaylorSeriesSays) {
  Box box(92);
  int members = 0;
  Shares plastic, elastic;
  for (int trial = 0; trial < trials(5); ++trial) {
    const std::string name = std::array{"bar-wall", "bouncing-bar", "two-bars", "mass-on-bar",
                                        "bar-between-stops"}[std::size_t(trial) % 5];
    const double n = std::floor(box.uniform(2.0, 11.0));
    const double eta = box.one_in(2) ? 0.0 : box.one_in(2) ? 1.0 : box.uniform(0.0, 1.0);
    Settings settings{
        {"elements", n}, {"eta", eta}, {"mass", box.one_in(2) ? "consistent" : "lumped"}};
    // No number is whole, so that the mesh's matrices are rounded.
    for (const auto& parameter : entry(name).parameters)
      if (parameter.name[0] == 'E' || parameter.name[0] == 'A' || parameter.name.starts_with("rho"))
        settings.emplace_back(parameter.name, box.uniform(0.8, 1.25));
    SCOPED_TRACE(testing::Message() << "seed 92, trial " << trial);
    Case mesh;
    if (test::refusal_of([&] { mesh = make(name, settings); }) != "accepted") continue;
    ++members;
    (eta == 0.0 ? plastic : elastic).compare(mesh, std::min(6.0, mesh.motion->end()));
  }
  EXPECT_GT(members, trials(5) / 2);
  // An elastic contact node makes errors grow by each of its many impacts.
  EXPECT_LT(plastic.largest_bound, 1e-6);
  RecordProperty("members", members);
  RecordProperty("unsimulated", plastic.unsimulated + elastic.unsimulated);
  RecordProperty("worst", std::to_string(std::max(plastic.worst, elastic.worst)));
}

// Contacts that open by their acceleration or their jerk, which the modes of a mesh change fast: the first by less
// than the error, and it closes again.
TEST(BarCases, ContactsThatOpenSlowlyAreFollowed) {
  struct Member {
    const char* name;
    Settings settings;
    double end;
  };
  for (const auto& [name, settings, end] :
       {Member{"bouncing-bar", {{"elements", 16.0}, {"mass", "consistent"}}, 12.0},
        Member{"two-bars", {{"elements", 9.0}, {"mass", "consistent"}, {"L2", 2.5}}, 6.0},
        Member{"two-bars", {{"elements", 32.0}, {"mass", "consistent"}}, 2.6}}) {
    SCOPED_TRACE(name);
    Shares shares;
    shares.compare(make(name, settings), end);
    EXPECT_EQ(shares.unsimulated, 0);
    EXPECT_LT(shares.largest_bound, 1e-8);
  }
}

// Taylor series of 34 terms of this chain, in steps of 1/omega with 113 bits and impacts by halving, gave these numbers.
TEST(BarCases, ElasticContactNodesChatterAsTheTaylorSeriesSays) {
  struct Impact {
    long long number;
    double t, v;
  };
  struct Mesh {
    const char* mass;
    long long impacts;
    std::vector<Impact> some;
    std::array<double, 3> u;  // of node 0, 32, 64 at t = 16
  };
  for (const auto& [mass, impacts, some, u] :
       {Mesh{"lumped",
             254,
             {{100, 4.77678865901464535952, -0.601415493175317},
              {254, 13.0093925325803377930, -0.18926350729735}},
             {-0.0200888744583928197, -0.0201678921358711777, -0.0163592071740183030}},
        Mesh{"consistent",
             469,
             {{100, 4.08612499424547323905, -0.567893902086263},
              {235, 11.1524343318934647245, -0.437927412251898},
              {469, 12.9154831141106411946, -0.235106109005015}},
             {-0.0389152967036109511, -0.0358776109202076990, -0.0601382212392010285}}}) {
    SCOPED_TRACE(mass);
    const auto mesh = make("bouncing-bar", {{"elements", 64.0}, {"mass", mass}, {"eta", 1.0}});
    EXPECT_EQ(mesh.motion->impact_count(16.0), impacts);
    for (const auto& [number, t, v] : some) {
      const auto hit = mesh.motion->impact(number);
      EXPECT_NEAR(hit.t, t, 4e-15);
      EXPECT_NEAR(hit.before.v[0], v, 1e-13);
      EXPECT_NEAR(hit.energy_after, hit.energy_before, 1e-14);
    }
    const auto state = mesh.motion->at(16.0, Side::right), bound = mesh.motion->error_bound(16.0);
    EXPECT_LT(bound.u.maxCoeff(), 1e-12);
    for (Eigen::Index i = 0; i < 3; ++i)
      EXPECT_NEAR(state.u[32 * i], u[std::size_t(i)], std::min(1e-14, bound.u[32 * i]));
  }
}

// The order of a second-order dispersion of kinks.
TEST(BarCases, FineMeshesTendToTheBarWithOrderTwoThirds) {
  for (const auto* mass : {"lumped", "consistent"}) {
    const auto error = [&](double n) {
      const auto mesh = make("bouncing-bar", {{"elements", n}, {"mass", mass}});
      EXPECT_LT(constant(mesh, "error_bound"), 1e-15 * n);
      return constant(mesh, "e_space");
    };
    EXPECT_NEAR(std::log2(error(32.0) / error(512.0)) / 4.0, 2.0 / 3.0, 0.1) << mass;
  }
}

TEST(BarCases, MatricesAreThoseOfTheElements) {
  for (const std::string name : {"bar-wall", "bouncing-bar", "two-bars", "mass-on-bar",
                                 "bar-between-stops", "string-over-point", "string-on-obstacle"})
    for (const char* kind : {"lumped", "consistent", "massless"}) {
      const bool has_kinds = name != "string-on-obstacle";
      if (!has_kinds && kind != std::string("lumped")) continue;
      Settings settings{{"elements", 5.0}, {"t_end", 1.0}};
      if (has_kinds) settings.emplace_back("mass", kind);
      for (const auto& parameter : entry(name).parameters)
        for (const auto& [letter, value] :
             {std::pair{"E", 4.0}, {"rho", 1.5}, {"A", 1.25}, {"T", 2.0}})
          if (parameter.name.starts_with(letter)) settings.emplace_back(parameter.name, value);
      SCOPED_TRACE(name + " " + kind);
      const auto made = make_mesh(name, settings);
      ASSERT_TRUE(made.mesh);
      const auto& system = made.problem.system;
      Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(system.dof(), system.dof()), stiffness = mass;
      if (name == "mass-on-bar") mass(0, 0) = system.mass(0, 0);
      assemble(*made.mesh, mass, stiffness);
      EXPECT_LE((mass - system.mass).cwiseAbs().maxCoeff(), 1e-14 * mass.maxCoeff());
      EXPECT_LE((stiffness - system.stiffness).cwiseAbs().maxCoeff(), 1e-14 * stiffness.maxCoeff());
      std::vector<Eigen::Index> places;
      for (const auto& node : made.mesh->nodes_with_dof()) places.push_back(*node.dof);
      EXPECT_EQ(std::ssize(places), system.dof() - Eigen::Index(name == "mass-on-bar"));
      EXPECT_EQ(std::ranges::adjacent_find(places, std::greater_equal{}), places.end());
      // The contact of the first body with what is left of it, and of the last with what is right.
      const auto& nodes = made.mesh->nodes;
      for (std::size_t i = 1; i < nodes.size(); ++i)
        EXPECT_TRUE(nodes[i].body > nodes[i - 1].body || nodes[i].x > nodes[i - 1].x);
      EXPECT_EQ(std::ranges::count_if(nodes, [](const auto& node) { return node.x == 0.0; }),
                name == "two-bars" ? 2 : 1);
    }
}

TEST(BarCases, MeshesTendToTheBar) {
  for (const auto* name :
       {"bar-wall", "bouncing-bar", "two-bars", "mass-on-bar", "bar-between-stops"})
    for (const auto* mass : {"massless", "lumped", "consistent"}) {
      double before = HUGE_VAL;
      const bool is_struck = *name == 'm';
      for (const double n : {is_struck ? 8.0 : 4.0, is_struck ? 16.0 : 8.0}) {
        const auto mesh = make(name, {{"elements", n}, {"mass", mass}, {"t_end", 6.0}});
        EXPECT_LT(constant(mesh, "e_space"), 0.75 * before) << name << " " << mass;
        before = constant(mesh, "e_space");
        // All of the mass, and none of the weight lost.
        const auto& s = mesh.problem.system;
        if (*name != 'm') {
          EXPECT_NEAR(s.mass.sum(), *name == 't' ? 3.0 : 1.0, 1e-14);
          EXPECT_NEAR((s.stiffness * Eigen::VectorXd::Ones(s.stiffness.rows())).norm(), 0.0, 1e-12);
        }
        if (*name == 'b' && name[1] == 'o') {
          Eigen::VectorXd force = Eigen::VectorXd::Zero(s.mass.rows());
          s.add_load(0.0, {force.data(), std::size_t(force.size())});
          EXPECT_NEAR(force.sum(), -0.125, 1e-15);
        }
      }
      EXPECT_LT(before, 0.45);
    }
}

// The delay equation of mass and bar by the method of steps: Runge-Kutta's method of fourth order between
// multiples of 2 tau, with a(t) out of a table.
struct DelayedMass {
  int parts;  // of 2 tau
  double kappa, back;
  std::vector<double> v, a;  // at the ends and middles of parts, from the beginning of contact on
  double end = 0.0;          // of the contact, where it is over [2 tau/parts]

  DelayedMass(int n, double mu, double sign) : parts(n), kappa(2.0 * mu / n), back(sign) {
    v.push_back(1.0);
    a.push_back(0.0);
    for (std::size_t i = 0; end == 0.0; i += 2) {
      const auto arriving = [&](std::size_t k) {
        if (k < 2 * std::size_t(parts)) return 0.0;
        const auto before = k - 2 * std::size_t(parts);
        return back * (2.0 * v[before] - a[before]);
      };
      // At a multiple of 2 tau what arrives jumps.
      const double a0 = arriving(i), a1 = arriving(i + 1);
      const bool is_last = (i + 2) % (2 * std::size_t(parts)) == 0;
      const double a2 = is_last && i + 2 == 2 * std::size_t(parts) ? 0.0 : left_limit(i + 2);
      const auto rate = [&](double x, double arrives) { return -kappa * (x - arrives); };
      const auto step = [&](double h, double from, double b0, double b1, double b2) {
        const double k1 = rate(from, b0), k2 = rate(from + h / 2 * k1, b1),
                     k3 = rate(from + h / 2 * k2, b1), k4 = rate(from + h * k3, b2);
        return from + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      };
      a.back() = a0;
      if (!(v[i] - a0 > 0.0)) {
        end = double(i) / 2.0;
        break;
      }
      const double quarter = 0.375 * a0 + 0.75 * a1 - 0.125 * a2,
                   later = -0.125 * a0 + 0.75 * a1 + 0.375 * a2;
      const double middle = step(0.5, v[i], a0, quarter, a1),
                   next = step(0.5, middle, a1, later, a2);
      if (next - a2 <= 0.0) {
        const double f0 = v[i] - a0, f1 = middle - a1, f2 = next - a2;
        // Where the parabola through three forces is 0.
        const double b = -3 * f0 + 4 * f1 - f2, c = 2 * (f0 - 2 * f1 + f2);
        end = double(i) / 2.0 + 2 * f0 / (-b + std::sqrt(b * b - 4 * c * f0));
        v.push_back(middle), v.push_back(next);
        break;
      }
      v.push_back(middle), v.push_back(next);
      a.push_back(a1), a.push_back(a2);
    }
  }
  double left_limit(std::size_t k) const {
    if (k < 2 * std::size_t(parts)) return 0.0;
    const auto before = k - 2 * std::size_t(parts);
    // The value of a is that after a jump; before one it is what arrived two transits earlier.
    const double a_left =
        before > 0 && before % (2 * std::size_t(parts)) == 0 ? left_limit(before) : a[before];
    return before == 0 ? 0.0 : back * (2.0 * v[before] - a_left);
  }
};

TEST(BarCases, AMassLeavesItsBarWhenTheDelayEquationSaysSo) {
  struct Row {
    double ratio, end, rebound;
  };
  for (const auto& [ratio, end, rebound] :
       {Row{1.0, 3.06766764162, NAN}, Row{0.5, 4.7085672436677, -0.925246996732},
        Row{0.25, 5.8995904396033, -0.816911551636}, Row{0.1, 9.5410579038384, -0.949134061418}}) {
    const auto mesh = make("mass-on-bar", {{"M", 1.0 / ratio}, {"t_end", end + 0.26}});
    EXPECT_NEAR(constant(mesh, "t_opens1") - constant(mesh, "t_closes1"), end, 1e-11);
    if (rebound < 0.0) {
      EXPECT_NEAR(constant(mesh, "v_after"), rebound, 1e-11);
    }
  }
  Box box(92);
  for (int trial = 0; trial < trials(6); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 92, trial " << trial);
    const bool fixed = !box.one_in(4);
    const double V = box.decades(-1.0, 1.0), L = box.decades(-1.0, 1.0), E = box.decades(-1.0, 1.0),
                 rho = box.decades(-1.0, 1.0), A = box.decades(-1.0, 1.0), m = rho * A * L,
                 mu = box.decades(-1.0, 1.0), tau = L * std::sqrt(rho / E), d = V * tau * 0.3;
    const DelayedMass known(400, mu, fixed ? -1.0 : 1.0);
    const auto mesh =
        make("mass-on-bar", {{"V", V},
                             {"L", L},
                             {"E", E},
                             {"rho", rho},
                             {"A", A},
                             {"M", m / mu},
                             {"d", d},
                             {"elements", 3.0},
                             {"far", fixed ? "fixed" : "free"},
                             {"t_end", d / V + tau * known.end / 200.0 + 0.01 * tau}});
    EXPECT_NEAR((constant(mesh, "t_opens1") - d / V) / tau, known.end / 200.0, 1e-6);
    EXPECT_NEAR(constant(mesh, "v_after"), V * known.v.back(), 1e-2 * V);
    for (int i = 0; i < 8; ++i) {
      const double part = box.uniform(0.0, 1.0) * known.end;
      const auto k = std::size_t(part);
      if (k % 400 == 0) continue;  // what arrives jumps
      const double s = double(k) / 200.0 * tau;
      const auto now = mesh.bars->at(0, 0.0, d / V + s, Side::right);
      EXPECT_NEAR(now.v.nearest(), V * known.v[2 * k], 3e-8 * V);
      EXPECT_NEAR(mesh.bars->force(d / V + s, Side::right).nearest(),
                  A * std::sqrt(E * rho) * V * (known.v[2 * k] - known.a[2 * k]),
                  3e-7 * A * std::sqrt(E * rho) * V);
    }
    // Energy and momentum of a bar whose end is free, or energy alone.
    const double energy = 0.5 * m / mu * V * V;
    for (int i = 0; i < 3; ++i) {
      const auto now = mesh.bars->energy(box.uniform(0.0, mesh.bars->end()));
      EXPECT_NEAR(now.kinetic.nearest() + now.elastic.nearest(), energy, 1e-13 * energy);
    }
  }
}

// Far end, characteristics, law of contact, Newton's law and energy, which together have one solution.
TEST(BarCases, AMassThatIsStruckAgainKeepsTheLaws) {
  Box box(94);
  int again = 0;
  for (int trial = 0; trial < trials(12); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 94, trial " << trial);
    const double V = box.decades(-1.0, 1.0), L = box.decades(-1.0, 1.0), E = box.decades(-1.0, 1.0),
                 rho = box.decades(-1.0, 1.0), A = box.decades(-1.0, 1.0),
                 tau = L * std::sqrt(rho / E), z = A * std::sqrt(E * rho),
                 ratio = trial == 0   ? 1.72833  // the front comes 3e-6 tau after the release
                         : trial == 1 ? 0.01
                                      : box.decades(-1.9, 1.9),
                 M = ratio * z * tau, back = trial % 6 == 5 ? 1.0 : -1.0,
                 end = (0.3 + 3.5 * std::sqrt(ratio) + 6.0) * tau;
    const auto made = make_mesh("mass-on-bar", {{"V", V},
                                                {"L", L},
                                                {"E", E},
                                                {"rho", rho},
                                                {"A", A},
                                                {"M", M},
                                                {"d", 0.3 * V * tau},
                                                {"elements", 2.0},
                                                {"far", back < 0.0 ? "fixed" : "free"},
                                                {"t_end", end}});
    const auto& bar = *made.bars;
    const auto changes = bar.contact_changes(100);
    ASSERT_EQ(changes.size() % 2, 0u);
    again += changes.size() > 2 ? 1 : 0;
    const auto wave = [&](double t, double sign) {
      const auto x = bar.at(0, 0.0, t, Side::right);
      return x.v.nearest() + sign * x.stress.nearest() / std::sqrt(E * rho);
    };
    const auto speed = [&](double t) { return V - bar.impulse(t, Side::right).nearest() / M; };
    const auto moved = [&](double t) { return bar.at(0, 0.0, t, Side::right).u.nearest(); };
    for (std::size_t k = 0; k < changes.size(); k += 2) {
      const double closes = changes[k], opens = changes[k + 1],
                   next = k + 2 < changes.size() ? changes[k + 2] : end;
      const auto gap = [&](double t) {
        return moved(t) - moved(opens) - speed(next) * (t - opens);
      };
      for (int i = 0; i < 12; ++i) {
        const double inside = box.uniform(closes, opens), outside = box.uniform(opens, next);
        const double R = bar.force(inside, Side::right).nearest();
        EXPECT_GT(R, 0.0);
        EXPECT_NEAR(R, 0.5 * z * (wave(inside, -1.0) - wave(inside, 1.0)), 1e-14 * z * V);
        EXPECT_NEAR(speed(inside), bar.at(0, 0.0, inside, Side::right).v.nearest(), 1e-12 * V);
        const double h = 1e-5 * std::min({M / z, inside - closes, opens - inside});
        EXPECT_NEAR(M * (speed(inside + h) - speed(inside - h)), -2.0 * h * R,
                    1e-8 * h * z * V + 1e-15 * (1.0 + ratio) * M * V);
        EXPECT_GE(gap(outside), -1e-14 * V * end);
        EXPECT_EQ(bar.force(outside, Side::right).nearest(), 0.0);
        EXPECT_NEAR(wave(outside, -1.0), wave(outside, 1.0), 1e-14 * V);
      }
      if (next < end) {
        EXPECT_NEAR(gap(next), 0.0, 1e-14 * V * end);
      }
    }
    for (int i = 0; i < 12; ++i) {
      const double t = box.uniform(0.0, end - 2.0 * tau);
      EXPECT_NEAR(wave(t + 2.0 * tau, 1.0), back * wave(t, -1.0), 1e-12 * V);
      const auto energy = bar.energy(t);
      EXPECT_NEAR(energy.kinetic.nearest() + energy.elastic.nearest(), 0.5 * M * V * V,
                  1e-15 * M * V * V);
    }
  }
  EXPECT_GT(again, 1);
  // By the trapezoidal rule with 2e5 steps in 2 tau.
  const auto heavy = make("mass-on-bar", {{"M", 10.0}, {"t_end", 12.0}});
  EXPECT_NEAR(constant(heavy, "t_opens1"), 9.79106, 2e-5);
  EXPECT_NEAR(constant(heavy, "t_closes2"), 10.36420, 2e-5);
  EXPECT_NEAR(constant(heavy, "t_opens2"), 10.76598, 2e-5);
  EXPECT_NEAR(constant(heavy, "v_after"), -0.969839, 2e-6);
}

TEST(BarCases, ABarBetweenStopsFollowsItsCharacteristics) {
  Box box(93);
  for (int trial = 0; trial < trials(10); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 93, trial " << trial);
    const int cells = int(box.uniform(2.0, 12.0)), gap = int(box.uniform(1.0, 20.0)),
              both = gap + int(box.uniform(0.0, 20.0)), steps = int(box.uniform(1.0, 300.0));
    const double V = box.decades(-1.0, 1.0), L = box.decades(-1.0, 1.0), E = box.decades(-1.0, 1.0),
                 rho = box.decades(-1.0, 1.0), A = box.decades(-1.0, 1.0),
                 dt = L * std::sqrt(rho / E) / cells, z = A * std::sqrt(E * rho),
                 end = (steps + 1) * dt;
    const auto mesh = make("bar-between-stops", {{"V", V},
                                                 {"L", L},
                                                 {"E", E},
                                                 {"rho", rho},
                                                 {"A", A},
                                                 {"d", gap * V * dt},
                                                 {"D", both * V * dt},
                                                 {"elements", 2.0},
                                                 {"t_end", end}});
    const auto& bar = *mesh.bars;
    auto known = Characteristics::between_stops(cells, gap, both);
    for (int k = 1; k <= steps; ++k) {
      known.step();
      const double t = k * dt, scale = 1e-15 * (k + 10);
      const auto energy = bar.energy(t);
      double kinetic = 0.0, elastic = 0.0;
      for (std::size_t i = 0; i < std::size_t(cells); ++i) {
        const auto now = bar.at(0, (double(i) + 0.5) * L / cells, t, Side::right);
        const double v = 0.5 * (known.right[i] + known.left[i]),
                     s = 0.5 * (known.left[i] - known.right[i]);
        EXPECT_NEAR(now.u.nearest(), 0.25 * known.u[i] * V * dt, scale * V * dt * (both + cells));
        EXPECT_NEAR(now.v.nearest(), v * V, 1e-15 * V);
        EXPECT_NEAR(now.stress.nearest(), s * V * std::sqrt(E * rho),
                    1e-14 * V * std::sqrt(E * rho));
        kinetic += 0.5 * v * v, elastic += 0.5 * s * s;
      }
      const double unit = z * dt * V * V;
      EXPECT_NEAR(energy.kinetic.nearest(), kinetic * unit, scale * cells * unit);
      EXPECT_NEAR(energy.elastic.nearest(), elastic * unit, scale * cells * unit);
      EXPECT_NEAR(bar.impulse(t, Side::right).nearest(), known.impulse * z * V * dt,
                  scale * k * z * V * dt);
      // In the middle of the step just made.
      EXPECT_NEAR(bar.force(t - 0.5 * dt, Side::right).nearest(), known.force * z * V,
                  1e-14 * z * V);
    }
  }
  // Both limits where a front is: at the ends, and inside.
  const auto bar = make("bar-between-stops").bars;
  EXPECT_EQ(bar->force(0.25, Side::left).nearest(), 0.0);
  EXPECT_EQ(bar->force(0.25, Side::right).nearest(), 1.0);
  EXPECT_EQ(bar->force(2.25, Side::left).nearest(), 1.0);
  EXPECT_EQ(bar->force(2.25, Side::right).nearest(), 0.0);
  EXPECT_EQ(bar->at(0, 0.5, 0.75, Side::left).v.nearest(), -1.0);
  EXPECT_EQ(bar->at(0, 0.5, 0.75, Side::right).v.nearest(), 0.0);
  EXPECT_EQ(bar->at(0, 1.0, 3.0, Side::left).v.nearest(), 1.0);
  EXPECT_EQ(bar->at(0, 1.0, 3.0, Side::right).v.nearest(), 0.0);
  EXPECT_EQ(bar->at(0, 1.0, 3.5, Side::right).stress.nearest(), -1.0);
}

TEST(BarCases, PassTheirParametersOnToTheBars) {
  const auto wall =
      make("bar-wall", {{"L", 2.0}, {"E", 8.0}, {"rho", 2.0}, {"A", 3.0}, {"V", 0.5}});
  EXPECT_EQ(constant(wall, "c"), 2.0);
  EXPECT_EQ(constant(wall, "tau"), 1.0);
  EXPECT_EQ(constant(wall, "z"), 12.0);
  EXPECT_EQ(constant(wall, "t_closes1"), 0.5);
  EXPECT_EQ(constant(wall, "t_opens1"), 2.5);
  EXPECT_EQ(constant(wall, "impulse"), 12.0);
  EXPECT_EQ(wall.bars->at(0, 1.0, 1.5, Side::right).stress.nearest(), -2.0);
  const auto bouncing = make("bouncing-bar");
  EXPECT_EQ(constant(bouncing, "gap"), 0.5625);
  EXPECT_EQ(constant(bouncing, "T"), 16.0);
  EXPECT_EQ(constant(bouncing, "t_closes1"), 3.0);
  const auto two = make("two-bars");
  EXPECT_EQ(constant(two, "restitution"), 0.5);
  EXPECT_EQ(constant(two, "t_closes1"), 0.25);
}

TEST(BarCases, AreRefusedWithTheReason) {
  EXPECT_REFUSED(make("bouncing-bar", {{"N", 2.0}}), "not-admissible", "without a speed");
  EXPECT_REFUSED(make("two-bars", {{"v1", -1.0}}), "out-of-range", "do not meet");
  EXPECT_REFUSED(make("bar-between-stops", {{"D", 0.2}}), "out-of-range", "both gaps");
  EXPECT_REFUSED(make("bar-wall", {{"eta", 0.5}}), "out-of-range", "no impacts");
  EXPECT_REFUSED(make("bar-wall", {{"elements", 2.5}}), "not-whole", "whole");
  EXPECT_REFUSED(make("bar-wall", {{"elements", 1.0}}), "out-of-range", "elements");
  EXPECT_REFUSED(make("bar-wall", {{"elements", 4001.0}}), "out-of-range", "4000");
  EXPECT_REFUSED(make("two-bars", {{"elements", 2001.0}}), "out-of-range", "2000");
  EXPECT_REFUSED(make("string-on-obstacle", {{"elements", 401.0}}), "out-of-range", "--path");
  EXPECT_REFUSED(make("bar-between-stops", {{"elements", 20.0}, {"mass", "lumped"}, {"eta", 0.95}}),
                 "not-admissible", "another eta", "number of elements", "End the run earlier");
  EXPECT_REFUSED(make_mesh("bar-wall", {{"elements", 4001.0}}), "out-of-range", "4000");
  const auto large = make_mesh("string-on-obstacle", {{"elements", 401.0}});
  EXPECT_EQ(large.motion, nullptr);
  EXPECT_EQ(large.problem.dof(), 400);
}

}  // namespace
}  // namespace clackers::cases
