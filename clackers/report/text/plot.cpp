#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/text/plot.hpp"
#include "clackers/report/text/table.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {
namespace {

constexpr int margin = 10;  // for the numbers of the vertical axis
struct Range {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();
};

Range range_of(const std::vector<std::vector<double>>& curves) {
  Range range;
  for (const auto& curve : curves)
    for (const double y : curve) {
      range.lo = std::min(range.lo, y);
      range.hi = std::max(range.hi, y);
    }
  return range;
}

/// Dots of braille characters, four high and two wide, and which curve set each character last.
class Canvas {
 public:
  Canvas(int columns, int rows)
      : columns_(columns), rows_(rows), cells_(std::size_t(columns * rows)) {}
  int dots_wide() const { return 2 * columns_; }
  int dots_high() const { return 4 * rows_; }

  void set(int x, int y, int curve) {
    constexpr int bits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    auto& cell = at(x, y);
    cell.dots |= bits[y % 4][x % 2];
    cell.curve = curve;
  }
  void label(int x, int y, int curve) { at(x, y) = {0, curve, char('1' + curve)}; }
  bool has_label(int x, int y) { return at(x, y).label != 0; }

  std::string line(int row, const Style& style) const {
    constexpr TextColor colors[] = {TextColor::blue, TextColor::yellow, TextColor::green,
                                    TextColor::red};
    std::string out;
    for (int c = 0; c < columns_; ++c) {
      const auto& cell = cells_[std::size_t(row * columns_ + c)];
      const auto text = cell.label != 0 ? std::string(1, cell.label) : braille(cell.dots);
      out += cell.curve < 0
                 ? text
                 : colored(text, colors[std::size_t(cell.curve) % std::size(colors)], style);
    }
    return out.substr(0, out.find_last_not_of(' ') + 1);
  }

 private:
  struct Cell {
    int dots = 0, curve = -1;
    char label = 0;
  };

  Cell& at(int x, int y) { return cells_[std::size_t(y / 4 * columns_ + x / 2)]; }

  // Braille patterns start at U+2800; the last byte of UTF-8 holds six of the eight dots.
  static std::string braille(int dots) {
    if (dots == 0) return " ";
    return {char(0xE2), char(0xA0 + (dots >> 6)), char(0x80 + (dots & 0x3F))};
  }

  int columns_, rows_;
  std::vector<Cell> cells_;
};

int dot_of(double value, const Range& range, int dots) {
  return int(std::lround((value - range.lo) / (range.hi - range.lo) * (dots - 1)));
}

void draw(Canvas& canvas, const std::vector<double>& x, const std::vector<double>& y, int curve,
          const Range& across, const Range& up) {
  const auto column = [&](double value) { return dot_of(value, across, canvas.dots_wide()); };
  const auto row = [&](double value) {
    return canvas.dots_high() - 1 - dot_of(value, up, canvas.dots_high());
  };
  for (std::size_t next = 1; next < x.size(); ++next) {
    const auto i = next - 1;
    if (std::isnan(y[i]) || std::isnan(y[next])) continue;
    const int x0 = column(x[i]), x1 = column(x[next]), y0 = row(y[i]), y1 = row(y[next]);
    const int parts = std::max({std::abs(x1 - x0), std::abs(y1 - y0), 1});
    for (int k = 0; k <= parts; ++k)
      canvas.set(x0 + (x1 - x0) * k / parts, y0 + (y1 - y0) * k / parts, curve);
  }
}

// Digits on the curves, which take turns along the axis, and at points that no line reaches.
void label(Canvas& canvas, const std::vector<double>& x, const std::vector<std::vector<double>>& y,
           const Range& across, const Range& up) {
  constexpr int dots_apart = 24;
  const auto column = [&](double value) { return dot_of(value, across, canvas.dots_wide()); };
  const auto row = [&](double value) {
    return canvas.dots_high() - 1 - dot_of(value, up, canvas.dots_high());
  };
  std::size_t i = 1;
  for (int dot = dots_apart / 2, turn = 0; dot < canvas.dots_wide(); dot += dots_apart, ++turn) {
    while (i + 1 < x.size() && column(x[i]) < dot) ++i;
    const auto curve = std::size_t(turn) % y.size();
    const double before = y[curve][i - 1], after = y[curve][i];
    if (std::isnan(before) || std::isnan(after)) continue;
    const double share = std::clamp(
        double(dot - column(x[i - 1])) / std::max(column(x[i]) - column(x[i - 1]), 1), 0.0, 1.0);
    canvas.label(dot, row(before + (after - before) * share), int(curve));
  }
  for (std::size_t curve = 0; curve < y.size(); ++curve)
    for (std::size_t point = 0; point < x.size(); ++point) {
      const bool is_reached = (point > 0 && !std::isnan(y[curve][point - 1])) ||
                              (point + 1 < x.size() && !std::isnan(y[curve][point + 1]));
      if (is_reached || std::isnan(y[curve][point])) continue;
      int dot = column(x[point]);
      const int height = row(y[curve][point]), inward = 2 * dot < canvas.dots_wide() ? 2 : -2;
      while (canvas.has_label(dot, height)) dot += inward;  // there are nine curves at most
      canvas.label(dot, height, int(curve));
    }
}

std::string axis(const Range& across, std::span<const double> marks, int columns) {
  std::vector<std::string> cells(std::size_t(columns), "─");
  for (const double x : marks)
    if (x >= across.lo && x <= across.hi) cells[std::size_t(dot_of(x, across, columns))] = "▲";
  std::string out = std::string(margin - 1, ' ') + "└";
  for (const auto& cell : cells) out += cell;
  return out;
}

// A number of an axis; of a logarithmic one, `value` is the power of ten.
std::string tick(double value, bool is_log, int digits, std::size_t width = 32) {
  return short_number(is_log ? std::pow(10.0, value) : value, digits, width);
}

std::string tick_labels(const CharacterPlot& plot, const Range& across, int columns) {
  const double length = across.hi - across.lo;
  double step = length / 4;
  if (plot.whole_x) step = std::max(std::ceil(step), 1.0);
  const int ticks = int(length / step + 1e-9);
  std::string out(std::size_t(margin + columns), ' ');
  for (int k = 0; k <= ticks; ++k) {
    const double value = across.lo + k * step;
    const auto text = tick(value, plot.log_x, 4) + (k == ticks ? plot.x_unit : "");
    const int centre = margin + dot_of(value, across, columns) - int(text.size()) / 2;
    const int last = int(out.size()) - int(text.size());
    out.replace(std::size_t(std::clamp(centre, 0, last)), text.size(), text);
  }
  return out.substr(0, out.find_last_not_of(' ') + 1);
}

void require_curves(const CharacterPlot& plot) {
  bool fits = plot.x.size() >= 2 && !plot.y.empty() && plot.y.size() <= 9;
  for (const auto& y : plot.y) fits = fits && y.size() == plot.x.size();
  if (!fits)
    refuse("plot", "curves", fmt::format("{} points, {} curves", plot.x.size(), plot.y.size()),
           "at least two points and one to nine curves with a value a point", {}, "wrong-size");
}

void take_logarithms(CharacterPlot& plot) {
  const auto log = [](std::vector<double>& values) {
    for (double& value : values) value = std::log10(value);
  };
  if (plot.log_x) log(plot.x), log(plot.marks);
  if (plot.log_y) std::ranges::for_each(plot.y, log);
}

}  // namespace

