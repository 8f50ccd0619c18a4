#include "paper/rendering/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "clackers/base/files/json.hpp"
#include "clackers/base/number.hpp"
#include "clackers/record/reduced_curve.hpp"
#include "clackers/report/markup.hpp"
#include "paper/rendering/assets.hpp"

namespace clackers::paper {
namespace {

using Json = nlohmann::ordered_json;
using Kind = Series::Kind;

// More points than pixels: enough for any print of a panel.
constexpr std::size_t drawn_points = 3000;

// The marker of a legend at the size that lines have there, so that all stand on one line.
constexpr auto disc = "M0.27,0A0.27,0.27,0,1,1,-0.27,0A0.27,0.27,0,1,1,0.27,0";

// A part of page/look.json: fonts, colours and spacing.
const Json& look(const char* part) {
  static const Json all = parse_json(report::fill(assets::look_json, {{"paper", light::paper},
                                                                      {"ink", light::ink},
                                                                      {"muted", light::muted},
                                                                      {"faint", light::faint},
                                                                      {"line", light::line},
                                                                      {"grid", light::grid}}));
  return all.at(part);
}

Json rounded(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(clackers::rounded(value));
  return out;
}

Json scale(const Axis& axis) {
  Json out{{"nice", !std::isfinite(axis.lowest)}};
  if (std::isfinite(axis.lowest)) out["domain"] = {axis.lowest, axis.highest};
  if (axis.logarithmic)
    out["type"] = "log";
  else
    out["zero"] = false;
  return out;
}

// "10⁻⁵".
std::string power_of_ten(int exponent) {
  constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = "10";
  for (const char c : std::to_string(exponent))
    out += c == '-' ? "⁻" : digits.at(std::size_t(c - '0'));
  return out;
}

// The powers of ten in the range of an axis, at most eight, with a Vega expression of their labels.
void add_decades(const Axis& axis, Json& out) {
  const int first = int(std::ceil(std::log10(axis.lowest) - 1e-9));
  const int last = int(std::floor(std::log10(axis.highest) + 1e-9));
  const int every = (last - first) / 8 + 1;
  std::string labels;
  out["values"] = Json::array();
  for (int power = first; power <= last; power += every) {
    out["values"].push_back(std::pow(10.0, power));
    labels += fmt::format("{}'{}'", labels.empty() ? "" : ",", power_of_ten(power));
  }
  out["labelExpr"] =
      fmt::format("[{}][round((log(datum.value) / LN10 - {}) / {})]", labels, first, every);
}

Json position(const Figure& figure, const Axis& axis, bool titled) {
  Json out{{"type", "quantitative"}, {"scale", scale(axis)}};
  if (figure.drawing) {
    out["axis"] = nullptr;
    return out;
  }
  out["axis"] = {{"title", titled ? Json(axis.title) : Json(nullptr)}};
  if (axis.logarithmic)
    add_decades(axis, out["axis"]);
  else
    out["axis"]["gridColor"] = look("zero line");
  return out;
}

// The names of one kind with how they look, each once, in the order of their first appearance: the
// legend and the scales of the whole figure.
struct Looks {
  Json names = Json::array(), colors = Json::array(), dashes = Json::array(),
       widths = Json::array();

  Looks(const Figure& figure, Kind kind) {
    for (const auto& panel : figure.panels)
      for (const auto& series : panel.series)
        if (series.kind == kind && std::ranges::find(names, Json(series.name)) == names.end()) {
          names.push_back(series.name);
          colors.push_back(series.stroke.color);
          dashes.push_back(series.stroke.dash);
          widths.push_back(series.stroke.width);
        }
  }

  Json channel(const Json& range, const Json& legend) const {
    return {{"field", "series"},
            {"type", "ordinal"},
            {"scale", {{"type", "ordinal"}, {"domain", names}, {"range", range}}},
            {"sort", nullptr},
            {"legend", legend}};
  }
};

Json rows_of(const Panel& panel, Kind kind) {
  Json rows = Json::array();
  for (const auto& series : panel.series) {
    if (series.kind != kind) continue;
    auto drawn = record::Curve{series.x, {series.y}};
    if (kind == Kind::line) drawn = record::reduced(drawn, drawn_points);
    rows.push_back({{"series", series.name},
                    {"piece", rows.size()},
                    {"x", rounded(drawn.t)},
                    {"y", rounded(drawn.y.front())}});
  }
  return rows;
}

// What is drawn into a panel, from the back to the front.
class PanelView {
 public:
  PanelView(const Figure& figure, const Panel& panel, bool x_title, bool y_title)
      : panel_(panel),
        x_(position(figure, panel.x, x_title)),
        y_(position(figure, panel.y, y_title)),
        lines_(figure, Kind::line),
        points_(figure, Kind::points),
        drawing_(figure.drawing) {
    x_["field"] = "x";
    y_["field"] = "y";
    // Space for labels such as "1.36".
    if (!drawing_ && !panel.x.logarithmic)
      x_["axis"]["tickCount"] = std::floor(figure.width / 50.0);
  }

