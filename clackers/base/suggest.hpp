#pragma once

#include <span>
#include <string>
#include <string_view>

namespace clackers {

/// The known name nearest to a misspelled one, or an empty string when none is near: edit
/// distance (insert, delete, replace, swap of neighbours), at most a third of the length plus one.
std::string nearest(std::string_view given, std::span<const std::string> known);

/// Throws InputError: `who: no WHAT "given". Did you mean "x"? All names: WHERE_LISTED`.
[[noreturn]] void refuse_name(std::string_view what, std::string_view given,
                              std::span<const std::string> known, std::string_view where_listed);

}  // namespace clackers
