#pragma once

#include <exception>
#include <new>
#include <string_view>

#include "bindings/c/clackers.h"
#include "clackers/base/error.hpp"

namespace clackers::c_api {

/// Forgets the error of this thread.
void forget_error() noexcept;
/// What clackers_last_error() and clackers_last_error_code() of this thread return from now on.
/// Returns `status`.
clackers_status remember_error(clackers_status status, std::string_view text, Code code) noexcept;

/// Runs `work` and turns whatever it throws into a status and the error of this thread.
clackers_status guarded(const auto& work) noexcept {
  try {
    forget_error();
    work();
    return CLACKERS_OK;
  } catch (const Error& error) {
    return remember_error(CLACKERS_REFUSED, error.what(), error.code());
  } catch (const std::bad_alloc&) {
    return remember_error(CLACKERS_OUT_OF_MEMORY, "clackers: out of memory; ask for less.",
                          "out-of-memory");
  } catch (const std::exception& error) {
    return remember_error(CLACKERS_INTERNAL_ERROR, error.what(), "internal-error");
  } catch (...) {
    return remember_error(CLACKERS_INTERNAL_ERROR, "clackers: an unknown exception.",
                          "internal-error");
  }
}

}  // namespace clackers::c_api
