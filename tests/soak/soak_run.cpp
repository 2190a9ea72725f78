#include "soak_run.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/crc32.h"
#include "registers/gateway.h"

namespace nplc::soak {

namespace mactalk = protocol::mactalk;
namespace reg = registers::gateway;
using namespace std::chrono_literals;

namespace {

/// The motor's silence that is a lost link, 10 ms until the outputs are safe (SafeReason::link_down), and
/// what may still have been under way when the motor fell silent.
constexpr Time kSafeAfter = 20ms + 10ms + 5ms;
/// A damage that no repeat shows may change the link's mode, which the driver sets right within that.
constexpr Time kExcuse = 2s;
constexpr Time kForgetful = 500ms;

}  // namespace

std::string_view name_of(Invariant invariant) {
    constexpr std::array<std::string_view, 7> kNames{
        "executed = ordered", "a scan as the manual has it", "safe outputs", "the watchdog is fed",
        "polls in time",      "the store is whole",          "the scenario"};
    return kNames[static_cast<std::size_t>(invariant)];
}

SoakRun::SoakRun(const sim::Program& program, std::uint64_t seed, Fault fault)
    : program_(program),
      fault_(fault),
      dice_(seed),
      naive_(program.table),
      world_(program.table, options(seed)),
      orders_(world_),
      person_(world_),
      starts_(world_.starts()) {
    constexpr std::uint64_t kSecond = 1;
    if (fault == Fault::erase_astray) storage_.lead_astray(kSecond);
}

sim::WorldOptions SoakRun::options(std::uint64_t seed) {
    sim::WorldOptions options{.seed = seed, .faults = {}, .gateway = {}};
    options.depth = sim::Servo::Depth::outer_loop;
    options.polling = sim::Polling::at_need;
    options.storage = &storage_;
    options.observer = this;
    return options;
}

void SoakRun::breach(Invariant invariant, const std::string& what) {
    if (!breach_) breach_ = {world_.now(), invariant, what};
}

std::optional<Breach> SoakRun::play(const Course& course, Time end) {
    half_ = end / 2;
    for (const Disturbance& what : course) {
        if (what.at >= end) break;
        go_on(what.at);
        if (breach_) return breach_;
        ++counted_.disturbances;
        act(what);
        after_step();
    }
    go_on(end);
    return breach_;
}

std::optional<Breach> SoakRun::play(const sim::Scenario& scenario) {
    sim::ScenarioRunner runner(scenario, program_.names, *this);
    const auto show = [&] {
        while (runner.observe(world_.take_snapshot())) after_step();
    };
    show();
    constexpr Time kEnd = 1h;
    while (!runner.ended() && !breach_ && world_.now() < kEnd) {
        go_on(std::min({runner.next_due().value_or(kEnd), kEnd, world_.now() + 1ms}));
        show();
    }
    runner.finish(world_.take_snapshot());
    if (runner.failures() != 0) breach(Invariant::scenario, "an expectation has failed");
    return breach_;
}

void SoakRun::go_on(Time until) {
    while (world_.now() < until && !breach_) {
        Time limit = until;
        if (const auto due = person_.next_due()) limit = std::min(limit, *due);
        world_.step(limit);
        person_.look();
        after_step();
    }
}

void SoakRun::after_step() {
    if (world_.starts() != starts_) {
        starts_ = world_.starts();
        scanned_since_start_ = false;
        scan_orders_.clear();
        orders_.restart();
        check_store(stored_.check());
    }
    if (std::exchange(was_ordered_, false)) static_cast<void>(world_.take_snapshot());
    excuse_alike();
    if (!world_.mac().orders().empty()) take_executed();
    if (orders_.has_open()) orders_.settle();
    if (!orders_.breach().empty()) breach(Invariant::orders, orders_.breach());
    if (world_.gateway().run_state() == gateway::RunState::stopped) scan_orders_.clear();
    if (world_.board().bites() != 0) breach(Invariant::watchdog, "it has bitten");
    if (person_.has_committed() || stored_.is_uploading())
        check_store(stored_.watch(person_.has_committed(), person_.uploads()));
    check_outputs();
    if (world_.now() >= next_heap_) note_heap();
}

void SoakRun::take_executed() {
    for (const sim::Order& order : world_.take_executed()) {
        const bool concerned =
            !sim::concerns_the_link_only(sim::as_sent(order, protocol::fastmac::RegisterCode::format_list));
        const bool faulty = concerned && armed_until_ > world_.now();
        if (faulty) armed_until_ = {};
        if (faulty && fault_ == Fault::order_lost) continue;
        orders_.executed(order);
        if (faulty && fault_ == Fault::order_twice) orders_.executed(order);
    }
}

void SoakRun::excuse_alike() {
    const std::uint64_t alike = world_.line().to_motor().counters().damaged_alike +
                                world_.line().from_motor().counters().damaged_alike;
    if (line_.excuses_orders(alike)) orders_.excuse(world_.now() + kExcuse);
}

void SoakRun::check_store(const std::string& wrong) {
    if (!wrong.empty()) breach(Invariant::store, wrong);
}

/// From the observed line and board; the state that the gateway reports is the last of four reasons.
void SoakRun::check_outputs() {
    if (world_.board().outputs() == kSafeOutputs) return;
    const auto say = [this](const char* why) {
        breach(Invariant::outputs, fmt::format("{} with outputs {:04b}", why, world_.board().outputs()));
    };
    if (line_.is_unreachable_for(kSafeAfter, world_.now())) return say("no line to the motor");
    if (!scanned_since_start_) return say("before the first scan");
    if (world_.gateway().run_state() == gateway::RunState::stopped) return say("stopped");
    if (world_.gateway().safe_reason() != gateway::SafeReason::none) return say("in the safe state");
}

void SoakRun::note_heap() {
    next_heap_ += 10min;
    std::uint64_t& most = world_.now() < half_ ? counted_.early_heap : counted_.late_heap;
    most = std::max<std::uint64_t>(most, ::mallinfo2().uordblks);
}

void SoakRun::cut_power() {
    if (storage_.cut_power(dice_)) ++counted_.torn;
    person_.forget();
    stored_.power_cut();
    world_.gateway(sim::action::Gateway::restart);
}

/// The second one has one term more, of a step that is never reached.
std::vector<std::uint8_t> SoakRun::table(unsigned which) const {
    std::vector<std::uint8_t> bytes = program_.table;
    if (which % 2 == 0) return bytes;
    constexpr std::array<std::uint8_t, 8> kOfStep62{0xFE, 0x00, 0x00, 0x3E, 0x80, 0x00, 0x00, 0x00};
    bytes.insert(bytes.end() - 8, kOfStep62.begin(), kOfStep62.end());
    return bytes;
}

void SoakRun::upload(unsigned which) {
    if (person_.uploads()) return;
    const std::vector<std::uint8_t> bytes = table(which);
    stored_.begin_upload(base::crc32(bytes));
    person_.upload(bytes);
}

void SoakRun::set_input(unsigned index, bool level) {
    world_.set_input(index, level);
}

void SoakRun::cut_line(bool cut) {
    const bool is_back = line_.cut(cut, world_.now());
    world_.cut_line(cut);
    if (is_back && fault_ == Fault::order_lost && (world_.board().inputs() & 2U) != 0)
        armed_until_ = world_.now() + kForgetful;
}

void SoakRun::power_motor(bool on) {
    const bool is_back = line_.power(on, world_.now());
    world_.power_motor(on);
    if (on) orders_.switched_on();
    if (is_back && fault_ == Fault::order_twice) armed_until_ = world_.now() + kForgetful;
}

void SoakRun::spoil_line(const sim::action::SpoilLine& faults) {
    line_.spoil(faults.damage);
    world_.spoil_line(faults);
}

void SoakRun::seed(std::uint64_t value) {
    world_.seed(value);
}

void SoakRun::gateway(sim::action::Gateway what) {
    if (what == sim::action::Gateway::restart) return cut_power();
    world_.gateway(what);
}

void SoakRun::act(const Disturbance& what) {
    const auto ask = [this](mactalk::Kind kind, std::uint8_t address, unsigned number,
                            std::uint8_t length = 0, std::uint32_t value = 0) {
        person_.ask({.kind = kind,
                     .address = address,
                     .reg = static_cast<std::uint8_t>(1 + number % 255),
                     .length = length,
                     .value = value});
    };
    const std::uint8_t motor = world_.motor_address();
    switch (what.kind) {
        case Kind::input:
            return set_input(what.value & 7U, (what.value & kInputOn) != 0);
        case Kind::cut:
            return cut_line(true);
        case Kind::restore:
            return cut_line(false);
        case Kind::spoil: {
            const BadLine bad = bad_line(what.value);
            return spoil_line({.drop = bad.drop,
                               .damage = bad.damage,
                               .framing = bad.framing,
                               .delay = bad.delay,
                               .longest_delay = bad.longest_delay});
        }
        case Kind::clean:
            return spoil_line({.drop = 0, .damage = 0, .framing = 0, .delay = 0, .longest_delay = {}});
        case Kind::motor_off:
            return power_motor(false);
        case Kind::motor_on:
            return power_motor(true);
        case Kind::motor_error:
            return fail_motor();
        case Kind::load:
            return act(sim::action::OnMotor{sim::action::LoadMotor{static_cast<int>(what.value)}});
        case Kind::stop:
            return gateway(sim::action::Gateway::stop);
        case Kind::run:
            return gateway(sim::action::Gateway::run);
        case Kind::power_cut:
            return cut_power();
        case Kind::read:
            return ask(mactalk::Kind::read, motor, what.value);
        case Kind::look:
            return ask(mactalk::Kind::read_block, reg::kDefaultAddress, what.value);
        case Kind::refused: {  // where it is taken, because the machine is stopped, it is a register that is
                               // not used
            constexpr std::uint8_t kP5 = 57;
            orders_.by_person(kP5, what.value & 0xFFFFU);
            return ask(mactalk::Kind::write, motor, kP5 - 1U, 2, what.value & 0xFFFFU);
        }
        case Kind::noise:
            return person_.noise(what.value);
        case Kind::force:
            return ask(mactalk::Kind::write, reg::kDefaultAddress, reg::FORCE_OUT - 1U, 4,
                       (what.value & 0xFU) | (what.value & 0xF0U) << 4);
        case Kind::upload:
            return upload(what.value);
    }
}

void SoakRun::ordered(base::Instant, const sequencer::MotorOrder& order) {
    was_ordered_ = true;
    scan_orders_.push_back(order);
    orders_.ordered(order);
}

void SoakRun::scanned(base::Instant, const sequencer::State& before, sequencer::InputImage image,
                      const sequencer::State& after) {
    ++counted_.scans;
    scanned_since_start_ = true;
    naive_.step = before.step;
    naive_.outputs = before.outputs;
    naive_.timer = before.timer;
    naive_.counter = before.counter;
    const auto wanted = naive_.scan(image);
    const bool same_timer =
        naive_.timer_was_preset ? after.timer == naive_.timer : after.timer <= before.timer;
    const bool same_orders =
        std::ranges::equal(scan_orders_, wanted, [](const sequencer::MotorOrder& a, const naive::Order& b) {
            if (a.is_register_write != b.flex) return false;
            return b.flex ? a.reg == b.number && a.value == static_cast<std::uint32_t>(b.value)
                          : a.command == b.number;
        });
    scan_orders_.clear();
    if (after.step != naive_.step || after.outputs != naive_.outputs || after.counter != naive_.counter ||
        !same_timer || !same_orders)
        breach(Invariant::scan, fmt::format("step {}, HW_INP {:02X}", before.step, image));
    if (world_.gateway().polls().late() != 0) breach(Invariant::polls, "one came late");
}

Statistics SoakRun::statistics() const {
    Statistics all = counted_;
    all.orders = orders_.count();
    all.stored = stored_.count();
    all.excused = orders_.excused();
    all.starts = world_.starts();
    all.answers = person_.answers();
    return all;
}

}  // namespace nplc::soak
