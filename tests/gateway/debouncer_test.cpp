#include "gateway/debouncer.h"

#include <gtest/gtest.h>

namespace nplc::gateway {
namespace {

constexpr base::Instant at(int us) {
    return base::Instant(base::Microseconds(us));
}

TEST(Debouncer, FirstReadingIsTakenAsItIs) {
    Debouncer d(base::Milliseconds(3));
    EXPECT_EQ(d.update(0x2A, at(0)), 0x2A);
}

TEST(Debouncer, BitsAboveSixInputsAreIgnored) {
    Debouncer d(base::Milliseconds(3));
    EXPECT_EQ(d.update(0xFF, at(0)), 0x3F);
}

TEST(Debouncer, AChangeCountsOnceItHasBeenSteadyLongEnough) {
    Debouncer d(base::Milliseconds(3));
    d.update(0, at(0));
    EXPECT_EQ(d.update(1, at(1000)), 0);
    EXPECT_EQ(d.update(1, at(3999)), 0);
    EXPECT_EQ(d.update(1, at(4000)), 1);
}

TEST(Debouncer, ABounceStartsItsTimeAnew) {
    Debouncer d(base::Milliseconds(3));
    d.update(0, at(0));
    d.update(1, at(1000));
    d.update(0, at(2000));
    d.update(1, at(3000));
    EXPECT_EQ(d.update(1, at(5999)), 0);
    EXPECT_EQ(d.update(1, at(6000)), 1);
}

TEST(Debouncer, InputsDoNotWaitForEachOther) {
    Debouncer d(base::Milliseconds(3));
    d.update(0b10, at(0));
    d.update(0b11, at(1000));
    d.update(0b01, at(2000));
    EXPECT_EQ(d.update(0b01, at(4000)), 0b11);
    EXPECT_EQ(d.update(0b01, at(5000)), 0b01);
}

TEST(Debouncer, NoTimeMeansNoWaiting) {
    Debouncer d(base::Microseconds(0));
    d.update(0, at(0));
    EXPECT_EQ(d.update(0x3F, at(1)), 0x3F);
}

}  // namespace
}  // namespace nplc::gateway
