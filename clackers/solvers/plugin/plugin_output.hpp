#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "clackers/base/codes.hpp"
#include "clackers/solvers/plugin/clackers_solver.h"
#include "clackers/solvers/plugin/number_file.hpp"
#include "clackers/solvers/process.hpp"

namespace clackers::solvers {

/// What a plug-in calls back: writes the states and collisions that it delivers to files, and keeps
/// the first failure.
class PluginOutput : public clackers_solver_host {
 public:
  /// The files of states and collisions, which appear in commit(), each of at most `most_bytes`.
  PluginOutput(int dof, const std::filesystem::path& history, const std::filesystem::path& events,
               std::size_t most_bytes = most_output);

  /// Whether states and collisions are taken, which only run may deliver.
  void accept(bool accepted) { accepts_ = accepted; }
  /// Keeps a failure, unless there is one.
  void set_failure(Code code, std::string sentence);
  std::string_view failure_code() const { return code_; }  ///< empty: none so far
  const std::string& failure() const { return failure_; }

  /// Puts the files in their places, that of collisions only where some were reported. A run without
  /// states at two times is a failure. Throws FileError.
  void commit();

 private:
  template <class Take>
  std::int32_t guarded(const Take& take);
  void take_state(double t, const double* u, const double* v, const double* a);
  void take_collision(double t, double impulse, const double* before, const double* after);
  void require_time(const char* who, double t, double last);
  void require_same(const char* who, const char* what, bool is_given, bool was_given);
  void end_row(NumberFile& file, const char* who);
  void add_values(NumberFile& file, const char* who, const char* name, double t,
                  const double* values);

  int dof_;
  std::size_t most_bytes_;
  NumberFile history_, events_;
  bool accepts_ = false;
  std::string code_, failure_;

  // Of the first state and of the first collision: what all others have as well.
  struct Shape {
    double first_t = 0.0, last_t = 0.0;
    bool has_v = false, has_a = false, has_impulse = false;
  };
  std::optional<Shape> states_, collisions_;
  int at_last_t_ = 0;  ///< states at the last time
};

}  // namespace clackers::solvers
