#pragma once

#include <vector>

#include "clackers/diagnose/diagnose.hpp"

namespace clackers::diagnose {

/// Root mean square distance of rows from a motion over its scale, largest over the masses.
struct RowDistance {
  double u = 0.0;
  double v =
      0.0;  ///< the tenth of the rows that is worst left out: those between an impact and the
            ///< true one; 0 without velocities
};

/// The sample of a history beside the reference at its times.
class FileSample {
 public:
  FileSample(const Observation& history, const model::Motion& motion);

  const Observation& history() const { return history_; }
  const model::Motion& motion() const { return motion_; }
  const model::Trajectory& rows() const { return history_.sample; }
  bool has_v() const { return !rows().v.empty(); }
  const model::Kinematics& scale() const { return scale_; }
  /// From the reference at the times of the file.
  const RowDistance& distance() const { return distance_; }
  /// Largest |u - reference| over the scale.
  double largest_error() const { return largest_; }
  /// The median over the rows of the largest over the masses.
  double median_error() const { return median_; }
  /// From the reference at other times, one a row; those outside the motion are moved to its ends.
  RowDistance distance_at(const std::vector<double>& times) const;
  /// Of other rows, those of another reading of the file, from the reference; row 0 left out.
  RowDistance distance_of(const model::Trajectory& other) const;
  /// Of any rows from others.
  RowDistance distance_between(const model::Trajectory& found,
                               const model::Trajectory& reference) const {
    return distance(found, reference, 0);
  }

 private:
  RowDistance distance(const model::Trajectory& found, const model::Trajectory& reference,
                       std::size_t first) const;

  const Observation& history_;
  const model::Motion& motion_;
  model::Kinematics scale_;
  model::Trajectory reference_;
  RowDistance distance_;
  double largest_ = 0.0, median_ = 0.0;
};

/// At most eight of the histories, the finest first, the coarsest last.
std::vector<FileSample> samples_of(const DiagnosisInput& question);

/// The families of file_causes(). Each looks at samples_of(), the finest first, none empty.
std::vector<Diagnosis> reading_causes(const std::vector<FileSample>& files);
std::vector<Diagnosis> time_causes(const std::vector<FileSample>& files);
std::vector<Diagnosis> output_causes(const std::vector<FileSample>& files,
                                     const DiagnosisInput& question);
std::vector<Diagnosis> velocity_causes(const std::vector<FileSample>& files,
                                       const DiagnosisInput& question);
std::vector<Diagnosis> number_causes(const std::vector<FileSample>& files);
std::vector<Diagnosis> row_causes(const std::vector<FileSample>& files,
                                  const DiagnosisInput& question);

}  // namespace clackers::diagnose
