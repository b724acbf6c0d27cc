// How long a run may take, with a unit or as on a clock.
#include "io/duration.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace riven {
namespace {

TEST(Duration, IsAQuantityOrAClockTime) {
  EXPECT_EQ(parse_duration("30 min", "here"), 1800);
  EXPECT_EQ(parse_duration("1.5 h", "here"), 5400);
  EXPECT_EQ(parse_duration("90 s", "here"), 90);
  EXPECT_EQ(parse_duration("1:30:05", "here"), 5405);
  EXPECT_EQ(parse_duration("100:00:00", "here"), 360000);
}

TEST(Duration, AnythingElseIsRefusedWithItsPlace) {
  for (const char* bad : {"", "0 s", "-3 min", "0:00:00", "1:60:00", "1:5:00", "1:00:061", "-1:00:00", "1:00", ":00:00",
                          "1:+5:00", "3 kg", "30"})
    try {
      parse_duration(bad, "--wall-limit");
      ADD_FAILURE() << "'" << bad << "' was taken";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Exit::bad_input) << bad;
      EXPECT_EQ(e.trouble().where, "--wall-limit") << bad;
    }
}

}  // namespace
}  // namespace riven
