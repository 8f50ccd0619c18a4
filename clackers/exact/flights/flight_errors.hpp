#pragma once

#include <Eigen/Core>
#include <vector>

#include "clackers/exact/flights/forced_modes.hpp"

namespace clackers::exact {

/// Where the error of a modal state may be: sums of columns, each times a number from -1 to 1, of which Cauchy and
/// Schwarz bound many by the sum of their squares; and for many masses anything in a ball, |(y, y'/omega)|
/// of the modes. Flights and closing contacts do not enlarge the ball; what an impact or an opening contact
/// does to it is one direction each, which becomes a column. So errors of n masses cost n numbers an
/// event, where those of each mode cost n^2. Where damping couples modes there are columns alone.
class FlightErrors {
 public:
  using Matrix = ForcedModes::Matrix;
  using Vector = ForcedModes::Vector;
  /// Errors of a state of each entry of z are carried apart up to this number of modes.
  static constexpr Eigen::Index most_apart = 64;

  FlightErrors() = default;
  /// None, of a state of `modes`, for a motion of that many seconds.
  FlightErrors(const ForcedModes& modes, double seconds, Eigen::Index apart = most_apart)
      : columns_(2 * modes.dof(), 0), seconds_(seconds), apart_(apart) {}

  /// What an impact does to errors: 1 - impulses rates' + jumps gaps', the last for its time.
  struct Impact {
    Matrix impulses, rates, jumps, gaps;
    double rounding = 0.0;  ///< of the time [s]
  };

  /// s seconds later.
  void carry(const ForcedModes& modes, double s);
  /// Of each entry of z.
  void add(const ForcedModes& modes, const Vector& sizes);
  void add_columns(const Matrix& columns);
  /// Of the state of other modes, without the springs and the constraints whose gaps or forces are these rows
  /// of z.
  void change(const ForcedModes& from, const ForcedModes& to, const std::vector<Vector>& opened);
  void pass(const ForcedModes& modes, const Impact& impact);
  void enlarge(double factor);
  /// All of it in the ball, which takes a few numbers: for what is bounded, but not carried any more.
  void collapse(const ForcedModes& modes);

  /// Bounds on |row z| for each row, s seconds later, and up to then.
  Vector bounds(const ForcedModes& modes, const Matrix& rows, double s = 0.0) const;
  Vector bounds_until(const ForcedModes& modes, const Matrix& rows, double s) const;
  Eigen::Index columns() const { return columns_.cols(); }
  double bytes() const { return 8.0 * double(columns_.size() + squares_.size()); }

 private:
  /// What a linear map makes of columns.
  void map(auto&& linear);
  void add_squares(const Matrix& squares, Eigen::Index count);
  void add_to_ball(const ForcedModes& modes, const Vector& sizes);
  Vector sizes_of_squares() const;
  struct Ball {
    double hard = 0.0;                   // |(y, y'/omega)| of the modes
    double soft = 0.0, soft_rate = 0.0;  // |y| and |y'| of the soft ones
    bool empty() const { return hard == 0.0 && soft == 0.0 && soft_rate == 0.0; }
  };
  /// Of a mode whose displacement is bounded by its start and its rate.
  bool is_soft(const numerics::Mode& mode) const { return mode.omega * seconds_ <= 1.0; }
  Ball carried(const ForcedModes& modes, Ball ball, double s) const;
  Vector bounds_of_columns(const Matrix& rows) const;
  Vector bounds_of(const Ball& ball, const ForcedModes& modes, const Matrix& rows) const;
  void change_ball(const ForcedModes& from, const ForcedModes& to,
                   const std::vector<Vector>& opened);

  Matrix columns_;
  Matrix squares_;      // sum of columns times their transposes, of more
  double count_ = 0.0;  // of these
  Ball ball_;
  double seconds_ = 0.0;
  Eigen::Index apart_ = most_apart;
};

}  // namespace clackers::exact
