#include "clackers/study/case_studies.hpp"

#include <algorithm>

#include "clackers/base/error.hpp"
#include "clackers/study/verify/verify_plan.hpp"

namespace clackers::study {
namespace {

std::vector<VerifyRequest> requests_of(const VerifyRequest& request,
                                       std::span<const std::string> cases) {
  std::vector<VerifyRequest> list;
  for (const auto& name : cases) {
    if (std::ranges::count(cases, name) > 1)
      refuse("verify", "case", name, "each case once", {}, "bad-syntax");
    list.push_back(request);
    list.back().case_name = name;
    plan_of(list.back());  // refuses what cannot be run
  }
  return list;
}

}  // namespace

CaseStudies verify_cases(const VerifyRequest& request, std::span<const std::string> cases,
                         const Progress& progress, const std::atomic<bool>* interrupt) {
  CaseStudies all;
  const auto requests = requests_of(request, cases);
  for (const auto& one : requests) {
    const auto before = double(all.records.size()), count = double(requests.size());
    Progress tell;
    if (progress) tell = [&](double share) { progress((before + share) / count); };
    all.records.push_back(verify(one, tell, interrupt));
  }
  all.profiles = profiles_of(all.records);
  return all;
}

int exit_code(const CaseStudies& studies) {
  for (const int code : {130, 1, 3})
    if (std::ranges::any_of(studies.records,
                            [&](const Record& record) { return exit_code(record) == code; }))
      return code;
  return 0;
}

}  // namespace clackers::study
