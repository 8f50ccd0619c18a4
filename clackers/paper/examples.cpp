// Figure 10: ten members of the three-parameter class.
#include <fmt/format.h>

#include <array>

#include "clackers/paper/catalogue.hpp"
#include "clackers/paper/curves.hpp"

namespace clackers::paper {
namespace {

struct Member {
  const char* label;
  int N;
  double xi1, a_t;
};

// (a) to (h) stand in the caption. (i) and (j) are garbled there; see the figure's choices.
constexpr auto members = std::to_array<Member>({{"a", 0, 0.05, 4.0},
                                                {"b", 0, 0.05, 1.0},
                                                {"c", 0, 0.10, 1.0},
                                                {"d", 1, 0.10, 1.0},
                                                {"e", 1, 0.15, 1.0},
                                                {"f", 1, 0.15, 1.2},
                                                {"g", 2, 0.15, 1.2},
                                                {"h", 2, 0.25, 1.2},
                                                {"i", 2, 0.25, 0.5},
                                                {"j", 5, 0.25, 1.0}});

int changes(const Member& one, const Member& next) {
  return (one.N != next.N) + (one.xi1 != next.xi1) + (one.a_t != next.a_t);
}

}  // namespace

Figure three_parameters() {
  Figure figure;
  figure.columns = 2;
  figure.width = 330.0;
  figure.height = 130.0;
  figure.caption =
      "Exact displacements of ten members of the three-parameter class, Eq. (25)-(26): "
      "m1 = k1 = 1, m2 = 1/3 kg, 0 ≤ t < 20 a_t.";
  for (const auto& [label, N, xi1, a_t] : members)
    figure.panels.push_back(response_panel(
        cases::make("three-parameter", {{"N", double(N)}, {"xi1", xi1}, {"a_t", a_t}}),
        Quantity::displacement, label, fmt::format("N = {}, ξ1 = {:.2f}, a_t = {}", N, xi1, a_t),
        N == 0 ? std::vector{-3.0, 1.0} : std::vector{-0.6, 1.0}));
  int single = 0;
  for (std::size_t i = 1; i < members.size(); ++i)
    single += changes(members[i - 1], members[i]) == 1;
  const auto& i = members[members.size() - 2];
  const auto& j = members.back();
  figure.claims = {
      {"Section 2.2: each two successive panels differ in one parameter only, except (i) and (j), "
       "which differ in N and a_t.",
       fmt::format("With the parameters drawn: {} of 8 steps from (a) to (i) change one parameter; "
                   "(i) to (j) changes {}.",
                   single, changes(i, j)),
       single == 8 && i.N != j.N && i.a_t != j.a_t && i.xi1 == j.xi1}};
  figure.choices = {
      "The caption is garbled from (i) on: it repeats the line of (h). The text says that (g) to "
      "(i) "
      "have N = 2, that (i) differs from (h) in one parameter, and that (j) has N = 5 and differs "
      "from (i) in N and a_t. So ξ1 = 0.25 for (i) and (j), and a_t is free. Taken: a_t = 0.5 for "
      "(i) and 1 for (j), where the motion is still to be seen: exp(−0.25·24) = 0.0025 is left of "
      "it at the end of (h).",
      "For N = 0, Eq. (25) has m2 = 1/3 kg and u2(0) = −3 m; this is not the system (7)."};
  return figure;
}

}  // namespace clackers::paper
