#include <fmt/format.h>

#include <cmath>

#include "clackers/base/codes.hpp"
#include "clackers/report/digest.hpp"
#include "clackers/report/html_parts.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/self_words.hpp"

namespace clackers::report {
namespace {

std::string fact(std::string_view name, const std::string& html) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, html);
}

std::string order_cell(const assess::LadderFit& fit) {
  const auto found = std::string(to_string(fit.behaviour));
  return fit.has_line ? fmt::format("{}, {}", escape(order_text(fit, "\u202f")), found) : found;
}

std::string extrapolation(const study::SelfResult& result) {
  const auto& found = result.extrapolation;
  if (!found.bounded) {
    const auto* code = find_code(found.reason);
    return fmt::format("no bound. {} <span class=\"code\">[{}]</span>",
                       escape(code == nullptr ? found.sentence : code->meaning),
                       escape(found.reason));
  }
  std::string values;
  for (const double value : found.value)
    values += (values.empty() ? "" : ", ") + html_number(value, 10);
  return fmt::format(
      "u / initial envelope at the end = {}, within {} of the limit of the runs; in reference {} off{}",
      values, html_scientific(found.bound), html_scientific(result.extrapolation_error),
      result.extrapolation_error > found.bound ? ": the limit is not the true motion" : "");
}

// What is found with and without the reference; where it ends with a warning, that stands above.
std::string findings(const study::MethodResult& method) {
  const auto& whole = method.self_convergence->against_reference.sentence;
  const auto said = lie(method);
  if (!said || !whole.ends_with(said->sentence)) return whole;
  return whole.substr(0, whole.size() - said->sentence.size());
}

}  // namespace

std::string self_html(const study::MethodResult& method) {
  if (method.ladder.empty()) return {};
  std::string out = "<h4>Without the exact solution</h4>\n";
  if (!method.self_convergence)
    return out +
           "<p>Not judged: the method claims no order that differences between runs could be held "
           "to.</p>\n";
  const auto& result = *method.self_convergence;
  if (const auto said = lie(method)) {
    const auto code = said->code.empty()
                          ? ""
                          : fmt::format(" <span class=\"code\">[{}]</span>", escape(said->code));
    out +=
        fmt::format("<p class=\"notice\" role=\"note\">{}{}</p>\n", escape(said->sentence), code);
  }
  out += fmt::format("<p>{}</p>\n<dl>\n", escape(findings(method)));
  out += fact("Order of differences",
              fmt::format("{}; held to {}", order_cell(result.self.differences),
                          html_number(result.order, 3)));
  out += fact("Order of the same runs' errors", order_cell(result.errors));
  const double ratio = result.against_reference.error_ratio;
  if (!std::isnan(ratio))
    out += fact("Error over its estimate", html_number(ratio, 3) + " at the finest pair of runs");
  out += fact("Extrapolated", extrapolation(result));
  return out + "</dl>\n";
}

}  // namespace clackers::report
