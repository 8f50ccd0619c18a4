#include "clackers/input/numbers/python_literal.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"

namespace clackers::input {
namespace {

class LiteralReader {
 public:
  LiteralReader(const std::string& name, std::string_view text) : name_(name), text_(text) {}

  PythonLiteral whole() {
    auto literal = value(0);
    if (peek() != '\0' || at_ < text_.size()) fail();
    return literal;
  }

 private:
  [[noreturn]] void fail() const {
    constexpr std::size_t shown = 40;
    throw InputError(
        fmt::format("{}: byte {} of its header (\"{}\") is not as NumPy writes it: the "
                    "file is damaged. Write it again with numpy.save.",
                    name_, at_, printable(std::string(text_.substr(at_, shown)))),
        "not-an-array");
  }

  // The next character that is no blank; byte 0 at the end.
  char peek() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  void require(char c) {
    if (!take(c)) fail();
  }

  bool take_word(std::string_view word) {
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }

  PythonLiteral value(int depth) {
    constexpr int deepest = 16;
    if (depth > deepest) fail();
    const char c = peek();
    if (c == '\'' || c == '"') return {string()};
    if (c >= '0' && c <= '9') return {number()};
    if (take('(')) return {list(')', depth)};
    if (take('[')) return {list(']', depth)};
    if (take('{')) return {dictionary(depth)};
    if (take_word("True")) return {true};
    if (take_word("False")) return {false};
    fail();
  }

  std::string string() {
    const char quote = text_[at_++];
    std::string characters;
    for (; at_ < text_.size(); ++at_) {
      char c = text_[at_];
      if (c == quote) {
        ++at_;
        return characters;
      }
      if (c == '\\') {
        if (++at_ == text_.size()) break;
        c = text_[at_];
        if (c != '\\' && c != '\'' && c != '"') break;
      }
      characters += c;
    }
    fail();
  }

  long long number() {
    constexpr int most_digits = 18;
    long long number = 0;
    int digits = 0;
    for (; at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9'; ++at_, ++digits) {
      if (digits == most_digits) fail();
      number = 10 * number + (text_[at_] - '0');
    }
    take('L');  // Python 2
    return number;
  }

  PythonLiteral::List list(char end, int depth) {
    PythonLiteral::List items;
    while (!take(end)) {
      items.push_back(value(depth + 1));
      if (take(',')) continue;
      require(end);
      break;
    }
    return items;
  }

  PythonLiteral::Dictionary dictionary(int depth) {
    PythonLiteral::Dictionary items;
    while (!take('}')) {
      if (const char c = peek(); c != '\'' && c != '"') fail();
      items.keys.push_back(string());
      require(':');
      items.values.push_back(value(depth + 1));
      if (take(',')) continue;
      require('}');
      break;
    }
    return items;
  }

  const std::string& name_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

PythonLiteral read_python_literal(const std::string& name, std::string_view text) {
  return LiteralReader(name, text).whole();
}

}  // namespace clackers::input
