// Any bytes as a sequence table; the input's first 32 bytes are HW_INP and pauses. Engine, its halting form
// and is_true() must agree, and the state must stay in its bounds.
#include <cstdint>
#include <span>
#include <vector>

#include "fuzz.h"
#include "sequencer/engine.h"

namespace {

using namespace nplc::sequencer;
using Orders = std::vector<MotorOrder>;

constexpr std::size_t kStimulusBytes = 32;

void require_bounds(const State& state) {
    require(state.step <= kLastStep && state.outputs <= 0x0F);
}

void require_fault_in_range(const TableFault& fault, std::size_t bytes) {
    require(fault.term <= kMaxTerms && fault.term <= bytes / kTermBytes);
    require(!describe(fault.error).empty());
}

bool any_fires(const Table& table, const State& state, InputImage image) {
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (step_of(table.term(i)) == state.step && is_true(table.term(i), key_of(image, state))) return true;
    }
    return false;
}

class Run {
  public:
    explicit Run(const Table& table) : table_(table), whole_(table), halting_(table) {}

    void step(InputImage image, std::uint8_t ms) {
        const State before = whole_.state();
        const bool fires = any_fires(table_, before, image);
        Orders sent;
        const auto keep = [](Orders& to) { return [&to](const MotorOrder& order) { to.push_back(order); }; };
        const ScanEffect effect = whole_.scan(image, keep(sent));
        require(fires || !effect.any());
        require_bounds(whole_.state());

        Orders one_by_one;
        halting_.begin(image);
        while (const auto order = halting_.next()) one_by_one.push_back(*order);
        require(halting_.finish().any() == effect.any());
        require(one_by_one == sent && halting_.state() == whole_.state());
        require(effect.sent == !sent.empty() && sent.size() <= table_.size());

        if (!effect.any()) require(whole_.state() == before);
        whole_.elapse(ms);
        halting_.elapse(ms);
    }

  private:
    const Table& table_;
    Engine whole_;
    Engine halting_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < kStimulusBytes) return 0;
    const std::span<const std::uint8_t> input(data, size);
    const auto stimulus = input.first<kStimulusBytes>();
    const auto bytes = input.subspan(kStimulusBytes);
    const auto loaded = Table::load(bytes);
    if (!loaded.ok) {
        require_fault_in_range(loaded.fault, bytes.size());
        return 0;
    }
    Run run(loaded.table);
    for (std::size_t i = 0; i < stimulus.size(); ++i) {
        run.step(stimulus[i], stimulus[(i + 1) % stimulus.size()]);
    }
    return 0;
}
