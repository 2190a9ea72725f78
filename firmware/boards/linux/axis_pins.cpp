#include "axis_pins.h"

#include <bit>
#include <utility>

namespace nplc::boards {

std::vector<std::string> AxisPins::open(const AxisConfig& config, std::uint8_t safe) {
    const std::string consumer = "nanoplc " + config.name;
    std::vector<std::string> errors;
    const auto take = [&](hal_linux::GpioBits& bits, const hal_linux::GpioBits::Wanted& wanted) {
        const std::string error = bits.take(wanted);
        if (!error.empty()) errors.push_back(error);
        return error.empty();
    };
    if (!has_outputs_ || outputs_->lost()) {
        has_outputs_ = take(output_bits_, {config.outputs, consumer, safe});
        outputs_.emplace(output_bits_, safe);
    }
    if (!has_inputs_ || inputs_->lost()) {
        has_inputs_ = take(input_bits_, {config.inputs, consumer, std::nullopt});
        inputs_.emplace(input_bits_);
    }
    told_lost_ = false;
    return errors;
}

void AxisPins::set_safe(std::uint8_t levels) {
    if (outputs_) outputs_->set_safe(levels);
}

void AxisPins::write(std::uint8_t levels) {
    if (outputs_) outputs_->write(levels);
}

void AxisPins::watch(hal_linux::EventLoop& loop, std::uint32_t mark) {
    edges_ = 0;
    for (const int descriptor : input_bits_.descriptors()) loop.watch(descriptor, mark++);
}

/// An edge event carries its line's new level, and only that line is read then. On any other wake-up all
/// lines are read, so an edge that the chip missed is detected a little later.
void AxisPins::read_inputs() {
    std::uint32_t edges = std::exchange(edges_, 0);
    if (edges == 0) return inputs_->look();
    for (; edges != 0; edges &= edges - 1)
        inputs_->look_at(static_cast<std::size_t>(std::countr_zero(edges)));
}

bool AxisPins::is_newly_lost(hal_linux::EventLoop& loop) {
    if (told_lost_ || (!inputs_->lost() && !outputs_->lost())) return false;
    told_lost_ = true;
    for (const int descriptor : input_bits_.descriptors()) loop.ignore(descriptor);
    return true;
}

}  // namespace nplc::boards
