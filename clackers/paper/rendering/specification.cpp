#include "clackers/paper/rendering/specification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "clackers/paper/rendering/assets.hpp"
#include "clackers/report/figure_data.hpp"

namespace clackers::paper {
namespace {

using Json = nlohmann::ordered_json;
using Kind = Series::Kind;

// More points than pixels: enough for any print of a panel.
constexpr std::size_t drawn_points = 3000;

// The marker of a legend at the size that lines have there, so that all stand on one line.
constexpr auto disc = "M0.27,0A0.27,0.27,0,1,1,-0.27,0A0.27,0.27,0,1,1,0.27,0";

Json rounded(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double value : values) {
    const auto text = fmt::format("{:.6g}", value);
    double number = value;  // std::stod would throw for subnormal numbers
    std::from_chars(text.data(), text.data() + text.size(), number);
    out.push_back(number);
  }
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
    out["axis"]["gridColor"] = {
        {"condition", {{"test", "datum.value === 0"}, {"value", light::faint}}},
        {"value", light::grid}};
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
    auto drawn = study::Curve{series.x, {series.y}};
    if (kind == Kind::line) drawn = report::reduced(drawn, drawn_points);
    rows.push_back({{"series", series.name},
                    {"piece", rows.size()},
                    {"x", rounded(drawn.t)},
                    {"y", rounded(drawn.y.front())}});
  }
  return rows;
}

class PanelView {
 public:
  PanelView(const Figure& figure, const Panel& panel, bool x_title, bool y_title)
      : panel_(panel),
        x_(position(figure, panel.x, x_title)),
        y_(position(figure, panel.y, y_title)),
        lines_(figure, Kind::line),
        points_(figure, Kind::points),
        drawing_(figure.drawing) {
    // Space for labels such as "1.36".
    if (!drawing_ && !panel.x.logarithmic)
      x_["axis"]["tickCount"] = std::floor(figure.width / 50.0);
  }

  Json layers() const {
    Json out = Json::array();
    for (const auto& series : panel_.series)
      if (series.kind == Kind::shape) out.push_back(shape(series));
    for (const auto& series : panel_.series)
      if (series.kind == Kind::rule) out.push_back(rule(series));
    add_lines(out);
    add_points(out);
    for (const auto& series : panel_.series)
      if (series.kind == Kind::text) out.push_back(text(series));
    return out;
  }

 private:
  Json with(Json axis, const char* field) const {
    axis["field"] = field;
    return axis;
  }

  Json layer(Kind kind, Json mark) const {
    mark["clip"] = true;
    return {{"data", {{"values", rows_of(panel_, kind)}}},
            {"transform", {{{"flatten", {"x", "y"}}}}},
            {"mark", mark},
            {"encoding", {{"x", with(x_, "x")}, {"y", with(y_, "y")}}}};
  }

  void add_lines(Json& out) const {
    auto lines = layer(Kind::line, {{"type", "line"}, {"strokeCap", "butt"}});
    if (lines["data"]["values"].empty()) return;
    auto& encoding = lines["encoding"];
    encoding["detail"] = {{"field", "piece"}, {"type", "nominal"}};
    encoding["order"] = {{"value", nullptr}};  // in the order of the data
    if (lines_.names.size() == 1) {
      // Alone it needs no legend, and so no scale.
      lines["mark"].update({{"stroke", lines_.colors[0]},
                            {"strokeDash", lines_.dashes[0]},
                            {"strokeWidth", lines_.widths[0]}});
    } else {
      const Json legend = drawing_ ? Json(nullptr) : Json(Json::object());
      encoding["stroke"] = lines_.channel(lines_.colors, legend);
      encoding["strokeDash"] = lines_.channel(lines_.dashes, legend);
      encoding["strokeWidth"] = lines_.channel(lines_.widths, legend);
    }
    out.push_back(lines);
  }

  void add_points(Json& out) const {
    auto points = layer(Kind::points, {{"type", "point"},
                                       {"shape", "circle"},
                                       {"size", 34},
                                       {"opacity", 1},
                                       {"strokeWidth", 1},
                                       {"stroke", light::paper}});
    if (points["data"]["values"].empty()) return;
    points["encoding"]["fill"] = points_.channel(points_.colors, {{"symbolType", disc}});
    out.push_back(points);
  }

  Json rule(const Series& series) const {
    return {{"data", {{"values", {{{"x", rounded(series.x)}}}}}},
            {"transform", {{{"flatten", {"x"}}}}},
            {"mark",
             {{"type", "rule"},
              {"clip", true},
              {"stroke", series.stroke.color},
              {"strokeDash", {2, 3}}}},
            {"encoding", {{"x", with(x_, "x")}}}};
  }

  Json shape(const Series& series) const {
    Json rows{{{"x", rounded(series.x)}, {"y", rounded(series.y)}}};
    return {{"data", {{"values", rows}}},
            {"transform", {{{"flatten", {"x", "y"}}}}},
            {"mark",
             {{"type", "line"},
              {"interpolate", "linear-closed"},
              {"fill", series.stroke.color},
              {"stroke", light::ink},
              {"strokeWidth", series.stroke.width}}},
            {"encoding",
             {{"x", with(x_, "x")}, {"y", with(y_, "y")}, {"order", {{"value", nullptr}}}}}};
  }

  Json text(const Series& series) const {
    return {{"data", {{"values", {{{"x", series.x.front()}, {"y", series.y.front()}}}}}},
            {"mark",
             {{"type", "text"},
              {"text", series.name},
              {"fontSize", 12.5},
              {"fill", series.stroke.color}}},
            {"encoding", {{"x", with(x_, "x")}, {"y", with(y_, "y")}}}};
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

// Fonts, colours and spacing of all figures.
Json configuration() {
  return {{"background", light::paper},
          {"font", "\"Liberation Sans\", Arial, Helvetica, \"DejaVu Sans\", sans-serif"},
          {"padding", 12},
          {"view", {{"stroke", light::line}}},
          {"concat", {{"spacing", 16}}},
          {"axis",
           {{"domainColor", light::faint},
            {"tickColor", light::faint},
            {"gridColor", light::grid},
            {"labelColor", light::muted},
            {"titleColor", light::ink},
            {"labelFontSize", 12},
            {"titleFontSize", 12.5},
            {"titleFontWeight", "normal"},
            {"titlePadding", 8},
            {"labelPadding", 4},
            {"labelFlush", false}}},
          {"title",
           {{"color", light::ink},
            {"fontSize", 13},
            {"fontWeight", "normal"},
            {"anchor", "start"},
            {"frame", "group"},
            {"offset", 6}}},
          {"legend",
           {{"orient", "top"},
            {"direction", "horizontal"},
            {"title", nullptr},
            {"labelColor", light::ink},
            {"labelFontSize", 12.5},
            {"labelLimit", 420},
            {"symbolType", "stroke"},
            {"symbolSize", 700},
            {"columnPadding", 24},
            {"offset", 10}}}};
}

}  // namespace

nlohmann::ordered_json specification(const Figure& figure) {
  Json out{{"$schema", "https://vega.github.io/schema/vega-lite/v5.json"},
           {"description", figure.title},
           {"config", configuration()},
           {"columns", figure.columns},
           {"align", "all"},
           {"concat", Json::array()}};
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    out["concat"].push_back(panel_view(figure, i));
  return out;
}

}  // namespace clackers::paper
