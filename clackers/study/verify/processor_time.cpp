#include "clackers/study/verify/processor_time.hpp"

#include <time.h>

namespace clackers::study {

double thread_processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

}  // namespace clackers::study
