// A motor that takes everything but the stop. Only the stop's own echo confirms it; registers cannot be read
// instead, because a read is taken by an echo too, and comes after the stop.

#include <algorithm>

#include "motor_bench.h"
#include "registers/mac.h"

namespace nplc::motor {
namespace {

/// In FastMAC with safe communication, or FlexMAC (001 section 5.2). Counts the writes of MODE_REG, and has
/// taken them only while it obeys.
class Obstinate {
  public:
    bool obeys = false;
    int stops = 0;
    int reads = 0;
    int others = 0;

    std::uint8_t status() const {
        return static_cast<std::uint8_t>((toggle_ ? 0x80 : 0) | (flexmac_ ? 8 : 0));
    }
    void pause() {
        if (++silent_ == 2) part_.clear();
    }
    void take(std::uint8_t byte) {
        silent_ = 0;
        part_.push_back(byte);
        flexmac_ ? flex() : fast();
    }

  private:
    void fast() {
        if (part_.size() < 2) return;
        const std::uint8_t byte = part_.back();
        const bool counts = part_[part_.size() - 2] == byte && (byte >= 0x80) != toggle_;
        if (!counts) return;
        toggle_ = !toggle_;
        flexmac_ = (byte & 0x7F) == 0x7F;
        part_.clear();
    }
    void flex() {
        constexpr std::size_t kHeader = 3;
        if (part_.size() < kHeader) return;
        const std::uint8_t header = part_.front();
        const bool reads_register = (header & 0x10) != 0;
        const std::size_t size = header == 0x7E ? kHeader : reads_register ? kHeader + 2 : kHeader + 6;
        if (part_.size() < size) return;
        const bool is_stop = header == 0x60 && part_[kHeader] == 2;
        if (header == 0x7E) flexmac_ = false;
        ++(header == 0x7E ? others : is_stop ? stops : reads_register ? reads : others);
        if (!is_stop || obeys) toggle_ = !toggle_;
        part_.clear();
    }

    bool toggle_ = true;
    bool flexmac_ = false;
    int silent_ = 0;
    Bytes part_;
};

struct UnechoedStop : MotorTest {
    Obstinate peer;
    std::size_t taken = 0;

    /// `damage`: of the status byte.
    void pass_one(std::uint8_t damage = 0) {
        motor.hear(peer.status() ^ damage);
        const std::size_t left = line.sent.size() - line.in_transmitter;
        taken < left ? peer.take(line.sent[taken++]) : peer.pause();
    }
    void pass(int milliseconds) {
        for (const base::Instant end = motor.now + base::Milliseconds(milliseconds); motor.now < end;)
            pass_one();
    }
};

TEST_F(UnechoedStop, StaysUnconfirmedThoughAllElseIsTaken) {
    pass(100);
    ASSERT_EQ(driver.link(), Link::up);
    driver.stop();
    ASSERT_TRUE(driver.begin_access({.reg = registers::V_IST}));
    for (int i = 0; i < 100; ++i) {
        pass(50);
        ASSERT_FALSE(driver.stop_confirmed()) << i;
    }
    EXPECT_GT(peer.stops, 30) << "it is told again and again";
    EXPECT_EQ(peer.reads, 0) << "the stop goes first";
    EXPECT_EQ(driver.access_state(), AccessState::failed);
    EXPECT_GT(driver.counters().link_losses, 5U) << "an echo that does not come is a lost link";
    EXPECT_GT(peer.others, 5) << "all else is taken: each link that comes up again had its echoes";
    peer.obeys = true;
    pass(2'000);
    EXPECT_TRUE(driver.stop_confirmed());
    ASSERT_TRUE(driver.begin_access({.reg = registers::V_IST}));
    pass(50);
    EXPECT_EQ(peer.reads, 1);
}

// Bit 7 of two status bytes is damaged alike, just when the echo is due: the bytes behind them show it.
TEST_F(UnechoedStop, IsNotConfirmedByDamagedStatusBytes) {
    for (const int behind : {0, 1, 2, 4}) {
        pass(200);
        ASSERT_EQ(driver.link(), Link::up);
        driver.stop();
        const int stops = peer.stops;
        while (peer.stops == stops) pass_one();
        const std::uint32_t losses = driver.counters().link_losses;
        for (int i = 0; i < behind; ++i) pass_one();
        for (int i = 0; i < 2; ++i) pass_one(0x80);
        for (int i = 0; i < 60; ++i) {
            pass_one();
            ASSERT_FALSE(driver.stop_confirmed()) << behind << " bytes behind, " << i;
        }
        EXPECT_GT(driver.counters().link_losses, losses);
        peer.obeys = true;
        pass(2'000);
        EXPECT_TRUE(driver.stop_confirmed());
        driver.send({.command = protocol::fastmac::command_byte(protocol::fastmac::Number::reset_error)});
        peer.obeys = false;
    }
}

}  // namespace
}  // namespace nplc::motor