std::string draw(CharacterPlot plot, const Style& style) {
  require_curves(plot);
  take_logarithms(plot);
  const int columns = std::max(style.width, margin + 20) - margin;
  const Range across{plot.x.front(), plot.x.back()};
  Range up = range_of(plot.y);
  if (!(up.hi - up.lo > plot.least_height)) {  // what does not change stands in the middle
    const double middle = std::isfinite(up.lo) ? 0.5 * (up.lo + up.hi) : 0.0;
    up = {middle - 1.0, middle + 1.0};
  }

  Canvas canvas(columns, plot.rows);
  for (std::size_t curve = plot.y.size(); curve-- > 0;)
    draw(canvas, plot.x, plot.y[curve], int(curve), across, up);
  label(canvas, plot.x, plot.y, across, up);

  std::string out;
  for (const auto& line : wrap(plot.title, std::size_t(columns)))
    out += std::string(margin, ' ') + line + '\n';
  for (int row = 0; row < plot.rows; ++row) {
    std::string number;
    if (row % (plot.rows / 2) == 0) {
      const double share = double(row) / (plot.rows - 1);
      const double value = up.hi + (up.lo - up.hi) * share;
      // The middle of a symmetric axis is zero up to rounding.
      const bool zero = std::abs(value) < 1e-12 * std::max(std::abs(up.lo), std::abs(up.hi));
      number = tick(zero ? 0.0 : value, plot.log_y, 3, margin - 4) + plot.y_unit;
    }
    out += pad(number, margin - 2, true) + (number.empty() ? " │" : " ┤") +
           canvas.line(row, style) + '\n';
  }
  return out + axis(across, plot.marks, columns) + '\n' + tick_labels(plot, across, columns) + '\n';
}

std::string plot(const record::Curve& response, std::span<const double> impact_times,
                 const Style& style) {
  const auto masses = response.y.size(), drawn = std::min(masses, most_drawn_masses);
  CharacterPlot picture{.title = "u [m] against t [s]; 1: mass 1",
                        .x = response.t,
                        .y = {response.y.begin(), response.y.begin() + std::ptrdiff_t(drawn)},
                        .marks = {impact_times.begin(), impact_times.end()},
                        .x_unit = " s",
                        .y_unit = " m"};
  if (masses == 2) picture.title += ", 2: mass 2";
  if (masses > 2) picture.title += fmt::format(", ..., {0}: mass {0}", drawn);
  if (drawn < masses) picture.title += fmt::format(" of {}", masses);
  if (!impact_times.empty()) picture.title += "; ▲ impact";
  return draw(std::move(picture), style);
}

std::string curves(const record::Sheet& sheet, const Style& style) {
  const auto& axes = *sheet.curves;
  CharacterPlot picture{.title = sheet.title + "; across: " + sheet.columns[0].label(),
                        .log_x = axes.log_x,
                        .log_y = axes.log_y,
                        .whole_x = sheet.columns[0].kind == record::ColumnKind::whole,
                        .rows = 9,
                        .least_height = 1e-6};
  const auto number = [](const record::Cell& cell) {
    const auto* value = std::get_if<double>(&cell);
    return value != nullptr ? *value : std::numeric_limits<double>::quiet_NaN();
  };
  for (const auto& row : sheet.rows) picture.x.push_back(number(row[0]));
  for (std::size_t c = 1; c < sheet.columns.size(); ++c) {
    picture.title += fmt::format("{} {}: {}", c == 1 ? ";" : ",", c, sheet.columns[c].label());
    auto& curve = picture.y.emplace_back();
    for (const auto& row : sheet.rows) {
      const double value = number(row[c]);
      curve.push_back(value <= axes.highest ? value : std::numeric_limits<double>::quiet_NaN());
    }
  }
  if (!axes.marks.empty()) {
    picture.marks = axes.marks;
    picture.title += "; ▲ " + axes.mark_text;
  }
  return draw(std::move(picture), style);
}

}  // namespace clackers::report
