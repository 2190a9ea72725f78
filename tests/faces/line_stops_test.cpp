// Stops in the bytes of a serial line, wherever they begin.
#include "line_stops.h"

#include <gtest/gtest.h>

namespace nplc::modbus {
namespace {

namespace gw = registers::gateway;
using Bytes = std::vector<std::uint8_t>;

Bytes frame(std::uint8_t unit, const Bytes& pdu) {
    const protocol::modbus::RtuFrame made(unit, pdu);
    return {made.bytes().begin(), made.bytes().end()};
}

Bytes operator+(Bytes one, const Bytes& other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
}

/// Units for which stops were found, each with its number of commands.
std::vector<std::pair<unsigned, std::size_t>> found(const Bytes& bytes) {
    StopFinder finder;
    std::vector<std::pair<unsigned, std::size_t>> all;
    for (const std::uint8_t byte : bytes) {
        if (finder.take(byte)) all.emplace_back(finder.unit(), stops_in(finder.pdu(), {}).size());
    }
    return all;
}

using Found = std::vector<std::pair<unsigned, std::size_t>>;

const Bytes kStopCoil{5, 0, 1, 0xFF, 0};
const Bytes kReadStatus{4, 0, 1, 0, 1};

TEST(LineStops, AreFoundBehindNoiseHalfFramesAndUnknownFunctions) {
    const Bytes stop = frame(10, kStopCoil);
    EXPECT_EQ(found(stop), (Found{{10, 1}}));
    EXPECT_EQ(found(Bytes{0} + stop), (Found{{10, 1}}));
    const Bytes read = frame(10, kReadStatus);
    EXPECT_EQ(found(Bytes(read.begin(), read.begin() + 5) + stop), (Found{{10, 1}}));
    EXPECT_EQ(found(frame(9, {0x2B, 0x0E, 1, 0}) + stop + read + stop), (Found{{10, 1}, {10, 1}}));
    EXPECT_EQ(found(Bytes(2'000, 0x55) + stop), (Found{{10, 1}}));
}

TEST(LineStops, AreFoundInEveryRequestThatWritesThem) {
    for (const Bytes& pdu : {Bytes{6, 0, 0, 0, 3}, Bytes{15, 0, 0, 0, 8, 1, 0x02},
                             Bytes{16, 0, 0, 0, 2, 4, 0, 6, 0, 7}, Bytes{5, 0, 3, 0xFF, 0}})
        EXPECT_EQ(found(Bytes{0xFF} + frame(0, pdu)), (Found{{0, 1}}));
    EXPECT_EQ(found(frame(0, {15, 0, 0, 0, 8, 1, 0x0E})), (Found{{0, 3}}));
}

TEST(LineStops, AreNothingElse) {
    Bytes damaged = frame(10, kStopCoil);
    damaged.back() ^= 1U;
    EXPECT_EQ(found(damaged), Found{});
    for (const Bytes& pdu :
         {kReadStatus, Bytes{5, 0, 0, 0xFF, 0}, Bytes{5, 0, 1, 0, 0}, Bytes{16, 0, 0, 0, 2, 4, 0, 1, 0, 7}}) {
        EXPECT_EQ(found(frame(10, pdu)), Found{});
        EXPECT_TRUE(stops_in(pdu, {}).empty());
    }
}

TEST(LineStops, SayWhichStopItIs) {
    const auto value = [](const Bytes& pdu) {
        return static_cast<gw::Command>(stops_in(pdu, {}).at(0).value);
    };
    EXPECT_EQ(value(kStopCoil), gw::Command::stop);
    EXPECT_EQ(value({5, 0, 2, 0xFF, 0}), gw::Command::safe);
    EXPECT_EQ(value({6, 0, 0, 0, 6}), gw::Command::hold);
}

}  // namespace
}  // namespace nplc::modbus
