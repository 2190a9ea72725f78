#include "faces/image_board.h"

#include <gtest/gtest.h>

#include <thread>

namespace nplc::faces {
namespace {

TEST(ImageBoard, HasNothingAtFirst) {
    ImageBoard board;
    EXPECT_EQ(board.get().number, 0U);
    EXPECT_EQ(board.number(), 0U);
}

/// Every word of an image carries its number: a mixture of two would show.
TEST(ImageBoard, GivesWholeImagesWhileOthersArePut) {
    constexpr std::uint64_t kImages = 20'000;
    ImageBoard board;
    std::thread loop([&board] {
        AxisImage image;
        for (std::uint64_t number = 1; number <= kImages; ++number) {
            image.number = number;
            image.own.fill(static_cast<std::uint32_t>(number));
            for (MotorValue& value : image.motor) value.value = static_cast<std::int32_t>(number);
            board.put(image);
        }
    });
    std::uint64_t last = 0;
    int torn = 0;
    int back = 0;
    while (last != kImages) {
        const AxisImage image = board.get();
        back += image.number < last ? 1 : 0;
        last = image.number;
        for (const std::uint32_t value : image.own) torn += value == last ? 0 : 1;
        for (const MotorValue& value : image.motor)
            torn += value.value == static_cast<std::int32_t>(last) ? 0 : 1;
    }
    loop.join();
    EXPECT_EQ(torn, 0);
    EXPECT_EQ(back, 0);
}

TEST(MotorValue, SaysHowGoodItIs) {
    constexpr base::Instant kThen{base::Milliseconds(10'000)};
    constexpr base::Milliseconds kLimit{1'000};
    MotorValue value;
    EXPECT_EQ(value.quality(kThen, kLimit), Quality::unknown);
    value = {true, 7, kThen - kLimit};
    EXPECT_EQ(value.quality(kThen, kLimit), Quality::good);
    EXPECT_EQ(value.quality(kThen + base::Microseconds(1), kLimit), Quality::old);
}

}  // namespace
}  // namespace nplc::faces
