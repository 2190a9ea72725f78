#include "sim/snapshot.h"

#include <fmt/format.h>

#include "protocol/fastmac.h"

namespace nplc::sim {
namespace {

namespace fastmac = protocol::fastmac;

constexpr std::array<std::string_view, 32> kCommandNames{"NOP",
                                                         "RESET_ERROR",
                                                         "CLEAR_P_SOLL",
                                                         "CLEAR_P_IST",
                                                         "CLEAR_P_FNC",
                                                         "STOP",
                                                         "CLEAR_T_SOLL",
                                                         "CLEAR_IN_POS",
                                                         "MOVE_P7_BY_P_FNC",
                                                         "MOVE_P8_BY_P_FNC",
                                                         "RAPID_COMMUNICATION",
                                                         "SAFE_COMMUNICATION",
                                                         "USE_SET(1)",
                                                         "USE_SET(2)",
                                                         "USE_SET(3)",
                                                         "USE_SET(4)",
                                                         "HOME",
                                                         "MOVE_P7_BY_P_SOLL",
                                                         "MOVE_P8_BY_P_SOLL",
                                                         "TRANSMIT_SLOWLY",
                                                         "POSITIONS_ABSOLUTE",
                                                         "POSITIONS_RELATIVE_P_SOLL",
                                                         "POSITIONS_RELATIVE_P_FNC",
                                                         "NOP(17h)",
                                                         "NOP(18h)",
                                                         "NOP(19h)",
                                                         "NOP(1Ah)",
                                                         "NOP(1Bh)",
                                                         "NOP(1Ch)",
                                                         "TRANSMIT_ADDRESS",
                                                         "USE_FASTMAC",
                                                         "USE_FLEXMAC"};

std::string command_in_words(std::uint8_t byte) {
    const fastmac::Command command = fastmac::decode_command(byte);
    if (command.mode == fastmac::Mode::command) return std::string(kCommandNames[command.number & 31U]);
    constexpr std::array<std::string_view, 3> kModes{"INIT", "VELOCITY", "POSITION"};
    constexpr std::string_view kGroups = "PVATLZ";
    return fmt::format("{}({}{})", kModes[static_cast<std::size_t>(command.mode)],
                       kGroups[static_cast<std::size_t>(command.group)], command.index);
}

}  // namespace

std::string Names::input(unsigned index) const {
    return inputs[index].empty() ? fmt::format("IN{}", index) : inputs[index];
}

std::string Names::output(unsigned index) const {
    return outputs[index].empty() ? fmt::format("OUT{}", index) : outputs[index];
}

std::string Names::step(std::uint8_t number) const {
    const auto found = steps.find(number);
    return found == steps.end() ? fmt::format("{}", number) : found->second;
}

std::string in_words(const SentOrder& order, registers::Model motor) {
    if (!order.is_register_write) return command_in_words(order.command);
    const registers::Register* reg = registers::find(motor, order.reg);
    if (reg == nullptr) return fmt::format("REG({}) := {}", order.reg, order.value);
    const bool is_signed = reg->min < 0;
    std::int64_t value = order.value;
    if (is_signed && registers::is_32_bit(reg->format)) value = static_cast<std::int32_t>(order.value);
    if (is_signed && !registers::is_32_bit(reg->format)) value = static_cast<std::int16_t>(order.value);
    return fmt::format("{} := {}", reg->name, value);
}

std::string in_numbers(const SentOrder& order) {
    if (order.is_register_write) return fmt::format("{}={}", order.reg, order.value);
    return fmt::format("{:02X}", order.command);
}

std::string in_numbers(const std::vector<SentOrder>& orders) {
    std::string text;
    for (const SentOrder& order : orders) {
        if (!text.empty()) text += ' ';
        text += in_numbers(order);
    }
    return text;
}

}  // namespace nplc::sim
