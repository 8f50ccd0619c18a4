#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace clackers {

// JSON text is read and written here only: nlohmann's parser and writer cost seconds of every source
// that compiles them.

/// Called at each value: its depth, and whether an array starts. May throw.
using JsonWatch = std::function<void(int depth, bool starts_array)>;

/// Throws nlohmann::json::exception where `text` is not JSON, InputError (bad-syntax) for an object of
/// more than most_members, among which each is looked for one by one.
inline constexpr int most_members = 1000;
nlohmann::ordered_json parse_json(std::string_view text, const JsonWatch& watch = nullptr);

/// In lines indented by `indent` a level, or without spaces; what is no UTF-8 as U+FFFD.
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

/// Text in quotes, with escapes; what is no UTF-8 as U+FFFD.
std::string json_quoted(std::string_view text);

/// Text with U+FFFD for what is no UTF-8.
std::string valid_utf8(std::string_view text);

}  // namespace clackers
