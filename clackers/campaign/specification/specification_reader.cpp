#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "clackers/base/check.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/base/files/toml_reader.hpp"
#include "clackers/campaign/specification.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/solvers/program.hpp"
#include "clackers/study/check.hpp"
#include "clackers/study/system_study.hpp"

namespace clackers::campaign {
namespace {

constexpr double most_tasks = 1e18;

std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const auto& metric : measure::metrics()) names.emplace_back(metric.name);
  return names;
}

}  // namespace

// Fills a specification from its parsed text.
class SpecificationReader : public TomlReader {
 public:
  SpecificationReader(const std::string& name, Specification& out) : TomlReader(name), out_(out) {}

  void read(const toml::table& root) {
    require_known(root, {"methods", "ladder", "metrics", "times", "cases"}, "");
    const auto& methods = need(root, "methods", "a list of methods, [\"panel\"]");
    if (methods.is_string())
      add_methods(methods);
    else
      for (const auto& node : list(methods, "methods")) add_methods(node);
    if (const auto* node = root.get("ladder")) read_ladder(*node);
    if (const auto* node = root.get("metrics")) read_metrics(*node);
    if (const auto* node = root.get("times")) out_.times_runs_ = flag(*node, "times");
    need(root, "cases", "[[cases]] above each case");
    for (const auto& node : *tables(root, "cases")) add_case(*node.as_table());
  }

 private:
  void add_methods(const toml::node& node) {
    if (node.is_table()) return add_solver(node, *node.as_table());
    const auto text = word(node, "a method");
    if (text == "all" || text == "panel") {
      for (const auto& item : text == "all" ? methods::pairs() : methods::default_panel())
        add_method(node, {MethodEntry::Kind::catalogue, item, study::subject_name(item), {}});
    } else {
      const auto name = at(node, [&] { return study::subject_name(text); });
      add_method(node, {MethodEntry::Kind::catalogue, text, name, {}});
    }
  }
  void add_method(const toml::node& node, MethodEntry entry) {
    // A program without a name has that of its file.
    if (!known_.insert(entry.name.empty() ? "file of " + entry.text : entry.name).second)
      fail(node, fmt::format("method = {}; allowed: each method once.", entry.text), "bad-syntax");
    out_.methods_.push_back(std::move(entry));
  }
  void add_solver(const toml::node& node, const toml::table& values) {
    if (values.contains("plugin"))
      fail(node, std::string(solvers::instead_of_plugin), "unknown-name");
    require_known(values, {"exec", "name", "expect", "labels", "steps"}, " of a method");
    const auto* exec = values.get("exec");
    if (exec == nullptr)
      fail(node, "a table among methods has no exec; allowed: { exec = \"COMMAND\" }.",
           "bad-syntax");
    MethodEntry entry;
    entry.kind = MethodEntry::Kind::command;
    entry.text = word(*exec, "exec");
    if (const auto* name = values.get("name")) entry.name = word(*name, "name");
    if (const auto* expect = values.get("expect")) {
      entry.expect = word(*expect, "expect");
      at(*expect, [&] { return study::claim_from(entry.expect); });
    }
    if (const auto* labels = values.get("labels"))
      for (const auto& [key, value] : table(*labels, "labels", "{ KEY = \"value\" }"))
        entry.labels[std::string(key.str())] = word(value, "a label");
    if (const auto* steps = values.get("steps"))
      for (const auto& item : list(*steps, "steps")) entry.steps.push_back(number(item, "a step"));
    add_method(node, std::move(entry));
  }

