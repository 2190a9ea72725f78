#include "hal_mcu/buffered_serial.h"

#include <gtest/gtest.h>

#include <vector>

namespace nplc::hal_mcu {
namespace {

/// A chip whose transmitter takes a number of characters at a time.
class Line final : public BufferedSerial {
  public:
    void comes(std::uint8_t value, bool framing_error = false) { take_received(value, framing_error); }
    void loses() { note_overrun(); }
    void moves(int characters) {
        for (int i = 0; i < characters; ++i) {
            if (const auto byte = next_to_send()) sent.push_back(*byte);
        }
    }

    std::vector<std::uint8_t> sent;
    int woken = 0;
    bool idle = true;

  private:
    void wake_transmitter() override { ++woken; }
    bool line_is_idle() override { return idle; }
};

std::vector<ports::ReceivedByte> read_all(Line& line) {
    std::vector<ports::ReceivedByte> bytes(200);
    bytes.resize(line.read(bytes));
    return bytes;
}

TEST(BufferedSerial, TakesWhatFitsAndIsIdleWhenTheLastBitHasLeft) {
    Line line;
    const std::vector<std::uint8_t> bytes(BufferedSerial::kCapacity + 5, 0x55);
    EXPECT_EQ(line.write(bytes), BufferedSerial::kCapacity);
    EXPECT_EQ(line.woken, 1);
    EXPECT_EQ(line.write(bytes), 0U);
    EXPECT_FALSE(line.transmitter_idle());
    line.moves(BufferedSerial::kCapacity);
    EXPECT_EQ(line.sent.size(), BufferedSerial::kCapacity);
    line.idle = false;
    EXPECT_FALSE(line.transmitter_idle());
    line.idle = true;
    EXPECT_TRUE(line.transmitter_idle());
}

TEST(BufferedSerial, CountsFramingErrorsAndHandsThemOn) {
    Line line;
    line.comes(0x41);
    line.comes(0x00, true);
    line.comes(0x42);
    const auto bytes = read_all(line);
    ASSERT_EQ(bytes.size(), 3U);
    EXPECT_FALSE(bytes[0].framing_error);
    EXPECT_TRUE(bytes[1].framing_error);
    EXPECT_EQ(bytes[2].value, 0x42);
    EXPECT_EQ(line.faults().framing, 1U);
}

/// No message is put together across a gap: a fault stands where characters are missing.
TEST(BufferedSerial, MarksThePlaceWhereItsBufferWasFull) {
    Line line;
    for (std::size_t i = 0; i < BufferedSerial::kCapacity; ++i) line.comes(static_cast<std::uint8_t>(i));
    line.comes(0xEE);
    line.comes(0xEF);
    EXPECT_EQ(line.faults().overruns, 2U);
    EXPECT_EQ(read_all(line).size(), BufferedSerial::kCapacity);
    line.comes(0x77);
    const auto bytes = read_all(line);
    ASSERT_EQ(bytes.size(), 2U);
    EXPECT_TRUE(bytes[0].framing_error);
    EXPECT_EQ(bytes[1].value, 0x77);
    EXPECT_FALSE(bytes[1].framing_error);
}

TEST(BufferedSerial, MarksThePlaceOfAnOverrunInTheChip) {
    Line line;
    line.comes(1);
    line.loses();
    line.comes(2);
    const auto bytes = read_all(line);
    ASSERT_EQ(bytes.size(), 3U);
    EXPECT_TRUE(bytes[1].framing_error);
    EXPECT_EQ(bytes[2].value, 2);
    EXPECT_EQ(line.faults().overruns, 1U);
}

}  // namespace
}  // namespace nplc::hal_mcu
