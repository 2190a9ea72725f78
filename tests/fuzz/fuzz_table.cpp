// Any bytes are a table or are refused with a term's number. An accepted table runs without leaving its
// bounds; what follows its end term serves as inputs.

#include <cstdlib>

#include "sequencer/engine.h"

using namespace nplc;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

void check_order(const sequencer::MotorOrder& order) {
    if (order.is_flex) {
        require(order.reg >= 1 && order.reg <= 127);
    } else {
        require(order.command <= 0x7F);
    }
}

void run(const sequencer::Table& table, std::span<const std::uint8_t> inputs) {
    sequencer::Engine engine(table);
    for (const std::uint8_t image : inputs) {
        std::size_t orders = 0;
        engine.scan(image, [&](const sequencer::MotorOrder& order) {
            check_order(order);
            ++orders;
        });
        require(orders <= table.size());
        require(engine.state().step <= sequencer::kLastStep);
        require(engine.state().outputs <= 0x0F);
        engine.elapse(image);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::uint8_t> bytes(data, size);
    const auto loaded = sequencer::Table::load(bytes);
    if (!loaded.ok) {
        require(loaded.fault.term <= sequencer::kMaxTerms);
        require(!sequencer::describe(loaded.fault.error).empty());
        return 0;
    }
    require(loaded.table.size() <= sequencer::kMaxTerms);
    const std::size_t used = (loaded.table.size() + 1) * sequencer::kTermBytes;
    require(used <= size);
    run(loaded.table, bytes.subspan(used));
    return 0;
}
