#include "clackers/paper/specification_look.hpp"

#include <nlohmann/json.hpp>

namespace clackers::paper {

nlohmann::ordered_json configuration() {
  constexpr auto ink = "var(--ink)", muted = "var(--muted)", faint = "var(--faint)";
  return {{"background", "var(--paper)"},
          {"font", "\"Liberation Sans\", Arial, Helvetica, \"DejaVu Sans\", sans-serif"},
          {"padding", 12},
          {"view", {{"stroke", "var(--line)"}}},
          {"concat", {{"spacing", 16}}},
          {"axis",
           {{"domainColor", faint},
            {"tickColor", faint},
            {"gridColor", "var(--grid)"},
            {"labelColor", muted},
            {"titleColor", ink},
            {"labelFontSize", 12},
            {"titleFontSize", 12.5},
            {"titleFontWeight", "normal"},
            {"titlePadding", 8},
            {"labelPadding", 4},
            {"labelFlush", false}}},
          {"title",
           {{"color", ink},
            {"fontSize", 13},
            {"fontWeight", "normal"},
            {"anchor", "start"},
            {"frame", "group"},
            {"offset", 6}}},
          {"legend",
           {{"orient", "top"},
            {"direction", "horizontal"},
            {"title", nullptr},
            {"labelColor", ink},
            {"labelFontSize", 12.5},
            {"labelLimit", 420},
            {"symbolType", "stroke"},
            {"symbolSize", 700},
            {"columnPadding", 24},
            {"offset", 10}}}};
}

std::string power_label() {
  const std::string exponent = "round(log(datum.value) / LN10)";
  const std::string size = "abs(" + exponent + ")";
  const auto digit = [](const std::string& value) {
    return "substring('⁰¹²³⁴⁵⁶⁷⁸⁹', " + value + ", " + value + " + 1)";
  };
  return "abs(log(datum.value) / LN10 - " + exponent + ") > 1e-9 ? '' : '10' + (" + exponent +
         " < 0 ? '⁻' : '') + (" + size + " >= 10 ? " + digit("floor(" + size + " / 10)") +
         " : '') + " + digit("(" + size + " % 10)");
}

}  // namespace clackers::paper
