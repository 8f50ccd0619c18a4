#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/file/file_sample.hpp"

namespace clackers::diagnose {

// If columns or the unit of time are wrong, no other cause is tested.
std::vector<Diagnosis> file_causes(const DiagnosisInput& question) {
  const auto files = samples_of(question);
  if (files.empty()) return {};
  if (auto causes = reading_causes(files); !causes.empty()) return causes;
  auto causes = time_causes(files);
  if (!causes.empty() && causes.front().code == "time-unit") return causes;
  for (auto& family : {output_causes(files, question), velocity_causes(files, question),
                       number_causes(files), row_causes(files, question)})
    causes.insert(causes.end(), family.begin(), family.end());
  return causes;
}

}  // namespace clackers::diagnose
