#pragma once

#include <string>
#include <string_view>
#include <vector>
#define TOML_HEADER_ONLY 1
#include <toml++/toml.h>

#include "clackers/base/error.hpp"

namespace clackers {

/// Parses TOML; `name` stands in messages, with the line. Throws InputError (bad-syntax).
toml::table toml_from(std::string_view text, const std::string& name);

/// Takes values out of parsed TOML, and refuses in the words of a place in the file.
class TomlReader {
 public:
  /// `name` is that of the file and outlives the reader.
  explicit TomlReader(const std::string& name) : name_(name) {}

  /// "FILE:LINE"
  std::string place(const toml::node& node) const;
  [[noreturn]] void fail(const toml::node& node, const std::string& sentence, Code code) const;

  /// Throws InputError, with did-you-mean, unless every key of the table is one of these. `where` is
  /// what the table is: " of a contact".
  void require_known(const toml::table& table, const std::vector<std::string>& keys,
                     std::string_view where) const;
  const toml::node& need(const toml::table& table, const char* key, const char* meaning) const;

  /// Finite; a number, or a text such as "1/3".
  double number(const toml::node& node, const std::string& what) const;
  double number(const toml::table& table, const char* key, double standard) const;
  double number(const toml::table& table, const char* key, const char* meaning) const;

  /// One of lowest ... highest.
  long long whole(const toml::node& node, const std::string& what, double lowest,
                  double highest) const;
  /// Not empty.
  std::string word(const toml::node& node, const std::string& what) const;
  bool flag(const toml::node& node, const std::string& what) const;
  /// Of one value or more.
  const toml::array& list(const toml::node& node, const std::string& what) const;
  const toml::table& table(const toml::node& node, const std::string& what,
                           const char* allowed) const;

  /// The tables of [[key]]; nullptr where there are none.
  const toml::array* tables(const toml::table& root, const char* key) const;

  /// What `work` returns; an InputError of it gets the place of the node.
  auto at(const toml::node& node, const auto& work) const {
    try {
      return work();
    } catch (const InputError& error) {
      std::string_view sentence = error.what();
      if (constexpr std::string_view who = "clackers: "; sentence.starts_with(who))
        sentence.remove_prefix(who.size());
      fail(node, std::string(sentence), error.code());
    }
  }

 private:
  const std::string& name_;
};

}  // namespace clackers
