#pragma once

#include <string>

#include "clackers/record/record.hpp"

namespace clackers::record {

/// Who computes here and now: version, compiler, machine, processor, date. What the machine
/// does not provide stays "unknown".
Provenance provenance(std::string command);

/// The processor's name in the text of /proc/cpuinfo, or "unknown".
std::string processor_name(const std::string& cpuinfo);

}  // namespace clackers::record
