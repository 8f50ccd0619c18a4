#pragma once

#include <string_view>

namespace clackers::methods {

/// The card of a method as it stands above its type, taken from the header at build time. The name
/// is the registry's; empty if there is none.
std::string_view card(std::string_view name);

}  // namespace clackers::methods
