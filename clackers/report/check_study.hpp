#pragma once

#include "clackers/study/check_record.hpp"

namespace clackers::report {

/// Checked histories as a study of one method whose levels are the files, a run each:
/// what figures show of a study they show of histories. Counters, times and the plan of steps are
/// empty, and mean nothing. A history without displacements of all masses is a level without runs.
study::Record as_study(const study::CheckRecord& record);

}  // namespace clackers::report
