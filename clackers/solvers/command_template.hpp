#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clackers::solvers {

/// The name of a placeholder, without braces, and what takes its place.
struct PlaceholderValue {
  std::string name, value;
};

/// The command of --exec: a line for the shell with {case}, {case:text}, {h}, {n}, {tolerance},
/// {events} and {out}, or with {runs} or {runs:tolerance} in place of the last five. "${name}" and braces around anything but letters and ":" stay as they are;
/// "{{name}}" stands for "{name}".
///
/// It runs in another folder than it is typed in, hence words that name a file from here, by a path
/// or, behind the first word, by its name, become absolute: "./solver" and "python3 solver.py". Braces
/// in the name of a file that is there are part of it.
class CommandTemplate {
 public:
  /// Throws InputError for an empty command, for other placeholders (with did-you-mean), and for one
  /// without {h}, {n}, {tolerance} and {runs}, whose runs would all be the same, and for one that has
  /// {runs} and another of them.
  explicit CommandTemplate(const std::string& command);

  bool uses(std::string_view placeholder) const;
  bool by_tolerance() const;
  /// Whether it is run once for the whole ladder.
  bool makes_all_runs() const;
  /// The line for the shell. Values are quoted where a shell would read them otherwise.
  std::string filled(const std::vector<PlaceholderValue>& values) const;
  /// The files it names, the first word as PATH resolves it among them: when one of them is another
  /// than it was, the program is. One a line: path, size and time of its last change.
  std::string identity() const;
  /// The name of its first file of a program without folder and extension: "solver" of
  /// "python3 ./solver.py {case}", which the interpreter's name would not tell from others.
  std::string name() const;

 private:
  struct Part {
    std::string text;
    bool is_placeholder = false;
  };
  std::vector<Part> parts_;
  std::vector<std::string> files_;  ///< absolute; the program's first
  std::string first_word_;
};

}  // namespace clackers::solvers
