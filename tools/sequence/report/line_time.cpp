#include "report/line_time.h"

#include <algorithm>

#include "protocol/flexmac.h"
#include "table/commands.h"

namespace nplc::seqc {
namespace {

namespace flexmac = protocol::flexmac;

constexpr std::uint32_t kEqualStatusBytes = 2;
constexpr std::uint32_t kPauseBeforeFlexMac = 3;
constexpr std::uint32_t kLateStatusBytes = 2;

/// Simulates the messages as JvlMotor::work chooses them and JvlLink sends them.
class Line {
  public:
    explicit Line(bool safe) : safe_(safe) {}

    void send(const sequencer::MotorOrder& order) {
        if (in_flexmac_ && !order.is_register_write) leave_flexmac();
        if (!in_flexmac_ && order.is_register_write) command(table::use_flexmac());
        if (order.is_register_write) {
            flexmac_message({.longword = order.longword,
                             .level = flexmac::Level::reg,
                             .target = order.reg,
                             .value = order.value});
        } else {
            command(order.command);
        }
    }

    LineUse finish() {
        if (in_flexmac_) leave_flexmac();
        use_.until_done = now_;
        use_.at_most = now_ + kLateStatusBytes * use_.messages;
        return use_;
    }

  private:
    void command(std::uint8_t byte) {
        message(now_, safe_ ? 2 : 1);
        const table::LineChange change = table::line_change_of(byte);
        if (change == table::LineChange::flexmac) in_flexmac_ = true;
        if (change == table::LineChange::safe) safe_ = true;
        if (change == table::LineChange::rapid) safe_ = false;
    }

    void leave_flexmac() {
        flexmac_message(flexmac::kUseFastMac);
        in_flexmac_ = false;
    }

    void flexmac_message(const flexmac::Message& what) {
        message(std::max(now_, left_ + kPauseBeforeFlexMac),
                static_cast<std::uint32_t>(flexmac::encode(what).size));
    }

    void message(std::uint32_t begin, std::uint32_t size) {
        ++use_.messages;
        use_.characters += size;
        left_ = begin + size;
        now_ = left_ + kEqualStatusBytes;
    }

    LineUse use_;
    bool safe_;
    bool in_flexmac_ = false;
    std::uint32_t left_ = 0;  ///< when the last character had left the transmitter
    std::uint32_t now_ = 0;   ///< in characters
};

}  // namespace

LineUse line_use(std::span<const sequencer::MotorOrder> orders, bool safe_communication) {
    Line line(safe_communication);
    for (const sequencer::MotorOrder& order : orders) line.send(order);
    return line.finish();
}

double milliseconds(std::uint32_t characters, std::uint32_t baud) {
    constexpr double kBitsPerCharacter = 10;
    return characters * kBitsPerCharacter * 1000 / baud;
}

}  // namespace nplc::seqc
