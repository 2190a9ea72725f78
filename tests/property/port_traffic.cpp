#include "port_traffic.h"

#include <algorithm>

#include "protocol/mactalk.h"
#include "registers/gateway.h"
#include "registers/mac.h"

namespace nplc::property {

namespace mactalk = protocol::mactalk;
namespace reg = registers::gateway;
using namespace std::chrono_literals;
using mactalk::Kind;
using sim::Time;

namespace {

std::vector<std::uint8_t> bytes_of(auto&& encoded) {
    return {encoded.view().begin(), encoded.view().end()};
}

}  // namespace

PortTraffic::PortTraffic(std::uint64_t seed, Traffic traffic, sim::Polling polling)
    : traffic_(traffic),
      dice_(seed + 1000),
      world_(table(seed), {.seed = seed, .faults = {}, .gateway = {}, .polling = polling}) {}

/// Step i waits for IN0 = i modulo 2. Commands 00h..5Fh select registers; 60h.. would be the link's own too.
std::vector<std::uint8_t> PortTraffic::table(std::uint64_t seed) {
    Dice dice(seed);
    std::vector<std::uint8_t> bytes;
    const auto put = [&bytes](unsigned byte) { bytes.push_back(static_cast<std::uint8_t>(byte)); };
    constexpr unsigned kSteps = 8;
    for (unsigned step = 0; step < kSteps; ++step) {
        for (unsigned writes = dice.below(4); writes > 0; --writes) {
            constexpr std::uint8_t kRegisters[]{49, 51, 65, 66, 73, 77, 33, 34};
            const bool longword = dice.one_in(3);
            for (const unsigned byte : {0xC0 | step, (step + 1) % 2, 0x81U}) put(byte);
            put((longword ? 0x80U : 0U) | kRegisters[dice.below(std::size(kRegisters))]);
            for (int i = 0; i < 4; ++i) put(dice.below(256));
        }
        for (const unsigned byte : {0xC0 | step, (step + 1) % 2, 0x01U, (step + 1) % kSteps}) put(byte);
        put(dice.one_in(4) ? 0x80 : dice.below(0x60));
        for (const unsigned byte : {dice.below(16), 0U, 0U}) put(byte);
    }
    bytes.insert(bytes.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    return bytes;
}

void PortTraffic::run() {
    go_on(1s);
    for (unsigned change = 0; change < kChanges; ++change) {
        // A little later each time, so that every moment of a read is hit.
        go_on(1s + change * kBetween + Time(change * 1'700'000));
        world_.toggle_input(0);
        go_on(1s + (change + 1) * kBetween);
        const auto snapshot = world_.take_snapshot();
        trace_.push_back(snapshot.step * 16U + snapshot.outputs);
    }
}

void PortTraffic::go_on(Time until) {
    while (world_.now() < until) {
        world_.step(traffic_ == Traffic::none ? until
                                              : std::min(until, std::max(world_.now(), next_question_)));
        for (const auto& order : world_.take_snapshot().orders) ordered_.push_back({order, world_.now()});
        answered_ += world_.user_received().size();
        if (traffic_ != Traffic::none && world_.now() >= next_question_) ask();
    }
}

/// A new message drops the answer that is still to come: now and then it comes too early.
void PortTraffic::ask() {
    const auto bytes = traffic_ == Traffic::anything && !dice_.one_in(3) ? other_message() : message();
    world_.user_sends(bytes);
    const Time on_the_line(static_cast<std::int64_t>(bytes.size()) * 520'834);
    next_question_ =
        world_.now() + on_the_line + Time(1'000'000 * static_cast<std::int64_t>(1 + dice_.below(90)));
}

std::vector<std::uint8_t> PortTraffic::message() {
    const std::uint8_t address = dice_.one_in(4) ? mactalk::kEveryone : std::uint8_t{1};
    const auto number = static_cast<std::uint8_t>(1 + dice_.below(255));
    const Kind kind = dice_.one_in(8) ? Kind::read_block : Kind::read;
    return bytes_of(mactalk::encode({.kind = kind, .address = address, .reg = number}));
}

std::vector<std::uint8_t> PortTraffic::other_message() {
    const auto number = static_cast<std::uint8_t>(1 + dice_.below(255));
    switch (dice_.below(7)) {
        case 0:
            return bytes_of(
                mactalk::encode({.kind = Kind::read, .address = reg::kDefaultAddress, .reg = number}));
        case 1:
            return bytes_of(
                mactalk::encode({.kind = Kind::read_block, .address = reg::kDefaultAddress, .reg = number}));
        case 2:  // refused while it runs
            return bytes_of(mactalk::encode(
                {.kind = Kind::write, .address = 1, .reg = number, .length = 2, .value = dice_.byte()}));
        case 3: {
            constexpr Kind kKinds[]{Kind::safe_mode, Kind::init_mode, Kind::write_flash, Kind::reset};
            return bytes_of(mactalk::encode({.kind = kKinds[dice_.below(4)], .address = 1}));
        }
        case 4: {  // an upload's beginning, its end, and activating, which is refused
            constexpr std::uint32_t kCommands[]{16, 17, 18, 19};
            return bytes_of(mactalk::encode({.kind = Kind::write,
                                             .address = reg::kDefaultAddress,
                                             .reg = reg::COMMAND,
                                             .length = 4,
                                             .value = kCommands[dice_.below(4)]}));
        }
        case 5: {
            std::vector<std::uint8_t> piece(4 * (1 + dice_.below(32)));
            std::generate(piece.begin(), piece.end(), [this] { return dice_.byte(); });
            return bytes_of(mactalk::encode_long_write(reg::kDefaultAddress, reg::TABLE_DATA, piece));
        }
        default: {
            std::vector<std::uint8_t> noise(1 + dice_.below(40));
            std::generate(noise.begin(), noise.end(), [this] { return dice_.byte(); });
            return noise;
        }
    }
}

std::vector<Time> PortTraffic::executed() const {
    std::vector<Time> times;
    for (const sim::Order& order : world_.mac().orders()) {
        const bool is_own = order.flexmac ? order.reg != registers::MODE_REG : (order.command & 0x7F) < 0x60;
        if (is_own) times.emplace_back(order.at.time_since_epoch());
    }
    return times;
}

}  // namespace nplc::property
