// Counts what the firmware executes between two places, in instructions, under an emulator whose time is
// instructions.

#include "gateway/gateway.h"
#include "gateway/gateway_registers.h"
#include "gateway/user_port.h"
#include "hal_mcu/cortex_m/core.h"
#include "hal_mcu/cortex_m/start.h"
#include "hal_mcu/stellaris/uart.h"
#include "motor/jvl_motor.h"
#include "protocol/mactalk.h"
#include "semihosting.h"

namespace nplc::mcu_counts {
namespace {

namespace chip = hal_mcu::stellaris;

volatile std::uint32_t& systick(std::uint32_t offset) {
    return *reinterpret_cast<volatile std::uint32_t*>(0xE000'E010U + offset);
}

constexpr std::uint32_t kLargest = 0x00FF'FFFF;

void begin_counting() {
    systick(4) = kLargest;
    systick(8) = 0;
    systick(0) = 5;
}

template <class What>
[[gnu::noinline]] std::uint32_t ticks(What&& what) {
    const std::uint32_t begin = systick(8);
    what();
    return (begin - systick(8)) & kLargest;
}

/// Whole instructions: the timer's ticks are shorter.
template <class What>
std::uint32_t instructions(What&& what) {
    static const std::uint32_t nothing = ticks([] {});
    static const std::uint32_t thousand = ticks([] { asm volatile(".rept 1000\n\tnop\n\t.endr"); }) - nothing;
    return ((ticks(what) - nothing) * 1000U + thousand / 2) / thousand;
}

void print_row(const char* name, std::uint32_t count) {
    char text[12];
    char* at = text + sizeof(text) - 1;
    *at = '\0';
    do {
        *--at = static_cast<char>('0' + count % 10);
        count /= 10;
    } while (count != 0);
    mcu_units::print(name);
    mcu_units::print(": ");
    mcu_units::print(at);
    mcu_units::print("\n");
}

/// A line on which the count determines the received bytes.
struct Line final : ports::SerialPort {
    std::size_t write(std::span<const std::uint8_t> bytes) override { return bytes.size(); }
    std::size_t read(std::span<ports::ReceivedByte> out) override {
        std::size_t count = 0;
        for (; count < out.size() && !waiting.empty(); waiting = waiting.subspan(1))
            out[count++] = {waiting[0], false};
        return count;
    }
    bool transmitter_idle() override { return true; }

    std::span<const std::uint8_t> waiting;
};

struct Pins final : ports::DigitalInputs, ports::DigitalOutputs, ports::Watchdog {
    std::uint8_t read() override { return 0; }
    void write(std::uint8_t) override {}
    void feed() override {}
};

struct BlankStorage final : ports::Storage {
    ports::StorageGeometry geometry() const override {
        return {.size = 32 * 1024, .erase_block = 64, .program_page = 64, .program_unit = 1};
    }
    base::Status read(std::uint32_t, std::span<std::uint8_t> out) override {
        for (std::uint8_t& byte : out) byte = 0xFF;
        return {};
    }
    base::Status program(std::uint32_t, std::span<const std::uint8_t>) override { return {}; }
    base::Status erase(std::uint32_t) override { return {}; }
    ports::StorageState state() override { return ports::StorageState::ready; }
};

/// A drive that is always ready, so that the scan alone is counted.
struct ReadyMotor final : motor::Motor {
    void poll(base::Instant) override {}
    void begin_orders(base::Instant) override {}
    bool orders_complete() const override { return true; }
    bool can_execute(const motor::Order&) const override { return true; }
    bool has_room() const override { return true; }
    void send(const motor::Order&) override {}
    void stop() override {}
    bool stop_confirmed() const override { return true; }
    void give_up_stop() override {}
    bool begin_access(const motor::Access&) override { return false; }
    motor::AccessState access_state() const override { return motor::AccessState::none; }
    std::uint32_t access_value() const override { return 0; }
    void drop_access() override {}
    bool in_position() const override { return true; }
    bool error() const override { return false; }
    motor::Link link() const override { return motor::Link::up; }
    motor::Counters counters() const override { return {}; }
    bool longwords_only() const override { return false; }
};

constexpr std::uint8_t kSteps = 62;
std::array<std::uint8_t, (kSteps * 16 + 1) * sequencer::kTermBytes> table_bytes;

enum class True { none, last, all };

/// Every step has `terms` terms; one that is true sends, sets outputs, presets the timer and goes to the next
/// step.
std::span<const std::uint8_t> make_table(std::size_t terms, True which) {
    std::size_t at = 0;
    const auto add = [&at](const sequencer::Term& term) {
        for (const std::uint8_t byte : sequencer::encode(term)) table_bytes[at++] = byte;
    };
    for (std::uint8_t step = 0; step < kSteps; ++step) {
        for (std::size_t i = 0; i < terms; ++i) {
            const bool is_true = which == True::all || (which == True::last && i + 1 == terms);
            sequencer::Term term;
            term.condition = {.step = step, .input = static_cast<std::uint8_t>(is_true ? 0 : 1), .care = 1};
            term.fast.next_step = static_cast<std::uint8_t>((step + 1) % kSteps);
            term.fast.sends = true;
            term.fast.command = 0x20;
            term.fast.outputs = step & 0xFU;
            term.fast.preset = 1;
            add(term);
        }
    }
    sequencer::Term end;
    end.condition.step = sequencer::kEndOfTable;
    add(end);
    return std::span(table_bytes).first(at);
}

[[noreturn]] void fail(const char* what) {
    mcu_units::print(what);
    mcu_units::print("\n");
    mcu_units::exit(false);
}

/// The most of ten scans, of the engine alone and of the whole poll of the gateway.
void count_scan(std::size_t terms, True which, const char* engine_row, const char* poll_row) {
    Pins pins;
    ReadyMotor drive;
    gateway::Gateway sequence({pins, pins, pins, drive}, {.autostart = false}, gateway::StartCause::power_up);
    base::Instant now{base::Milliseconds(1000)};
    if (!sequence.load(make_table(terms, which), now).ok || !sequence.run()) fail("the table does not run");
    sequencer::Engine engine(sequence.table());
    std::uint32_t most = 0;
    std::uint32_t most_poll = 0;
    for (int scan = 0; scan < 10; ++scan) {
        most = std::max(most, instructions([&engine] {
                            engine.begin(0);
                            while (engine.next()) {
                            }
                            static_cast<void>(engine.finish());
                        }));
        now += base::Milliseconds(1);
        most_poll = std::max(most_poll, instructions([&sequence, now] { sequence.poll(now); }));
    }
    if (sequence.scans() < 5) fail("the table did not run");
    print_row(engine_row, most);
    print_row(poll_row, most_poll);
}

/// What one more byte costs that waits when the driver is polled.
void count_motor_bytes() {
    static Line line;
    static motor::JvlMotor drive(line, {});
    base::Instant now{base::Milliseconds(1000)};
    static constexpr std::array<std::uint8_t, 9> kStatus{0x10, 0x10, 0x10, 0x10, 0x10,
                                                         0x10, 0x10, 0x10, 0x10};
    const auto with = [&now](std::size_t count) {
        now += base::Milliseconds(5);
        line.waiting = std::span(kStatus).first(count);
        return instructions([&now] { drive.poll(now); });
    };
    static_cast<void>(with(2));
    print_row("poll of the motor's driver, nothing received", with(0));
    const std::uint32_t one = with(1);
    print_row("one more status byte of the motor", (with(9) - one) / 8);
}

void count_user_bytes() {
    static Pins pins;
    static ReadyMotor drive;
    static BlankStorage storage;
    static Line line;
    static gateway::SettingsManager settings(storage, {.begin = 16 * 1024, .slot_bytes = 256});
    settings.start({});
    static gateway::Gateway sequence({pins, pins, pins, drive}, {}, gateway::StartCause::power_up);
    settings.attach(sequence);
    static gateway::SetPointsPart set_points(sequence, storage, nullptr);
    static gateway::TableManager tables(sequence, drive, set_points, storage,
                                        {.begin = 0, .slot_bytes = 8 * 1024}, table_bytes);
    static gateway::GatewayRegisters registers(sequence, tables, set_points, settings, {});
    static gateway::UserPort port(&line, nullptr, sequence, drive, registers, settings);
    tables.mount();
    base::Instant now{base::Milliseconds(1000)};
    const auto with = [&now](std::span<const std::uint8_t> bytes) {
        now += base::Milliseconds(1);
        line.waiting = bytes;
        return instructions([&now] {
            registers.poll();
            port.poll(now);
        });
    };
    const auto request = protocol::mactalk::encode({.kind = protocol::mactalk::Kind::read_block,
                                                    .address = registers::gateway::kDefaultAddress,
                                                    .reg = 16});
    static_cast<void>(with({}));
    print_row("poll of the user's port, nothing received", with({}));
    std::uint32_t most = 0;
    for (std::size_t i = 0; i + 1 < request.size; ++i)
        most = std::max(most, with(request.view().subspan(i, 1)));
    print_row("poll of the user's port, a byte of a message", most);
    print_row("the last byte of a question for 16 registers, answered", with(request.view().last(1)));
}

std::uint32_t flags_of_uart0() {
    return *reinterpret_cast<volatile std::uint32_t*>(0x4000'C018U);
}

/// The emulator fills the chip's buffer when it likes, sometimes only after it was emptied, and goes on
/// meanwhile: counted is a call that found the buffer full and nothing more.
void wait_until_full() {
    constexpr std::uint32_t kFlagFull = 0x40;
    for (int i = 0; i < 400 && (flags_of_uart0() & kFlagFull) == 0; ++i) {
        for (int wait = 0; wait < 100'000; ++wait) asm volatile("nop");
    }
}

std::uint32_t count_full_buffer(chip::Uart& line) {
    constexpr int kMostTries = 500;
    constexpr std::size_t kFull = 16;
    for (int i = 0; i < kMostTries; ++i) {
        wait_until_full();
        const std::uint32_t count = instructions([&line] { line.on_interrupt(); });
        std::array<ports::ReceivedByte, 64> bytes;
        if (line.read(bytes) == kFull) return count;
    }
    fail("the line's buffer was never full");
}

void count_interrupts() {
    static chip::Uart line(chip::Uart::kUart0);
    constexpr std::uint32_t kEmpty = 0x10;
    constexpr std::uint32_t kBuffered8Bits = 0x70;
    while ((flags_of_uart0() & kEmpty) != 0) {
    }
    *reinterpret_cast<volatile std::uint32_t*>(0x4000'C02CU) = kBuffered8Bits;
    print_row("interrupt of a line, 16 characters received", count_full_buffer(line));
    constexpr std::array<std::uint8_t, 16> kBytes{};
    print_row("16 characters handed to a line",
              instructions([&kBytes] { static_cast<void>(line.write(kBytes)); }));
}

}  // namespace
}  // namespace nplc::mcu_counts

void run_firmware() {
    using namespace nplc::mcu_counts;
    nplc::hal_mcu::cortex_m::forbid_interrupts();
    begin_counting();
    count_scan(1, True::none, "scan, 62x1, nothing true", "poll with such a scan, 62x1");
    count_scan(1, True::last, "scan, 62x1, an order", "poll with that order, 62x1");
    count_scan(16, True::none, "scan, 62x16, nothing true", "poll with such a scan, 62x16");
    count_scan(16, True::last, "scan, 62x16, the last term's order", "poll with that order, 62x16");
    count_scan(16, True::all, "scan, 62x16, 16 orders", "poll with those orders, 62x16");
    count_motor_bytes();
    count_user_bytes();
    count_interrupts();
    nplc::mcu_units::exit(true);
}

void end_firmware(std::uint32_t, std::uint32_t) {
    nplc::mcu_counts::fail("a fault");
}
