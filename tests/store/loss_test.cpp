// Any bit flips and any block is lost while nothing is written: the latest table runs, or it is said that it
// may not be the latest.

#include "store_bench.h"

namespace nplc::store {
namespace {

const Bytes kOld = table_of(10, 1);
const Bytes kNew = table_of(12, 2);

/// What runs is the latest, or it is said that it may not be.
void expect_latest_or_told(sim::SimStorage& device, const Shape& shape, const Bytes& latest) {
    Session session(device, shape.area);
    EXPECT_TRUE(session.content() == latest || session.slots.is_fallback()) << shape.name;
}

TEST(Loss, NoFlippedBitAnywhereBringsAnOlderTableSilently) {
    for (const Shape& shape : shapes(200)) {
        for (const auto& start : {device_with(shape, {kNew}), device_with(shape, {kOld, kNew})}) {
            for (std::uint32_t bit = 0; bit < 8 * shape.geometry.size; ++bit) {
                sim::SimStorage device(start);
                device.flip(bit / 8, bit % 8);
                expect_latest_or_told(device, shape, kNew);
            }
        }
    }
}

TEST(Loss, NoBlockThatIsErasedOrClearedBringsAnOlderTableSilently) {
    for (const Shape& shape : shapes(200)) {
        for (const auto& start : {device_with(shape, {kNew}), device_with(shape, {kOld, kNew})}) {
            const std::uint32_t block = shape.geometry.erase_block;
            for (std::uint32_t begin = 0; begin < shape.geometry.size; begin += block) {
                for (const unsigned byte : {0xFFU, 0x00U}) {
                    sim::SimStorage device(start);
                    device.fill(begin, block, static_cast<std::uint8_t>(byte));
                    expect_latest_or_told(device, shape, kNew);
                }
            }
        }
    }
}

TEST(Loss, AnUploadMendsWhatWasDamagedWhereverItWas) {
    for (const Shape& shape : shapes(200)) {
        sim::SimStorage device = device_with(shape, {kOld, kNew});
        device.fill(0, shape.geometry.size, 0x00);
        EXPECT_EQ(Session(device, shape.area).write(kNew), Phase::done) << shape.name;
        Session session(device, shape.area);
        EXPECT_EQ(session.content(), kNew);
        EXPECT_FALSE(session.slots.is_fallback()) << shape.name;
    }
}

}  // namespace
}  // namespace nplc::store
