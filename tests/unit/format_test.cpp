#include "core/format.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightbench {
namespace {

TEST(Format, CountsTakePrefixesBeforeTheyRoundToAThousand) {
  EXPECT_EQ(format_count(0), "0");
  EXPECT_EQ(format_count(950, "rays/s"), "950 rays/s");
  EXPECT_EQ(format_count(999.6), "1.00 k");
  EXPECT_EQ(format_count(12'345), "12.3 k");
  EXPECT_EQ(format_count(99'960), "100 k");
  EXPECT_EQ(format_count(4.56e6, "/s"), "4.56 M/s");
  EXPECT_EQ(format_count(7.89e15), "7890 T");
}

TEST(Format, BytesAreBinary) {
  EXPECT_EQ(format_bytes(512), "512 B");
  EXPECT_EQ(format_bytes(1024), "1.00 KiB");
  EXPECT_EQ(format_bytes(115'343'360), "110 MiB");
}

TEST(Format, DurationsFromMillisecondsToHours) {
  EXPECT_EQ(format_duration(0.0123), "12.3 ms");
  EXPECT_EQ(format_duration(0.82), "0.82 s");
  EXPECT_EQ(format_duration(9.996), "10.0 s");
  EXPECT_EQ(format_duration(59.96), "1:00");
  EXPECT_EQ(format_duration(3599.6), "1:00:00");
  EXPECT_EQ(format_duration(7385), "2:03:05");
  EXPECT_EQ(format_duration(-1), "-");
  EXPECT_EQ(format_duration(INFINITY), "-");
}

TEST(Format, WholeNumbersInGroups) {
  EXPECT_EQ(format_integer(7), "7");
  EXPECT_EQ(format_integer(1'234'567), "1 234 567");
  EXPECT_EQ(format_integer(-123'456), "-123 456");
}

}  // namespace
}  // namespace lightbench
