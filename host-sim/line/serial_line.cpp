#include "sim/serial_line.h"

#include <algorithm>
#include <utility>

namespace nplc::sim {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kBitsPerCharacter = 10;
constexpr std::uint64_t kSecond = 1'000'000'000;
constexpr std::uint64_t kDraws = 6;  ///< per character

}  // namespace

LineDirection::LineDirection(std::uint32_t baud, std::uint64_t seed) : baud_(baud), random_(seed) {}

double LineDirection::draw() {
    return static_cast<double>(random_() >> 11) * 0x1p-53;
}

std::uint8_t LineDirection::damage_mask() {
    const std::uint64_t bits = random_();
    if ((bits & 3U) != 0) return static_cast<std::uint8_t>(1U << ((bits >> 8) & 7U));
    return static_cast<std::uint8_t>(1 + (bits >> 16) % 255);
}

/// A fixed number of draws, so that the share of one fault does not change which characters another fault
/// hits.
LineDirection::Luck LineDirection::draw_all() {
    random_.discard(std::exchange(undrawn_, 0));
    Luck luck{};
    for (double* share : {&luck.drop, &luck.damage, &luck.framing, &luck.delay, &luck.wait}) *share = draw();
    luck.mask = damage_mask();
    return luck;
}

void LineDirection::set_faults(const LineFaults& faults) {
    faults_ = faults;
    has_faults_ = faults.drop > 0 || faults.damage > 0 || faults.framing > 0 || faults.delay > 0;
}

void LineDirection::reseed(std::uint64_t seed) {
    random_.seed(seed);
    undrawn_ = 0;
}

void LineDirection::clock_out(Time now) {
    if (now > busy_until_) {
        busy_until_ = now;
        remainder_ = 0;
    }
    const std::uint64_t total = kBitsPerCharacter * kSecond + remainder_;
    busy_until_ += Time{static_cast<std::int64_t>(total / baud_)};
    remainder_ = total % baud_;
}

void LineDirection::start(std::uint8_t byte, Time now) {
    clock_out(now);
    ++counters_.sent;
    Luck luck{.drop = 1, .damage = 1, .framing = 1, .delay = 1, .wait = 0, .mask = 0};
    if (has_faults_ || rates_differ_)
        luck = draw_all();
    else
        undrawn_ += kDraws;
    const std::uint8_t mask_before = std::exchange(last_mask_, std::uint8_t{0});
    if (cut_) {
        ++counters_.cut;
        return;
    }
    if (luck.drop < faults_.drop) {
        ++counters_.dropped;
        return;
    }
    ports::ReceivedByte received{byte, false};
    if (rates_differ_ || luck.framing < faults_.framing) {
        ++counters_.framing;
        received = {static_cast<std::uint8_t>(byte ^ luck.mask), true};
    } else if (luck.damage < faults_.damage) {
        ++counters_.damaged;
        last_mask_ = luck.mask;
        if (luck.mask == mask_before) ++counters_.damaged_alike;
        received.value = static_cast<std::uint8_t>(byte ^ luck.mask);
    }
    Time arrival = busy_until_ + faults_.late;
    if (luck.delay < faults_.delay) {
        ++counters_.delayed;
        arrival +=
            Time{static_cast<std::int64_t>(luck.wait * static_cast<double>(faults_.longest_delay.count()))};
    }
    if (faults_.together > Time(0)) arrival += faults_.together - 1ns - (arrival - 1ns) % faults_.together;
    last_arrival_ = std::max(last_arrival_, arrival);
    flying_.push_back({received, last_arrival_});
}

std::optional<ports::ReceivedByte> LineDirection::take(Time now) {
    if (flying_.empty() || flying_.front().arrival > now) return std::nullopt;
    const ports::ReceivedByte byte = flying_.front().byte;
    flying_.pop_front();
    ++counters_.delivered;
    return byte;
}

void LineDirection::set_rates(std::uint32_t sender, std::uint32_t receiver) {
    baud_ = sender;
    rates_differ_ = sender != receiver;
    remainder_ = 0;
}

void LineDirection::cut() {
    cut_ = true;
    counters_.cut += flying_.size();
    flying_.clear();
}

std::size_t VirtualSerialLine::Port::write(std::span<const std::uint8_t> bytes) {
    const std::size_t count = std::min(bytes.size(), kTransmitRoom - waiting.size());
    waiting.insert(waiting.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
}

std::size_t VirtualSerialLine::Port::read(std::span<ports::ReceivedByte> out) {
    const std::size_t count = std::min(out.size(), received.size());
    if (count == 0) return 0;
    const auto end = received.begin() + static_cast<std::ptrdiff_t>(count);
    std::copy(received.begin(), end, out.begin());
    received.erase(received.begin(), end);
    return count;
}

VirtualSerialLine::VirtualSerialLine(std::uint32_t baud, std::uint64_t seed)
    : to_motor_(baud, 0), from_motor_(baud, 0) {
    reseed(seed);
}

void VirtualSerialLine::set_rates(std::uint32_t gateway, std::uint32_t other_end) {
    to_motor_.set_rates(gateway, other_end);
    from_motor_.set_rates(other_end, gateway);
}

bool VirtualSerialLine::service(Time now) {
    bool any = false;
    while (const auto byte = from_motor_.take(now)) {
        any = true;
        if (port_.received.size() == Port::kReceiveRoom) {
            ++port_.overruns;
        } else {
            port_.received.push_back(*byte);
        }
    }
    if (!port_.waiting.empty() && to_motor_.free(now)) {
        to_motor_.start(port_.waiting.front(), now);
        port_.waiting.pop_front();
    }
    port_.wire_free = to_motor_.free(now);
    return any;
}

void VirtualSerialLine::cut() {
    to_motor_.cut();
    from_motor_.cut();
}

void VirtualSerialLine::restore() {
    to_motor_.restore();
    from_motor_.restore();
}

void VirtualSerialLine::reseed(std::uint64_t seed) {
    to_motor_.reseed(2 * seed);
    from_motor_.reseed(2 * seed + 1);
}

}  // namespace nplc::sim
