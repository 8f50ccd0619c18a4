#pragma once

namespace clackers::study {

/// Processor time that the calling thread has used [s]; unlike the time of day it does not count
/// what other threads and programs took.
double thread_processor_time();

}  // namespace clackers::study
