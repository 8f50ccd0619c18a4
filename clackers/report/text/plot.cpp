#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/text/table.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {
namespace {

constexpr int margin = 10;  // for the numbers of the vertical axis
constexpr int rows = 15;    // of characters, each four dots high and two wide

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

/// Dots of braille characters, and which mass set each character last.
class Canvas {
 public:
  explicit Canvas(int columns) : columns_(columns), cells_(std::size_t(columns * rows)) {}
  int dots_wide() const { return 2 * columns_; }
  static int dots_high() { return 4 * rows; }

  void set(int x, int y, int mass) {
    constexpr int bits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    auto& cell = at(x, y);
    cell.dots |= bits[y % 4][x % 2];
    cell.mass = mass;
  }
  void label(int x, int y, int mass) { at(x, y) = {0, mass, char('1' + mass)}; }

  std::string line(int row, const Style& style) const {
    constexpr TextColor colors[] = {TextColor::blue, TextColor::yellow};
    std::string out;
    for (int c = 0; c < columns_; ++c) {
      const auto& cell = cells_[std::size_t(row * columns_ + c)];
      const auto text = cell.label != 0 ? std::string(1, cell.label) : braille(cell.dots);
      out += cell.mass < 0 ? text : colored(text, colors[cell.mass % 2], style);
    }
    return out.substr(0, out.find_last_not_of(' ') + 1);
  }

 private:
  struct Cell {
    int dots = 0, mass = -1;
    char label = 0;
  };

  Cell& at(int x, int y) { return cells_[std::size_t(y / 4 * columns_ + x / 2)]; }

  // Braille patterns start at U+2800; the last byte of UTF-8 holds six of the eight dots.
  static std::string braille(int dots) {
    if (dots == 0) return " ";
    return {char(0xE2), char(0xA0 + (dots >> 6)), char(0x80 + (dots & 0x3F))};
  }

  int columns_;
  std::vector<Cell> cells_;
};

int dot_of(double value, const Range& range, int dots) {
  return int(std::lround((value - range.lo) / (range.hi - range.lo) * (dots - 1)));
}

void draw(Canvas& canvas, const std::vector<double>& t, const std::vector<double>& y, int mass,
          const Range& across, const Range& up) {
  const auto x_of = [&](double time) { return dot_of(time, across, canvas.dots_wide()); };
  const auto y_of = [&](double u) {
    return Canvas::dots_high() - 1 - dot_of(u, up, Canvas::dots_high());
  };
  for (std::size_t next = 1; next < t.size(); ++next) {
    const auto i = next - 1;
    const int x0 = x_of(t[i]), x1 = x_of(t[next]), y0 = y_of(y[i]), y1 = y_of(y[next]);
    const int parts = std::max({std::abs(x1 - x0), std::abs(y1 - y0), 1});
    for (int k = 0; k <= parts; ++k)
      canvas.set(x0 + (x1 - x0) * k / parts, y0 + (y1 - y0) * k / parts, mass);
  }
}

// Digits on the curves: the masses take turns along the axis.
void label(Canvas& canvas, const std::vector<double>& t, const std::vector<std::vector<double>>& y,
           const Range& across, const Range& up) {
  constexpr int dots_apart = 24;
  std::size_t i = 0;
  for (int x = dots_apart / 2, turn = 0; x < canvas.dots_wide(); x += dots_apart, ++turn) {
    while (i + 1 < t.size() && dot_of(t[i], across, canvas.dots_wide()) < x) ++i;
    const auto mass = std::size_t(turn) % y.size();
    const int row = Canvas::dots_high() - 1 - dot_of(y[mass][i], up, Canvas::dots_high());
    canvas.label(x, row, int(mass));
  }
}

std::string axis(const Range& across, std::span<const double> impact_times, int columns) {
  std::vector<std::string> cells(std::size_t(columns), "─");
  for (const double t : impact_times)
    if (t >= across.lo && t <= across.hi) cells[std::size_t(dot_of(t, across, columns))] = "▲";
  std::string out = std::string(margin - 1, ' ') + "└";
  for (const auto& cell : cells) out += cell;
  return out;
}

std::string tick_labels(const Range& across, int columns) {
  constexpr int ticks = 4;
  std::string out(std::size_t(margin + columns), ' ');
  for (int k = 0; k <= ticks; ++k) {
    const double value = across.lo + (across.hi - across.lo) * k / ticks;
    const auto text = short_number(value, 4) + (k == ticks ? " s" : "");
    const int centre = margin + (columns - 1) * k / ticks - int(text.size()) / 2;
    const int last = int(out.size()) - int(text.size());
    out.replace(std::size_t(std::clamp(centre, 0, last)), text.size(), text);
  }
  return out;
}

void require_curves(const study::Curve& response) {
  bool fits = response.t.size() >= 2 && !response.y.empty() && response.y.size() <= 9;
  for (const auto& y : response.y) fits = fits && y.size() == response.t.size();
  if (!fits)
    refuse("plot", "response",
           fmt::format("{} times, {} masses", response.t.size(), response.y.size()),
           "at least two times and one to nine masses with a value a time", {}, "wrong-size");
}

}  // namespace

std::string plot(const study::Curve& response, std::span<const double> impact_times,
                 const Style& style) {
  require_curves(response);
  const int columns = std::max(style.width, margin + 20) - margin;
  const Range across{response.t.front(), response.t.back()};
  Range up = range_of(response.y);
  if (!(up.hi > up.lo)) up = {up.lo - 1.0, up.lo + 1.0};  // a motion at rest stands in the middle

  Canvas canvas(columns);
  for (std::size_t mass = response.y.size(); mass-- > 0;)
    draw(canvas, response.t, response.y[mass], int(mass), across, up);
  label(canvas, response.t, response.y, across, up);

  std::string title = "u [m] against t [s]; 1: mass 1";
  if (response.y.size() > 1) title += ", 2: mass 2";
  if (!impact_times.empty()) title += "; ▲ collision";
  std::string out;
  for (const auto& line : wrap(title, std::size_t(columns)))
    out += std::string(margin, ' ') + line + '\n';
  for (int row = 0; row < rows; ++row) {
    std::string number;
    if (row % 7 == 0) {
      const double share = double(row) / (rows - 1);
      const double value = up.hi + (up.lo - up.hi) * share;
      // The middle of a symmetric axis is zero up to rounding.
      const bool zero = std::abs(value) < 1e-12 * std::max(std::abs(up.lo), std::abs(up.hi));
      number = (zero ? "0" : short_number(value, 3, margin - 4)) + " m";
    }
    out += pad(number, margin - 2, true) + (number.empty() ? " │" : " ┤") +
           canvas.line(row, style) + '\n';
  }
  return out + axis(across, impact_times, columns) + '\n' + tick_labels(across, columns) + '\n';
}

}  // namespace clackers::report
