#pragma once

#include <span>
#include <string>
#include <vector>

#include "clackers/study/verify.hpp"

namespace clackers::study {

/// Studies of the same methods on the same ladder, a case each.
struct CaseStudies {
  static constexpr auto schema = "clackers/verify-cases/1";
  std::vector<Record> records;
  std::vector<Profile> profiles;  ///< over all cases; profiles_of
};

/// Runs verify for each case in turn. Throws InputError before any work for a case that stands
/// twice and for whatever one of the cases cannot take: settings hold for all of them. After an
/// interrupt the cases that follow come back without runs, marked interrupted.
CaseStudies verify_cases(const VerifyRequest& request, std::span<const std::string> cases,
                         const Progress& progress = {},
                         const std::atomic<bool>* interrupt = nullptr);

/// Each record in it is what to_json(record) gives, so that one can be taken out as a baseline.
std::string to_json(const CaseStudies& studies);

/// Of all records: 130, else 1, else 3, else 0.
int exit_code(const CaseStudies& studies);

}  // namespace clackers::study
