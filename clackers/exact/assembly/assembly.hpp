#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "clackers/exact/assembly/shaped_motion.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::exact {

/// The numbers behind an assembly.
class AssemblyData {
 public:
  explicit AssemblyData(const AssemblyParameters& parameters);

  struct Pair {
    double m2 = 1.0;  ///< of the fast mass [kg], 1/2 to 2
    double r = 1.0;   ///< m1/m2, 1/8 to 2
    double A = 1.0;   ///< x_(2j) at t = 0 [m], 1/2 to 3/2
  };
  Pair pair(std::size_t j) const;
  /// Row i of S has entries from this column to i.
  std::size_t first_column(std::size_t i) const;
  /// At most 1/2 in a row's sum of sizes, but for the 1 on the diagonal.
  double entry(std::size_t i, std::size_t j) const;
  std::size_t dof() const { return dof_; }

 private:
  std::uint64_t seed_ = 0;
  Coupling coupling_ = Coupling::chain;
  std::size_t dof_ = 0;
  double unit_ = 1.0;  // entries are whole multiples of it, -8 to 8
};

/// Memory: two numbers a mass and two a contact, whatever the coupling. Throws InputError for
/// parameters outside their ranges.
std::unique_ptr<const ShapedMotion> make_assembly(const AssemblyParameters& parameters,
                                                  std::string_view who = "assembly");

/// What a method is given, with dense matrices: throws InputError, before it allocates them, where
/// they do not fit (limits.hpp). M = S^T diag(m) S is exact as long as no entry has more than 53 bits.
model::ImpactProblem<> assembly_problem(const AssemblyParameters& parameters,
                                        const model::Motion& motion,
                                        std::string_view who = "assembly");
void require_assembly_fits(std::string_view who, double pairs);

}  // namespace clackers::exact
