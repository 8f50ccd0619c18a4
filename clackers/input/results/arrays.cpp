#include "clackers/input/results/arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <regex>

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"

namespace clackers::input {
namespace {

struct Meaning {
  char quantity = 't';
  std::string mass{}, node{};  // its number, or its label in MBDyn
};

// By the name in its group; Octave writes the values of a variable x of HDF5 as x/value.
std::optional<Meaning> meaning_of(std::string name) {
  static const std::regex plain(R"(([uva])(?:\[?([1-9][0-9]{0,3})\]?)?)"),
      mbdyn(R"(node\.struct\.([0-9]{1,9})\.X(P{0,2}))");
  if (name.ends_with("/value")) name.resize(name.size() - 6);
  name.erase(0, name.rfind('/') + 1);
  std::smatch parts;
  if (std::regex_match(name, parts, plain)) return Meaning{parts[1].str()[0], parts[2]};
  if (std::regex_match(name, parts, mbdyn)) return Meaning{"uva" [parts[2].length()], {}, parts[1]};
  return name == "time" || name == "t" ? std::optional(Meaning{}) : std::nullopt;
}

struct Strided {
  const double* first;
  std::size_t stride;
};

}  // namespace

bool is_history_array(const std::string& name) { return meaning_of(name).has_value(); }

ResultRows rows_of(const std::string& file, const std::vector<NamedArray>& arrays,
                   const ResultChoice& choice) {
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}.", file, what), "not-an-array");
  };
  std::size_t count = 0;
  for (const auto& array : arrays)
    if (const auto meaning = meaning_of(array.name); meaning && meaning->quantity == 't')
      count = array.values.size();
    else if (meaning && count == 0 && !array.shape.empty())
      count = *std::ranges::max_element(array.shape);
  if (count == 0) fail("it has no variables t, u[1], u[2], ... or t, u");
  ChosenNodes nodes(choice);
  std::map<std::string, Strided> columns;
  for (const auto& array : arrays) {
    const auto meaning = meaning_of(array.name);
    if (!meaning || (array.values.size() == 1 && count > 1)) continue;  // a parameter
    auto shape = array.shape;
    std::erase(shape, 1u);
    if (shape.empty()) shape = {1};
    const auto axis = std::size_t(std::ranges::find(shape, count) - shape.begin());
    if (shape.size() > 2 || axis == shape.size())
      fail(fmt::format("{} and the times have different lengths", printable(array.name)));
    const auto width = array.values.size() / count;
    const auto add = [&](const std::string& name, std::size_t j) {
      columns[name] = axis == 0 ? Strided{array.values.data() + j, width}
                                : Strided{array.values.data() + j * count, 1};
    };
    if (!meaning->node.empty()) {
      const auto j = std::size_t(choice.direction - 1);
      if (j >= width) fail(fmt::format("{} has no component {}", array.name, choice.direction));
      if (const auto mass = nodes.mass_of(meaning->node))
        add(fmt::format("{}{}", meaning->quantity, *mass + 1), j);
    } else if (meaning->quantity == 't' || !meaning->mass.empty()) {
      if (width != 1) fail(fmt::format("{} has several columns", printable(array.name)));
      add(meaning->quantity + meaning->mass, 0);
    } else {
      for (std::size_t j = 0; j < width; ++j) add(fmt::format("{}{}", meaning->quantity, j + 1), j);
    }
  }
  nodes.finish(file,
               [&](std::size_t mass) { return columns.contains(fmt::format("u{}", mass + 1)); });
  ResultRows rows;
  for (const auto& [name, column] : columns) rows.names.push_back(name);
  for (std::size_t i = 0; i < count; ++i)
    for (const auto& [name, column] : columns) {
      const double value = column.first[i * column.stride];
      rows.numbers.push_back({value, value == 0.0 ? 0 : 17});
    }
  return rows;
}

}  // namespace clackers::input
