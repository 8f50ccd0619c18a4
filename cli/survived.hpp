#pragma once

#include "clackers/base/error.hpp"
#include "cli/messages.hpp"

namespace clackers::cli {

/// Runs `write`; a file that fails is told and must not take other results with it. True when
/// written.
template <class Write>
bool survived(const Write& write) {
  try {
    write();
    return true;
  } catch (const FileError& error) {
    complain(error.what(), error.code().name());
    return false;
  }
}

}  // namespace clackers::cli
