#include "report/verify_question.h"

#include <cmath>
#include <string>

#include "report/line_time.h"
#include "report/table_text.h"

namespace nplc::seqc {
namespace {

constexpr std::uint32_t kBaud = 19'200;

/// On a line without faults, including the polls of driver and gateway.
std::uint32_t most_time(std::span<const sequencer::MotorOrder> orders) {
    const LineUse use = line_use(orders, true);
    return static_cast<std::uint32_t>(std::ceil(milliseconds(use.at_most, kBaud))) + use.messages +
           verify::Machine::kMostIdle;
}

/// The motor's queue holds eight orders besides the one in execution; a scan with more waits for the earlier
/// ones.
verify::Delay order_time(std::span<const sequencer::MotorOrder> orders, bool translated) {
    constexpr std::size_t kQueue = 8;
    constexpr std::uint32_t kLongestWait = 1'000;
    const bool waits = orders.size() > kQueue;
    if (translated) return {0, kLongestWait, waits ? kLongestWait : 0};
    const LineUse use = line_use(orders, true);
    return {static_cast<std::uint32_t>(milliseconds(use.until_done, kBaud)), most_time(orders),
            waits ? most_time(orders.first(orders.size() - kQueue)) : 0};
}

}  // namespace

verify::Names verify_names(const Symbols& symbols) {
    verify::Names names{symbols.steps, symbols.inputs, symbols.outputs, symbols.inverted_inputs,
                        symbols.copy_of};
    names.timer_is_limit = symbols.timer_is_limit;
    for (std::size_t step = 0; step < symbols.made_for.size(); ++step) {
        if (symbols.made_for[step].starts_with("helper step")) names.helpers |= std::uint64_t{1} << step;
    }
    names.order = [symbols](const sequencer::MotorOrder& order) { return named_order_text(order, &symbols); };
    return names;
}

verify::Names verify_names() {
    verify::Names names;
    names.order = [](const sequencer::MotorOrder& order) { return order_text(order, nullptr); };
    return names;
}

verify::OrderTime order_times(bool translated) {
    return [translated](std::span<const sequencer::MotorOrder> orders) {
        return order_time(orders, translated);
    };
}

std::vector<verify::Allowance> allowances_in(const Compilation& program) {
    std::vector<verify::Allowance> allowances;
    for (const Allowance& allowance : program.allowances)
        allowances.push_back({allowance.code, allowance.step, allowance.reason});
    return allowances;
}

}  // namespace nplc::seqc
