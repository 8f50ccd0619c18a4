#pragma once

#include <span>
#include <string>

#include "cli/help/reference.hpp"

namespace clackers::cli {

/// The manual page of one of `references` for man(1), in roff. The first of `references` is the
/// program itself; `which` counts them.
std::string manual_page(std::span<const Reference> references, std::size_t which);

/// The name of its file without ".1": "clackers" or "clackers-verify".
std::string manual_page_name(const Reference& reference);

}  // namespace clackers::cli
