#pragma once

#include <vector>

#include "clackers/exact/assembly/shaped_motion.hpp"
#include "clackers/exact/certified/enclosure.hpp"

namespace clackers::certified {

/// Of any number of masses that fly the same way after each impact, up to a factor: buildings, row,
/// alternating, assembly.
class ShapedEnclosure : public Enclosure {
 public:
  explicit ShapedEnclosure(const exact::ShapedMotion& motion);

  double fraction_bits(long long flights) const override;
  bool is_undamped() const override;

 protected:
  const Ball& omega() override { return constants().omega; }
  const Ball& sigma() override { return constants().sigma; }
  KinematicBalls at_now(long long k, double t) override;
  ImpactBalls impact_now(long long k) override;

 private:
  /// Where in a flight, from -1/2 just after an impact to 1/2 just before one.
  struct Phase {
    bool is_exact = false;
    double halves = 0.0;  ///< 2 theta / pi where it is exact: -1, 0 or 1
    Ball turns;           ///< theta / pi elsewhere
    bool is_odd = false;  ///< of the number of flights before
  };
  struct SineCosine {
    Ball sine, cosine;
  };
  /// With the working bits of now.
  struct Constants {
    long bits = 0;
    Ball omega, sigma;
    Ball energy;                                      ///< at an impact, without decay [J]
    std::vector<std::vector<Ball>> coefficients;      ///< what each kind of motion needs
    std::vector<std::vector<Ball>> impulses_by_turn;  ///< as ImpactPattern::contacts
  };
  const Constants& constants();
  void fill(const exact::BuildingsParameters& p);
  void fill(const exact::RowParameters& p);
  void fill(const exact::AlternatingParameters& p);
  void fill(const exact::AssemblyParameters& p);

  /// Displacements without decay and their first and second derivatives.
  KinematicBalls shape(const exact::BuildingsParameters& p, const Phase& phase);
  KinematicBalls shape(const exact::RowParameters& p, const Phase& phase);
  KinematicBalls shape(const exact::AlternatingParameters& p, const Phase& phase);
  KinematicBalls shape(const exact::AssemblyParameters& p, const Phase& phase);
  /// Of multiple theta + quarters pi/4.
  static SineCosine turned(const Phase& phase, double multiple, double quarters);
  KinematicBalls state(const Phase& phase, const Ball& decay);

  exact::ShapedParameters parameters_;
  int dof_;
  Constants c_;
};

}  // namespace clackers::certified
