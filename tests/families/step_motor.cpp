#include <fmt/format.h>

#include "motor/step_driver.h"
#include "registers/family.h"

namespace nplc::motor::step {
namespace {

constexpr base::Milliseconds kLongestAnswer{100};
constexpr std::uint8_t kResetError = 0x61;

}  // namespace

void StepMotor::say(const std::string& text) {
    const std::string line = text + "\n";
    port_.write({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()});
}

bool StepMotor::can_execute(const Order& order) const {
    const registers::DriveModel& model = *registers::find_drive("STEP1");
    return (order.is_register_write
                ? model.family->refuses_write(model, order.reg, order.longword, order.value)
                : model.family->refuses_command(model, order.command))
        .empty();
}

void StepMotor::send(const Order& order) {
    if (!link_is_usable(link_)) {
        ++counters_.discarded;
        return;
    }
    orders_.push(order);
}

bool StepMotor::orders_complete() const {
    return !link_is_usable(link_) || (orders_.empty() && !stops_ && !was_ordered_);
}

void StepMotor::execute(const Order& order, base::Instant) {
    ++counters_.orders;
    if (order.is_register_write) {
        if (order.reg == registers::MODE_REG) return say("S");
        places_[(order.reg - registers::P1) / 2U] = static_cast<std::int32_t>(order.value);
        return;
    }
    if (order.command == kResetError) {
        link_ = Link::up;
    } else if (order.command >> 5U == 0) {
        say("S");
    } else if (order.command >> 5U == 2) {
        say(fmt::format("G{}", places_[order.command & 7U]));
        stands_ = false;
    }
}

void StepMotor::begin_orders(base::Instant now) {
    if (is_asked_ || !link_is_usable(link_)) return;
    if (stops_) {
        say("S");
        orders_.clear();
        was_ordered_ = true;
    }
    stops_ = false;
    while (!orders_.empty()) {
        execute(orders_.front(), now);
        orders_.pop();
        was_ordered_ = true;
    }
}

void StepMotor::take_line(base::Instant) {
    stands_ = line_.starts_with("0 ");
    is_asked_ = was_ordered_ = false;
    if (link_ == Link::down) link_ = counters_.link_losses == 0 ? Link::up : Link::unacknowledged;
}

void StepMotor::poll(base::Instant now) {
    std::array<ports::ReceivedByte, 32> bytes;
    const std::size_t count = port_.read(bytes);
    for (std::size_t i = 0; i < count; ++i) {
        if (bytes[i].value != '\n') {
            line_ += static_cast<char>(bytes[i].value);
            continue;
        }
        take_line(now);
        line_.clear();
    }
    if (is_asked_ && now - asked_ >= kLongestAnswer) {
        is_asked_ = false;
        if (link_is_usable(link_)) ++counters_.link_losses;
        link_ = Link::down;
    }
    begin_orders(now);
    if (is_asked_) return;
    say("?");
    is_asked_ = true;
    asked_ = now;
}

}  // namespace nplc::motor::step
