#include "bindings/c/guard.hpp"

#include <string>

namespace clackers::c_api {
namespace {

struct LastError {
  std::string kept;
  const char* text = "";
  const char* code = "";
};

thread_local LastError last;

}  // namespace

void forget_error() noexcept {
  last.text = "";
  last.code = "";
}

clackers_status remember_error(clackers_status status, std::string_view text, Code code) noexcept {
  last.code = code.name().data();  // a literal, so it ends with a zero
  try {
    last.kept = text;
    last.text = last.kept.c_str();
  } catch (...) {
    last.text = "clackers: no memory for the text of this error.";
  }
  return status;
}

}  // namespace clackers::c_api

const char* clackers_last_error(void) { return clackers::c_api::last.text; }

const char* clackers_last_error_code(void) { return clackers::c_api::last.code; }