  Json layers() const {
    Json out = Json::array();
    add_each(Kind::shape, "shape", "fill", out);
    add_each(Kind::rule, "rule", "stroke", out);
    add_lines(out);
    add_points(out);
    add_each(Kind::text, "text", "fill", out);
    return out;
  }

 private:
  Json layer(const Json& mark, const Json& rows) const {
    return {{"data", {{"values", rows}}},
            {"transform", {{{"flatten", {"x", "y"}}}}},
            {"mark", mark},
            {"encoding", {{"x", x_}, {"y", y_}}}};
  }

  // A layer for each series of a kind, its colour in `channel`.
  void add_each(Kind kind, const char* mark, const char* channel, Json& out) const {
    for (const auto& series : panel_.series) {
      if (series.kind != kind) continue;
      auto view = layer(look(mark), {{{"x", rounded(series.x)}, {"y", rounded(series.y)}}});
      view["mark"][channel] = series.stroke.color;
      if (kind == Kind::shape) {
        view["mark"]["strokeWidth"] = series.stroke.width;
        view["encoding"]["order"] = {{"value", nullptr}};  // in the order of the data
      } else if (kind == Kind::text) {
        view["mark"]["text"] = series.name;
      } else {
        view["transform"] = {{{"flatten", {"x"}}}};
        view["encoding"].erase("y");
      }
      out.push_back(view);
    }
  }

  void add_lines(Json& out) const {
    auto lines = layer(look("lines"), rows_of(panel_, Kind::line));
    if (lines["data"]["values"].empty()) return;
    auto& encoding = lines["encoding"];
    encoding["detail"] = {{"field", "piece"}, {"type", "nominal"}};
    encoding["order"] = {{"value", nullptr}};     // in the order of the data
    const bool alone = lines_.names.size() == 1;  // without a legend, and so without a scale
    const Json legend = drawing_ ? Json(nullptr) : Json(Json::object());
    for (const auto& [channel, range] : {std::pair{"stroke", &lines_.colors},
                                         {"strokeDash", &lines_.dashes},
                                         {"strokeWidth", &lines_.widths}})
      if (alone)
        lines["mark"][channel] = (*range)[0];
      else
        encoding[channel] = lines_.channel(*range, legend);
    out.push_back(lines);
  }

  void add_points(Json& out) const {
    auto points = layer(look("points"), rows_of(panel_, Kind::points));
    if (points["data"]["values"].empty()) return;
    points["encoding"]["fill"] = points_.channel(points_.colors, {{"symbolType", disc}});
    out.push_back(points);
  }

  const Panel& panel_;
  Json x_, y_;
  Looks lines_, points_;
  bool drawing_;
};

std::string heading(const Panel& panel) {
  if (panel.label.empty()) return panel.note;
  return panel.note.empty() ? fmt::format("({})", panel.label)
                            : fmt::format("({})  {}", panel.label, panel.note);
}

Json panel_view(const Figure& figure, std::size_t index) {
  const auto& panels = figure.panels;
  const auto& panel = panels[index];
  const auto columns = std::size_t(figure.columns);
  // Panels of one axis share its title: below the last of a column, left of the first of a row.
  const bool last =
      index + columns >= panels.size() || panels[index + columns].x.title != panel.x.title;
  const bool first = index % columns == 0 || panels[index - 1].y.title != panel.y.title;
  Json view{{"width", figure.width}, {"height", figure.height}};
  if (const auto text = heading(panel); !text.empty()) view["title"] = text;
  if (figure.drawing) view["view"] = {{"stroke", nullptr}};
  view["layer"] = PanelView(figure, panel, last, first).layers();
  return view;
}

}  // namespace

nlohmann::ordered_json specification(const Figure& figure) {
  Json out{{"$schema", "https://vega.github.io/schema/vega-lite/v5.json"},
           {"description", figure.title},
           {"config", look("config")},
           {"columns", figure.columns},
           {"align", "all"},
           {"concat", Json::array()}};
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    out["concat"].push_back(panel_view(figure, i));
  return out;
}

}  // namespace clackers::paper
