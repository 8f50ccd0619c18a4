#pragma once

// To be included before Highway by every file that compiles kernels, so that all agree on the
// targets: processors with SSSE3 and not SSE4 are served by the path without vectors.
#define HWY_DISABLED_TARGETS HWY_SSSE3
