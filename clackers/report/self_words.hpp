#pragma once

#include <optional>

#include "clackers/report/digest.hpp"
#include "clackers/study/record.hpp"

namespace clackers::report {

/// What a user without the true motion would have believed and should not: a sentence, and a code
/// that may be empty. Nothing where self-convergence would not have lied.
std::optional<Remark> lie(const study::MethodResult& method);

}  // namespace clackers::report
