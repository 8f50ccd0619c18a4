// Everything small that reads foreign text.
#include <algorithm>
#include <cmath>

#include "clackers/cases/case.hpp"
#include "clackers/input/history.hpp"
#include "clackers/methods/method_specification.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/solvers/command_template.hpp"
#include "cli/files/paths.hpp"
#include "cli/values.hpp"
#include "target.hpp"

namespace clackers::fuzz {
namespace {

bool finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

// The parts of a text between commas.
std::vector<std::string> parts(std::string_view text) {
  std::vector<std::string> out{{}};
  for (const char c : text)
    if (c == ',')
      out.emplace_back();
    else
      out.back() += c;
  return out;
}

void require_whole(const input::History& history, int dof) {
  const auto& motion = history.motion;
  const auto rows = motion.t.size(), cells = rows * std::size_t(dof);
  require(rows >= 2, "a history has two rows");
  require(motion.u.size() == cells, "u has a value a row and mass");
  require(motion.v.empty() || motion.v.size() == cells, "v is empty or whole");
  require(motion.a.empty() || motion.a.size() == cells, "a is empty or whole");
  require(history.has_u.size() == std::size_t(dof), "has_u has an entry a mass");
  require(finite(motion.t) && finite(motion.u) && finite(motion.v) && finite(motion.a),
          "numbers are finite");
  require(std::ranges::is_sorted(motion.t), "times ascend");
  require(history.spacing > 0.0, "the spacing is positive");
}

}  // namespace

// The first byte chooses the masses, whether there is a step, and whether the next line names the
// columns.
void read_history(std::string_view bytes) {
  if (bytes.empty()) return;
  const unsigned choice = static_cast<unsigned char>(bytes.front());
  bytes.remove_prefix(1);
  input::HistoryOptions options{.dof = choice % 2 == 0 ? 2 : 1};
  if (choice / 2 % 2 == 1) options.step = 0.01;
  if (choice / 4 % 2 == 1) {
    options.columns = parts(bytes.substr(0, bytes.find('\n')));
    bytes.remove_prefix(std::min(bytes.size(), bytes.find('\n')));
  }
  const MemoryFile file(bytes);
  require_whole(input::read_history(file.path(), options), options.dof);
}

// A NumPy file behind its magic bytes. The first byte chooses the masses, and names for up to seven
// columns of a plain array.
void read_npy(std::string_view bytes) {
  if (bytes.empty()) return;
  const unsigned choice = static_cast<unsigned char>(bytes.front());
  const MemoryFile file("\x93NUMPY" + std::string(bytes.substr(1)));
  input::HistoryOptions options{.dof = choice % 2 == 0 ? 2 : 1, .step = 0.01};
  for (const auto* name : {"t", "u1", "v1", "u2", "v2", "a1", "a2"})
    if (options.columns.size() < choice / 2 % 8) options.columns.emplace_back(name);
  require_whole(input::read_history(file.path(), options), options.dof);
}

void read_events(std::string_view bytes) {
  const MemoryFile file(bytes);
  const auto events = input::read_events(file.path(), 2);
  double last = -INFINITY;
  for (const auto& event : events) {
    require(std::isfinite(event.t) && event.t >= last, "times of impacts ascend");
    require(event.u.empty() || event.u.size() == 2, "u is empty or has a value a mass");
    require(event.v_before.empty() || event.v_before.size() == 2, "v- is empty or whole");
    require(event.v_after.empty() || event.v_after.size() == 2, "v+ is empty or whole");
    last = event.t;
  }
}

void read_specification(std::string_view bytes) {
  const auto terms = methods::parse_specification(bytes);
  require(!terms.first.name.empty(), "a specification has a name");
  for (const auto& [name, value] : terms.first.settings)
    require(!name.empty() && (value.is_word() || std::isfinite(double(value))),
            "a parameter has a name and a finite value or a word");
  const auto method = methods::method(bytes);
  const auto again = methods::method(method->facts().name);
  require(again->facts().name == method->facts().name, "a method's name is its specification");
}

void read_settings(std::string_view bytes) {
  const auto settings = cli::read_settings({std::string(bytes)});
  require(!settings.empty(), "one setting a part");
  for (const auto& [name, setting] : settings) {
    require(!name.empty() && name.find('=') == std::string::npos, "a name holds no =");
    if (setting.is_word()) continue;
    const double value = setting;
    const auto text = bytes.substr(bytes.rfind('=') + 1);
    if (std::isfinite(value) && value == std::floor(value) && std::abs(value) < 1e15 &&
        &name == &settings.back().first)
      require(double(cli::read_whole(name, text, -1'000'000'000'000'000, 1'000'000'000'000'000)) ==
                  value,
              "a whole number is read as itself");
  }
}

void read_times(std::string_view bytes) {
  const MemoryFile file(bytes);
  const auto times = cli::read_times(file.path(), 20.0);
  require(!times.empty(), "an empty file is refused");
  for (const double t : times) require(t >= 0.0 && t <= 20.0, "times lie within the run");
}

constexpr auto placeholders = {"case", "case:text",     "h", "n", "tolerance", "events", "out",
                               "runs", "runs:tolerance"};

// The command of --exec.
void read_command(std::string_view bytes) {
  const solvers::CommandTemplate command{std::string(bytes)};
  require(!command.name().empty(), "a program has a name");
  require(command.identity() == command.identity(), "a program stays the same");
  const auto filled = [&](const char* value) {
    std::vector<solvers::PlaceholderValue> values;
    for (const auto* name : placeholders) values.push_back({name, value});
    return command.filled(values);
  };
  // Whatever a value holds, it is one word in single quotes and changes nothing around it.
  const auto plain = filled("value"), strange = filled("'; $x `y` \"z\\");
  constexpr std::string_view quoted = "''\\''; $x `y` \"z\\'";
  std::size_t count = 0;
  for (auto at = strange.find(quoted); at != std::string::npos; at = strange.find(quoted, at + 1))
    ++count;
  std::size_t used = 0;
  for (const auto* name : placeholders) used += command.uses(name) ? 1 : 0;
  require(used > 0 && count >= used, "a value is quoted");
  require(strange.size() - plain.size() == count * (quoted.size() - 5) ||
              bytes.find("; $x `y` \"z") != std::string_view::npos,
          "a value changes nothing else");
}

}  // namespace clackers::fuzz
