#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "bindings/c/scoped_motion.hpp"
#include "clackers/cases/case.hpp"

namespace clackers::c_api {
namespace {

const cases::Settings settings{{"X", 5.0}, {"eta", 0.875}};

ScopedMotion sample_pair() { return make_case("synchronized-pair", {{"X", 5.0}, {"eta", 0.875}}); }
const model::Motion& reference() {
  static const auto test_case = cases::make("synchronized-pair", settings);
  return *test_case.motion;
}

TEST(CSample, SizesAreThoseOfTheMotion) {
  std::int32_t dof = 0;
  double end = 0.0;
  EXPECT_EQ(clackers_motion_dof(sample_pair().get(), &dof), CLACKERS_OK);
  EXPECT_EQ(clackers_motion_end(sample_pair().get(), &end), CLACKERS_OK);
  EXPECT_EQ(dof, 2);
  EXPECT_EQ(end, 20.0);
  EXPECT_EQ(clackers_motion_dof(make_case("sdof").get(), &dof), CLACKERS_OK);
  EXPECT_EQ(dof, 1);
}

TEST(CSample, StatesAreThoseOfTheLibraryOnBothSidesOfAnImpact) {
  const std::array times{3.0, reference().impact(2).t, 0.0};
  for (const auto side : {CLACKERS_LEFT, CLACKERS_RIGHT}) {
    Arrays arrays(6);
    ASSERT_EQ(clackers_motion_sample(sample_pair().get(), times.data(), 3, side, &arrays.out),
              CLACKERS_OK)
        << clackers_last_error();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto now =
          reference().at(times[i], side == CLACKERS_LEFT ? model::Side::left : model::Side::right);
      for (int j = 0; j < 2; ++j) {
        const auto at = 2 * i + std::size_t(j);
        EXPECT_EQ(arrays.u[at], now.u[j]);
        EXPECT_EQ(arrays.v[at], now.v[j]);
        EXPECT_EQ(arrays.a[at], now.a[j]);
      }
    }
  }
}

TEST(CSample, AccelerationMayBeLeftOut) {
  const double t = 1.0;
  Arrays arrays(2);
  arrays.out.a = nullptr;
  EXPECT_EQ(clackers_motion_sample(sample_pair().get(), &t, 1, CLACKERS_LEFT, &arrays.out),
            CLACKERS_OK);
  EXPECT_EQ(arrays.v[1], reference().at(t, model::Side::left).v[1]);
  EXPECT_EQ(clackers_motion_envelope(sample_pair().get(), t, &arrays.out), CLACKERS_OK);
  EXPECT_EQ(arrays.a[0], 7.0);
}

TEST(CSample, OnlyWhatWasAskedForIsWritten) {
  const double t = 1.0;
  Arrays arrays(4);
  EXPECT_EQ(clackers_motion_sample(sample_pair().get(), &t, 1, CLACKERS_LEFT, &arrays.out),
            CLACKERS_OK);
  EXPECT_NE(arrays.u[1], 7.0);
  for (const auto* x : {&arrays.u, &arrays.v, &arrays.a}) {
    EXPECT_EQ((*x)[2], 7.0);
    EXPECT_EQ((*x)[3], 7.0);
  }
}

TEST(CSample, NoTimesNeedNoArrays) {
  const clackers_buffers none{sizeof none, 0, nullptr, nullptr, nullptr};
  EXPECT_EQ(clackers_motion_sample(sample_pair().get(), nullptr, 0, CLACKERS_LEFT, &none),
            CLACKERS_OK);
}

TEST(CSample, EnvelopeAndBoundAreThoseOfTheLibrary) {
  Arrays envelope(2), bound(2);
  ASSERT_EQ(clackers_motion_envelope(sample_pair().get(), 3.0, &envelope.out), CLACKERS_OK);
  ASSERT_EQ(clackers_motion_error_bound(sample_pair().get(), 3.0, &bound.out), CLACKERS_OK);
  for (int j = 0; j < 2; ++j) {
    const auto at = std::size_t(j);
    EXPECT_EQ(envelope.u[at], reference().envelope(3.0).u[j]);
    EXPECT_EQ(envelope.v[at], reference().envelope(3.0).v[j]);
    EXPECT_EQ(envelope.a[at], reference().envelope(3.0).a[j]);
    EXPECT_EQ(bound.u[at], reference().error_bound(3.0).u[j]);
    EXPECT_EQ(bound.v[at], reference().error_bound(3.0).v[j]);
    EXPECT_EQ(bound.a[at], reference().error_bound(3.0).a[j]);
  }
}

void expect_sample_refused(clackers_status status, const std::string& text,
                           const std::string& code) {
  EXPECT_EQ(status, CLACKERS_REFUSED);
  EXPECT_EQ(clackers_last_error(), text);
  EXPECT_EQ(clackers_last_error_code(), code);
}

TEST(CSample, TimesOutsideTheMotionAreRefused) {
  const auto motion = sample_pair();
  Arrays arrays(2);
  const auto refused = [](clackers_status status, const char* code) {
    EXPECT_EQ(status, CLACKERS_REFUSED);
    EXPECT_STREQ(clackers_last_error_code(), code);
  };
  for (const auto& [t, code] :
       {std::pair(-1.0, "time-outside"), std::pair(20.5, "time-outside"),
        std::pair(double(NAN), "not-a-number"), std::pair(double(INFINITY), "not-finite")}) {
    refused(clackers_motion_sample(motion.get(), &t, 1, CLACKERS_LEFT, &arrays.out), code);
    refused(clackers_motion_envelope(motion.get(), t, &arrays.out), code);
    refused(clackers_motion_error_bound(motion.get(), t, &arrays.out), code);
    EXPECT_EQ(arrays.u[0], 7.0);
  }
  expect_sample_refused(clackers_motion_envelope(motion.get(), NAN, &arrays.out),
                        "motion: t = nan; allowed: 0 <= t <= 20 (the end of the motion, in s).",
                        "not-a-number");
}

TEST(CSample, ArraysThatAreTooSmallAreRefused) {
  const std::array times{1.0, 2.0};
  Arrays arrays(4);
  arrays.out.capacity = 3;
  expect_sample_refused(
      clackers_motion_sample(sample_pair().get(), times.data(), 2, CLACKERS_LEFT, &arrays.out),
      "clackers_motion_sample: out->capacity = 3; allowed: at least 2 x 2, the number of times and "
      "of masses.",
      "wrong-size");
  // A count whose product with the number of masses would wrap around.
  const auto huge = std::numeric_limits<std::size_t>::max() / 2 + 2;
  EXPECT_EQ(
      clackers_motion_sample(sample_pair().get(), times.data(), huge, CLACKERS_LEFT, &arrays.out),
      CLACKERS_REFUSED);
  EXPECT_STREQ(clackers_last_error_code(), "wrong-size");
  arrays.out.capacity = 1;
  EXPECT_EQ(clackers_motion_envelope(sample_pair().get(), 1.0, &arrays.out), CLACKERS_REFUSED);
  EXPECT_EQ(clackers_motion_error_bound(sample_pair().get(), 1.0, &arrays.out), CLACKERS_REFUSED);
  EXPECT_EQ(arrays.u[0], 7.0);
}

TEST(CSample, SidesAreLeftOrRight) {
  const double t = 1.0;
  Arrays arrays(2);
  expect_sample_refused(clackers_motion_sample(sample_pair().get(), &t, 1, 2, &arrays.out),
                        "clackers_motion_sample: side = 2; allowed: 0 (CLACKERS_LEFT) or 1 "
                        "(CLACKERS_RIGHT).",
                        "out-of-range");
}

TEST(CSample, NullPointersAreNamed) {
  const auto motion = sample_pair();
  const double t = 1.0;
  Arrays arrays(2), no_u(2), no_v(2);
  no_u.out.u = nullptr;
  no_v.out.v = nullptr;
  const auto refused = [](clackers_status status, const std::string& where) {
    expect_sample_refused(status, where + " = NULL; allowed: a valid pointer.", "null-pointer");
  };
  const auto* const m = motion.get();
  refused(clackers_motion_dof(nullptr, nullptr), "clackers_motion_dof: motion");
  refused(clackers_motion_dof(m, nullptr), "clackers_motion_dof: dof");
  refused(clackers_motion_end(nullptr, nullptr), "clackers_motion_end: motion");
  refused(clackers_motion_end(m, nullptr), "clackers_motion_end: end");
  const std::string sample = "clackers_motion_sample: ";
  refused(clackers_motion_sample(nullptr, &t, 1, 0, &arrays.out), sample + "motion");
  refused(clackers_motion_sample(m, nullptr, 1, 0, &arrays.out), sample + "times");
  refused(clackers_motion_sample(m, &t, 1, 0, nullptr), sample + "out");
  refused(clackers_motion_sample(m, &t, 1, 0, &no_u.out), sample + "out->u");
  refused(clackers_motion_sample(m, &t, 1, 0, &no_v.out), sample + "out->v");
  refused(clackers_motion_envelope(nullptr, t, &arrays.out), "clackers_motion_envelope: motion");
  refused(clackers_motion_envelope(m, t, nullptr), "clackers_motion_envelope: out");
  refused(clackers_motion_error_bound(nullptr, t, &arrays.out),
          "clackers_motion_error_bound: motion");
  refused(clackers_motion_error_bound(m, t, nullptr), "clackers_motion_error_bound: out");
}

}  // namespace
}  // namespace clackers::c_api
