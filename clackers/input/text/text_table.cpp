#include "clackers/input/text/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "clackers/base/error.hpp"
#include "clackers/base/number.hpp"

namespace clackers::input {
namespace {

// Of seconds, steps and evaluations.
constexpr double most_stated = 1e15;

constexpr auto decimal_comma_hint =
    "Are the commas decimal? Numbers take a decimal point; write the file again with points.";

std::vector<std::string> plain_names(const Separation& separation, std::string_view line) {
  std::vector<std::string_view> fields;
  separation.split(line, fields);
  std::vector<std::string> names;
  names.reserve(fields.size());
  // Between blanks the unit of "t [s]" is a field of its own.
  for (const auto field : fields)
    if (names.empty() || !field.starts_with('[')) names.push_back(plain_name(field));
  return names;
}

bool has_a_number(std::string_view line) {
  std::vector<std::string_view> fields;
  Separation::of(line).split(line, fields);
  return std::ranges::any_of(fields, looks_numeric);
}

// A row of decimal commas separated by blanks is taken for fields such as "05 1" between commas.
bool has_inner_blank(std::string_view field) {
  return field.find_first_of(" \t") != std::string_view::npos;
}

}  // namespace

TextTable::TextTable(InputFile file, const std::vector<std::string>& names, TableKind kind)
    : Table(file.name()), kind_(kind), lines_(std::move(file)), separation_(Separation::of("")) {
  std::optional<std::string> header;
  row_is_waiting_ = next_content();
  if (row_is_waiting_ && !has_a_number(lines_.text())) {
    header = lines_.text();
    row_is_waiting_ = next_content();
  }
  if (!row_is_waiting_ && (!header || kind == TableKind::history))
    throw InputError(name() + (header ? " has a header and no rows" : " is empty") +
                         "; allowed: rows of numbers.",
                     "too-short");
  separation_ = Separation::of(row_is_waiting_ ? lines_.text() : std::string_view(*header));
  separation_.split(lines_.text(), fields_);
  name_columns(names, header);
  if (row_is_waiting_) require_fields();
}

// The next line with something on it; remembers the last comment until the first row.
bool TextTable::next_content() {
  while (lines_.next()) {
    if (!trimmed(lines_.text()).empty()) return true;
    if (!trimmed(lines_.comment()).empty())
      (names().empty() ? comment_ : last_comment_) = lines_.comment();
  }
  return false;
}

bool TextTable::comment_names_columns(std::vector<std::string>& names) {
  names = plain_names(separation_, comment_);
  const auto is_known = [](const std::string& name) {
    return name == "t" || name == "time" || name == "u1" || name == "u";
  };
  from_comment_ = names.size() == fields_.size() && std::ranges::any_of(names, is_known);
  return from_comment_;
}

void TextTable::name_columns(const std::vector<std::string>& given,
                             const std::optional<std::string>& header) {
  const bool events = kind_ == TableKind::events;
  std::vector<std::string> names;
  if (!given.empty()) {
    for (const auto& name : given) names.push_back(plain_name(name));
  } else if (header) {
    names = plain_names(separation_, *header);
  } else if (!comment_names_columns(names)) {
    names.clear();
    if (events && fields_.size() == 1) names.emplace_back("t");
  }
  if (names.empty()) {
    const bool is_decimal = separation_.is_comma() && std::ranges::any_of(fields_, has_inner_blank);
    throw InputError(
        fmt::format("{}: {} columns of numbers have no names; {}.{}{}", place(), fields_.size(),
                    events ? "name them in a header line, the times t"
                           : "name them in a header line or with --columns, for example "
                             "--columns t,u1,v1 (_ skips one)",
                    is_decimal ? " " : "", is_decimal ? decimal_comma_hint : ""),
        "no-column");
  }
  set_names(std::move(names));
}

void TextTable::require_fields() const {
  if (fields_.size() == names().size()) return;
  std::string_view hint;
  // Decimal commas make fields, and never fewer.
  if (fields_.size() > names().size() && separation_.is_comma())
    hint = decimal_comma_hint;
  else if (lines_.ends_without_line_feed())
    hint =
        "The file ends without a line feed: it may have been cut here, or is still being written.";
  throw InputError(
      fmt::format("{} has {} fields; allowed: {}, one for each named column.{}{}", place(),
                  fields_.size(), names().size(), hint.empty() ? "" : " ", hint),
      "ragged-row");
}

bool TextTable::next() {
  if (row_is_waiting_) {
    row_is_waiting_ = false;
    ++rows_;
    return true;
  }
  if (!next_content()) return false;
  separation_.split(lines_.text(), fields_);
  require_fields();
  ++rows_;
  return true;
}

void TextTable::read_number(std::size_t column, Number& number) {
  const auto text = fields_[column];
  auto error = read_decimal(text, number);
  if (error == NumberError::no_number) {  // "1/9" has all digits
    error = clackers::read_number(text, number.value);
    number.digits = std::numeric_limits<double>::max_digits10;
  }
  if (error == NumberError::none) return;
  const auto who = place();
  const auto quoted = fmt::format("\"{}\"", text);
  if (error == NumberError::decimal_comma || (separation_.is_comma() && has_inner_blank(text)))
    refuse(who, names()[column], quoted, "a number with a decimal point", decimal_comma_hint,
           "decimal-comma");
  if (error == NumberError::not_finite) refuse_not_finite(column, quoted);
  refuse(who, names()[column], quoted, "a number with a decimal point such as 0.05 or 5e-2", {},
         "not-a-number");
}

RowSide TextTable::side(std::size_t column) const {
  const auto text = fields_[column];
  return text == "-" ? RowSide::before : text == "+" ? RowSide::after : RowSide::none;
}

std::size_t TextTable::expected_rows() const {
  constexpr std::size_t rows_before_guess = 1000;
  const auto size = lines_.file_size(), consumed = lines_.consumed();
  if (rows_ < rows_before_guess || size <= consumed) return 0;
  return static_cast<std::size_t>(1.02 * double(rows_) * double(size) / double(consumed));
}

double TextTable::share() const {
  const auto size = lines_.file_size();
  return size > 0 ? double(lines_.consumed()) / double(size) : 0.0;
}

std::vector<Note> TextTable::notes() const {
  std::vector<Note> notes;
  if (from_comment_) notes.push_back({.code = "columns-from-comment"});
  if (lines_.ends_without_line_feed())
    notes.push_back({.code = "last-line-incomplete", .numbers = {double(lines_.number())}});
  return notes;
}

StatedCost TextTable::cost() const {
  StatedCost cost;
  std::istringstream words(last_comment_);
  std::string name, text;
  while (words >> name >> text) {
    auto* value = name == "seconds"       ? &cost.seconds
                  : name == "steps"       ? &cost.steps
                  : name == "evaluations" ? &cost.evaluations
                                          : nullptr;
    const auto number = finite_number(text);
    if (value == nullptr || !number || !(*number >= 0.0 && *number <= most_stated)) return {};
    *value = *number;
  }
  return cost;
}

}  // namespace clackers::input