  void read_ladder(const toml::node& node) {
    const auto& values = table(node, "ladder", "[ladder] with levels and more below it");
    require_known(values, {"levels", "samples_per_level", "neighbours", "coarsest", "tolerances"},
                  " of ladder");
    auto& ladder = out_.ladder_;
    if (const auto* found = values.get("levels"))
      ladder.levels = static_cast<int>(whole(*found, "levels", 1, 64));
    for (const auto* name : {"neighbours", "samples_per_level"})  // the first is the former name
      if (const auto* found = values.get(name))
        ladder.samples_per_level = static_cast<int>(whole(*found, name, 1, 64));
    if (const auto* found = values.get("coarsest")) {
      ladder.coarsest = number(*found, "coarsest");
      if (!(*ladder.coarsest > 0.0))
        fail(*found, fmt::format("coarsest = {}; allowed: above 0 s.", *ladder.coarsest),
             "step-not-positive");
    }
    if (const auto* found = values.get("tolerances"))
      ladder.tolerances = at(*found, [&] { return tolerances(*found); });
  }
  std::vector<double> tolerances(const toml::node& node) const {
    if (!node.is_array()) return solvers::tolerances_from(word(node, "tolerances"));
    std::string text;
    for (const auto& item : list(node, "tolerances"))
      text += fmt::format("{}{}", text.empty() ? "" : ",", number(item, "a tolerance"));
    return solvers::tolerances_from(text);
  }

  void read_metrics(const toml::node& node) {
    const auto known = metric_names();
    if (node.is_boolean()) {
      if (flag(node, "metrics")) out_.metrics_ = known;
      return;
    }
    for (const auto& item : list(node, "metrics")) {
      const auto name = word(item, "a metric");
      if (std::ranges::find(known, name) == known.end())
        at(item, [&] { refuse_name("metric", name, known, "clackers list metrics"); });
      if (std::ranges::find(out_.metrics_, name) != out_.metrics_.end())
        fail(item, fmt::format("metric = {}; allowed: each metric once.", name), "bad-syntax");
      out_.metrics_.push_back(name);
    }
  }

  void add_case(const toml::table& values) {
    require_known(values, {"case", "set", "sample"}, " of a case");
    const auto& name = need(values, "case", "the name of a case (clackers list cases)");
    CaseSystems added;
    added.name = word(name, "case");
    const auto& entry = at(name, [&] { return &cases::entry(added.name); })->parameters;
    if (const auto* sample = values.get("sample")) added.sample = sample_of(*sample);
    if (const auto* set = values.get("set"))
      for (const auto& [key, node] : table(*set, "set", "{ NAME = value, ... }"))
        added.axes.push_back(axis_of(added, entry, std::string(key.str()), node));
    in_file_order(added, values);
    count(added, values);
    added.first = out_.systems_;
    out_.systems_ += added.size();
    out_.cases_.push_back(std::move(added));
  }
  // Tables of toml++ are sorted by name; the file's order is that of lines and columns.
  static void in_file_order(CaseSystems& systems, const toml::table& values) {
    const auto* set = values.get("set");
    if (set == nullptr) return;
    const auto place = [&](const Axis& axis) {
      const auto begin = set->as_table()->get(axis.name)->source().begin;
      return std::pair(begin.line, begin.column);
    };
    std::ranges::sort(systems.axes, {}, place);
  }

  Sample sample_of(const toml::node& node) const {
    const auto& values = table(node, "sample", "{ kind = \"sobol\", points = 100, seed = 1 }");
    require_known(values, {"kind", "points", "seed"}, " of a sample");
    static const std::vector<std::string> kinds{"grid", "latin-hypercube", "sobol"};
    const auto& kind = need(values, "kind", "grid, latin-hypercube or sobol");
    const auto name = word(kind, "kind");
    const auto found = std::ranges::find(kinds, name);
    if (found == kinds.end())
      at(kind, [&] {
        refuse_name("kind of sample", name, kinds, fmt::format("{}", fmt::join(kinds, ", ")));
      });
    Sample sample;
    sample.kind = static_cast<SampleKind>(found - kinds.begin());
    sample.points =
        whole(need(values, "points", "the number of points"), "points", 1, 9007199254740992.0);
    if (const auto* seed = values.get("seed"))
      sample.seed = whole(*seed, "seed", 0, 9007199254740992.0);
    return sample;
  }

