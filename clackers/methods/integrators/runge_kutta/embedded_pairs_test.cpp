// The tables of embedded pairs by the order conditions of rooted trees.

#include "clackers/methods/integrators/runge_kutta/embedded_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace clackers::methods {
namespace {

using PairRow = EmbeddedPair::Row;

// A rooted tree with what a table makes of it: sum_i b_i phi_i = 1/gamma is its condition.
struct Tree {
  int order;
  double gamma;
  PairRow phi;
};

class Trees {
 public:
  Trees(const EmbeddedPair& pair, int order) {
    PairRow ones;
    ones.fill(1.0);
    all.push_back({1, 1.0, ones});
    for (int n = 2; n <= order; ++n) add(pair, n - 1, all.size(), 1.0, ones, n);
  }
  std::vector<Tree> all;

 private:
  // Roots with branches among the first `below` trees, in descending order, `left` nodes to give.
  void add(const EmbeddedPair& pair, int left, std::size_t below, double gamma, const PairRow& phi,
           int order) {
    if (left == 0) {
      all.push_back({order, gamma * order, phi});
      return;
    }
    for (std::size_t k = 0; k < below; ++k) {
      if (all[k].order > left) continue;
      const Tree branch = all[k];
      PairRow product{};
      for (std::size_t i = 0; i < product.size(); ++i) {
        double sum = 0.0;
        for (std::size_t j = 0; j < product.size(); ++j) sum += pair.a[i][j] * branch.phi[j];
        product[i] = phi[i] * sum;
      }
      add(pair, left - branch.order, k + 1, gamma * branch.gamma, product, order);
    }
  }
};

// The largest difference from r^order/gamma over the trees of these orders.
double largest(const Trees& trees, const PairRow& b, double r, int first, int last) {
  double worst = 0.0;
  for (const auto& tree : trees.all) {
    if (tree.order < first || tree.order > last) continue;
    double sum = -std::pow(r, tree.order) / tree.gamma;
    for (std::size_t i = 0; i < b.size(); ++i) sum += b[i] * tree.phi[i];
    worst = std::max(worst, std::abs(sum));
  }
  return worst;
}

// The weights of the dense output at r, as its definition has them.
PairRow dense_weights(const EmbeddedPair& pair, double r) {
  const auto last = std::size_t(pair.stages);
  const auto& b = pair.a[last];
  PairRow weights{};
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double begin = k == 0 ? 1.0 : 0.0, end = k == last ? 1.0 : 0.0;
    const double d[] = {b[k],
                        begin - b[k],
                        2.0 * b[k] - begin - end,
                        pair.dense[0][k],
                        pair.dense[1][k],
                        pair.dense[2][k],
                        pair.dense[3][k]};
    for (int m = 6; m >= 0; --m) weights[k] = (m % 2 == 0 ? r : 1.0 - r) * (d[m] + weights[k]);
  }
  return weights;
}

void expect_orders(const EmbeddedPair& pair, int order, int estimate, int dense, double rounding) {
  const Trees trees(pair, order + 1);
  const auto& b = pair.a[std::size_t(pair.stages)];
  EXPECT_EQ(pair.order, order);
  EXPECT_EQ(pair.dense_order, dense);
  EXPECT_LT(largest(trees, b, 1.0, 1, order), rounding);
  EXPECT_GT(largest(trees, b, 1.0, order + 1, order + 1), 1e-6);
  EXPECT_LT(largest(trees, pair.error, 0.0, 1, estimate), rounding);
  EXPECT_GT(largest(trees, pair.error, 0.0, estimate + 1, estimate + 1), 1e-5);
  for (const double r : {0.2, 0.7}) {
    EXPECT_LT(largest(trees, dense_weights(pair, r), r, 1, dense), rounding);
    EXPECT_GT(largest(trees, dense_weights(pair, r), r, dense + 1, dense + 1), 1e-6);
  }
}

TEST(EmbeddedPairs, HaveTheNumberOfTrees) { EXPECT_EQ(Trees(dop853, 8).all.size(), 200u); }

TEST(EmbeddedPairs, MeetTheirOrderConditions) {
  expect_orders(dopri5, 5, 4, 4, 1e-13);
  expect_orders(tsit5, 5, 4, 4, 1e-13);
  expect_orders(dop853, 8, 5, 7, 1e-12);
  const Trees trees(dop853, 4);
  EXPECT_LT(largest(trees, dop853.error_3, 0.0, 1, 3), 1e-14);
  EXPECT_GT(largest(trees, dop853.error_3, 0.0, 4, 4), 1e-5);
}

}  // namespace
}  // namespace clackers::methods
