#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/study/refinement.hpp"

// What a campaign runs, in TOML: systems, methods and the ladder.
namespace clackers::campaign {

/// One method: of the catalogue, or a program of the user.
struct MethodEntry {
  enum class Kind { catalogue, command };
  Kind kind = Kind::catalogue;
  std::string text;    ///< the specification, or the command line
  std::string name;    ///< in the results; of a command it may be empty
  std::string expect;  ///< "proper:2"; of a command, may be empty
  record::Labels labels{};
  std::vector<double> steps{};  ///< of a command, descending, instead of the ladder's [s]
};

/// The values of one parameter: listed, or points of a range.
struct Axis {
  std::string name;
  std::vector<ParameterValue> listed{};
  double from = 0.0, to = 0.0;
  long long points = 0;  ///< of a range on a grid; 0: the range is sampled, or values are listed
  bool is_log = false;

  bool is_range() const { return listed.empty(); }
  long long size() const { return is_range() ? points : static_cast<long long>(listed.size()); }
  /// Of a range at `share` in [0, 1]; both ends are exact.
  double at(double share) const;
  /// The value of a grid; i in [0, size()).
  ParameterValue value(long long i) const;
};

enum class SampleKind { grid, latin_hypercube, sobol };

/// How the ranges of a case are turned into points.
struct Sample {
  SampleKind kind = SampleKind::grid;
  long long points = 0;
  long long seed = 0;
};

/// The systems of one case: every combination of its axes, the last one fastest. Ranges that are sampled
/// together count as one axis, behind the others.
struct CaseSystems {
  std::string name;
  std::vector<Axis> axes;
  Sample sample{};
  long long first = 0;  ///< system of the specification

  long long size() const;
  /// The settings of system i; a pure function of this and i.
  Settings settings(long long i) const;
};

/// The ladder of every task; what is not given follows the system, as in `verify`.
using Ladder = study::RefinementRequest;

/// One system: a case with the values of its parameters.
struct System {
  long long number = 0;   ///< from 0, over all cases
  std::string_view name;  ///< of the case
  Settings settings;
};

/// A specification. Tasks are counted and computed from their number, never listed: task =
/// system * methods + method, systems case after case.
class Specification {
 public:
  /// Reads the text of a file; `name` stands in messages, with the line. Throws InputError for text that
  /// is no TOML, unknown keys and names (with did-you-mean), ranges without points, methods or cases
  /// named twice, and more than 1e18 tasks.
  static Specification from_toml(std::string_view text, const std::string& name);
  /// The same of a file. Throws FileError (cannot-read) too.
  static Specification read(const std::string& path);

  const std::string& name() const { return name_; }  ///< of the file
  const std::string& text() const { return text_; }  ///< verbatim
  const std::vector<MethodEntry>& methods() const { return methods_; }
  const Ladder& ladder() const { return ladder_; }
  /// Names of the metrics that are kept; empty: none are measured.
  const std::vector<std::string>& metrics() const { return metrics_; }
  /// Whether each run is repeated to measure only its processor time, as in `verify`.
  bool times_runs() const { return times_runs_; }
  const std::vector<CaseSystems>& cases() const { return cases_; }

  long long systems() const { return systems_; }
  long long tasks() const { return systems_ * static_cast<long long>(methods_.size()); }
  System system(long long number) const;

  /// The parameters that some case sets, each once, in the order of the file: columns "set_NAME".
  std::vector<std::string> parameters() const;

 private:
  friend class SpecificationReader;

  std::string name_, text_;
  std::vector<MethodEntry> methods_;
  Ladder ladder_;
  std::vector<std::string> metrics_;
  bool times_runs_ = false;
  std::vector<CaseSystems> cases_;
  long long systems_ = 0;
};

/// Most dimensions of a sample.
inline constexpr std::size_t most_dimensions = 64;

/// Point i of a sample in [0, 1)^dimensions, computed from its number alone.
///
/// latin-hypercube: each dimension has one point in each of `points` equal intervals, in an order and
/// at a place inside it that follow from seed and dimension (M. D. McKay et al., Technometrics 21,
/// 239-245 (1979)). sobol: S. Joe and F. Y. Kuo's sequence (SIAM J. Sci. Comput. 30, 2635-2654
/// (2008)) as Boost has it, without its first point 0; a seed other than 0 adds a shift modulo 1.
std::vector<double> sample_point(const Sample& sample, std::size_t dimensions, long long i);

/// Entry i of a permutation of 0 ... size - 1 that follows from `key`.
long long permuted(long long i, long long size, unsigned long long key);

}  // namespace clackers::campaign