  Axis axis_of(const CaseSystems& systems, const std::vector<Parameter>& known,
               const std::string& name, const toml::node& node) const {
    std::vector<std::string> names;
    for (const auto& parameter : known) names.push_back(parameter.name);
    if (std::ranges::find(names, name) == names.end())
      at(node, [&] {
        refuse_name("parameter of " + systems.name, name, names, "clackers show " + systems.name);
      });
    Axis axis;
    axis.name = name;
    if (const auto* range = node.as_table()) {
      read_range(systems, axis, *range);
    } else if (node.is_array()) {
      for (const auto& item : list(node, name)) axis.listed.push_back(value(item, name));
    } else {
      axis.listed = {value(node, name)};
    }
    // Words and numbers in each other's place.
    for (const auto& item : axis.listed)
      at(node, [&] { complete(systems.name, known, {{name, item}}); });
    return axis;
  }
  ParameterValue value(const toml::node& node, const std::string& name) const {
    if (node.is_string()) return word(node, name);
    return number(node, name);
  }
  void read_range(const CaseSystems& systems, Axis& axis, const toml::table& values) const {
    const auto& name = axis.name;
    require_known(values, {"from", "to", "points", "scale"}, " of a range");
    axis.from = number(values, "from", "where the range begins");
    axis.to = number(values, "to", "where the range ends");
    if (const auto* scale = values.get("scale")) {
      const auto text = word(*scale, "scale");
      if (text != "log" && text != "linear")
        fail(*scale, fmt::format("scale = {}; allowed: linear or log.", text), "unknown-name");
      axis.is_log = text == "log";
    }
    if (axis.is_log && !(axis.from > 0.0 && axis.to > 0.0))
      fail(values,
           fmt::format("{} from {} to {}; allowed: above 0 on a log scale.", name, axis.from,
                       axis.to),
           "out-of-range");
    const bool is_grid = systems.sample.kind == SampleKind::grid;
    const auto* points = values.get("points");
    if (!is_grid && points != nullptr)
      fail(*points,
           fmt::format(
               "{} has points of its own; allowed: those of sample, of all ranges together.", name),
           "bad-syntax");
    if (!is_grid) return;
    if (points == nullptr && systems.sample.points == 0)
      fail(
          values,
          fmt::format(
              "the range of {} has no points; allowed: {{ from = {}, to = {}, points = 5 }}, or a sample "
              "beside set.",
              name, axis.from, axis.to),
          "no-column");
    axis.points =
        points == nullptr ? systems.sample.points : whole(*points, "points", 1, 9007199254740992.0);
    if (axis.points == 1 && axis.from != axis.to)
      fail(
          values,
          fmt::format(
              "the range of {} has 1 point and two ends; allowed: 2 points or more, or one number.",
              name),
          "out-of-range");
  }

  // Counted in doubles first: the product may not fit.
  void count(const CaseSystems& added, const toml::table& values) const {
    double product = 1.0;
    std::size_t dimensions = 0;
    const bool is_grid = added.sample.kind == SampleKind::grid;
    for (const auto& axis : added.axes) {
      if (axis.is_range() && !is_grid)
        ++dimensions;
      else
        product *= double(axis.size());
    }
    if (!is_grid && dimensions == 0)
      fail(values,
           fmt::format(
               "{} has a sample and no range; allowed: a range {{ from = 0, to = 1 }} in set.",
               added.name),
           "bad-syntax");
    if (dimensions > most_dimensions)
      fail(values,
           fmt::format("{} ranges are sampled; allowed: up to {}.", dimensions, most_dimensions),
           "out-of-range");
    if (dimensions > 0) product *= double(added.sample.points);
    const double tasks = (double(out_.systems_) + product) * double(out_.methods_.size());
    if (!(tasks <= most_tasks))
      fail(values, fmt::format("{:.3g} tasks with this case; allowed: up to 1e18.", tasks),
           "too-many-runs");
  }

  Specification& out_;
  std::set<std::string> known_;  // names of methods
};

Specification Specification::from_toml(std::string_view text, const std::string& name) {
  Specification specification;
  specification.name_ = name;
  specification.text_ = text;
  SpecificationReader(name, specification).read(toml_from(text, name));
  return specification;
}

Specification Specification::read(const std::string& path) {
  return from_toml(
      read_file(path, "A campaign's specification is a TOML file: clackers campaign --help"), path);
}

}  // namespace clackers::campaign
