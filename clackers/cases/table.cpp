#include <vector>

#include "clackers/cases/builders.hpp"

namespace clackers::cases {
namespace {

// A parameter of the same name means the same in every case.
CaseParameter xi1() { return {"xi1", 0.05, "", "0 or 1e-60 <= xi1 < 1", "damping ratio of mass 1"}; }
CaseParameter eta() { return {"eta", 1.0, "", "0 <= eta <= 1", "restitution; 1 is elastic"}; }
CaseParameter t_end() { return {"t_end", 20.0, "s", "0 < t_end < infinity", "end of the run"}; }
CaseParameter whole_N() {
  return {"N", 2.0, "", "a whole number, 0 <= N <= 249999999",
          "mass 2 is X = 4N + 1 times as fast as mass 1, Eq. (9)"};
}
CaseParameter scale(const char* name, double standard, const char* unit, const char* allowed,
                    const char* meaning) {
  return {name, standard, unit, allowed, meaning};
}

const std::vector<Row>& rows() {
  static const std::vector<Row> all{
      {{"sdof", "One damped mass without a stop.", "Eq. (3)-(4)", {xi1(), t_end()}}, build_sdof},
      {{"stop",
        "One damped mass above a rigid stop at its equilibrium.",
        "Eq. (5)-(6)",
        {xi1(), eta(), t_end()}},
       build_stop},
      {{"symmetric-pair",
        "Two equal masses with opposite motions that collide at equilibrium.",
        "Eq. (7)-(8)",
        {xi1(), eta(), t_end()}},
       build_symmetric_pair},
      {{"one-parameter",
        "Two colliding masses, the second 4N + 1 times as fast; xi1 = 0.05, t_end = 20 s.",
        "Eq. (19)-(20)",
        {whole_N()}},
       build_one_parameter},
      {{"two-parameter",
        "Two colliding masses, the second 4N + 1 times as fast; t_end = 20 s.",
        "Eq. (21)-(22)",
        {whole_N(), xi1()}},
       build_two_parameter},
      {{"three-parameter",
        "Two colliding masses, the second 4N + 1 times as fast; t_end = 20 a_t.",
        "Eq. (25)-(26)",
        {whole_N(),
         xi1(),
         {"a_t", 1.0, "", "0 < a_t < infinity", "length of the run in units of 20 s, Eq. (24)"}}},
       build_three_parameter},
      {{"synchronized-pair",
        "The whole class: any masses, odd frequency ratio, mass ratio below r*, restitution.",
        "Section 2.2, Eq. (9)-(17)",
        {scale("m1", 1.0, "kg", "1e-60 <= m1 <= 1e+60", "mass 1, above"),
         scale("k1", 1.0, "N/m", "1e-60 <= k1 <= 1e+60", "stiffness of mass 1"),
         xi1(),
         scale("A", 1.0, "m", "1e-60 <= A <= 1e+60", "size of the initial displacement of mass 1"),
         {"X", 9.0, "", "an odd whole number from 1 to 1e+09, or 1 over one",
          "frequency ratio omega_D2/omega_D1; 1 over an odd number exchanges the roles"},
         {"r", 3.0, "", "0 < r < r*(X)",
          "mass ratio m1/m2; beyond 1/r* for X = 1 over an odd number"},
         eta(),
         t_end()}},
       build_synchronized_pair},
      {{"exact-data-pair",
        "The class with every model input a binary64 number, so that nothing is rounded.",
        "Section 2.2, Eq. (9)-(17)",
        {scale("m2", 1.0, "kg", "1e-30 <= m2 <= 1e+30, a short binary fraction",
               "mass 2, the fast one"),
         scale("Omega", 1.0, "rad/s", "1e-30 <= Omega <= 1e+30, a short binary fraction",
               "damped frequency of mass 1"),
         scale("sigma", 0.0625, "1/s", "0 or 1e-30 <= sigma <= 1e+30, a short binary fraction",
               "common rate of decay"),
         scale("A_over_X", 0.125, "m", "1e-30 <= A_over_X <= 1e+30, a short binary fraction",
               "initial displacement of mass 1 over X"),
         {"X", 9.0, "", "an odd whole number from 1 to 1e+09", "frequency ratio omega_D2/omega_D1"},
         {"r", 0.5, "", "0 < r < r*(X), a short binary fraction", "mass ratio m1/m2"},
         eta(),
         t_end()}},
       build_exact_data_pair},
  };
  return all;
}

}  // namespace

std::span<const Row> table() { return rows(); }

}  // namespace clackers::cases
