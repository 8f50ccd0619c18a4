#pragma once

#include <iosfwd>

#include "clackers/report/write.hpp"
#include "clackers/study/case_studies.hpp"

namespace clackers::report {

/// Studies of several cases: the verdict table of each, and below them who solves how many tasks of
/// all cases at which cost; or json. The other formats have no place for several cases: throws
/// std::logic_error.
void write(const study::CaseStudies& studies, Format format, std::ostream& out,
           const Style& style = {});
constexpr bool takes_several_cases(Format format) {
  return format == Format::table || format == Format::json;
}

}  // namespace clackers::report
