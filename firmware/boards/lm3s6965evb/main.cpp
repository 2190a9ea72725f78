// The gateway on a Stellaris LM3S6965: which pins and ports it has, and in what order it starts.

#include "gateway/chosen_motor.h"
#include "gateway/gateway.h"
#include "gateway/own_registers.h"
#include "gateway/user_port.h"
#include "hal_mcu/cortex_m/core.h"
#include "hal_mcu/cortex_m/start.h"
#include "hal_mcu/cortex_m/systick_clock.h"
#include "hal_mcu/crash_record.h"
#include "hal_mcu/i2c_memory.h"
#include "hal_mcu/stellaris/i2c_master.h"
#include "hal_mcu/stellaris/pins.h"
#include "hal_mcu/stellaris/system_clock.h"
#include "hal_mcu/stellaris/uart.h"
#include "hal_mcu/stellaris/watchdog.h"
#include "interrupts.h"

namespace nplc::board {
namespace {

namespace core = hal_mcu::cortex_m;
namespace chip = hal_mcu::stellaris;
using hal_mcu::CrashRecord;
using hal_mcu::EndCause;

/// Of the 32 KiB: the settings behind the table.
constexpr store::Area kTableArea{.begin = 0, .slot_bytes = 8 * 1024};
constexpr store::Area kSettingsArea{.begin = 16 * 1024, .slot_bytes = 256};
constexpr base::Milliseconds kBeyondLongestWait{500};  ///< of the scan, until the watchdog bites
/// Two slots of the store looked at and one loaded take 0.7 s at most on the memory's line.
constexpr base::Milliseconds kStartUp{3'000};
constexpr std::uint32_t kMactalkBaud = 19'200;  ///< of the motor's own MacTalk port

/// The outputs' safe values, for what happens before the settings are read and when nothing works any more.
struct SafeLevels {
    std::uint32_t levels;
    std::uint32_t check;
    std::uint8_t get() const { return check == ~levels ? static_cast<std::uint8_t>(levels & 0xFU) : 0; }
    void set(std::uint8_t safe) {
        levels = safe;
        check = ~levels;
    }
};

[[gnu::section(".noinit")]] CrashRecord crash_record;
[[gnu::section(".noinit")]] SafeLevels safe_levels;

core::SysTickClock board_clock;
chip::InputPins inputs(chip::kPortD, {0, 1, 4, 5, 6, 7});
chip::OutputPins outputs(chip::kPortB, {0, 1, 5, 6});
chip::Watchdog watchdog;
chip::Uart user_line(chip::Uart::kUart0);
chip::Uart motor_line(chip::Uart::kUart1);
chip::Uart motor_mactalk_line(chip::Uart::kUart2);
chip::I2cMaster i2c;
hal_mcu::I2cMemory memory(i2c, board_clock, hal_mcu::I2cMemory::k24C256);
std::array<std::uint8_t, (sequencer::kMaxTerms + 1) * sequencer::kTermBytes> table;

[[noreturn]] void give_up(EndCause cause, std::uint32_t code_address) {
    core::forbid_interrupts();
    outputs.write(safe_levels.get());
    crash_record.set(cause, code_address);
    core::reset();
}

/// Outputs first.
void begin_chip() {
    const bool has_clock = chip::begin_clock();
    outputs.begin(safe_levels.get());
    if (!has_clock) give_up(EndCause::no_clock, 0);
    inputs.begin();
    board_clock.begin(chip::kHertz);
    core::allow_interrupts();
    i2c.begin_bus();
    static_cast<void>(memory.wait_until_ready());  // if it does not, mounting says so
}

gateway::StartCause start_cause() {
    const bool bitten = chip::take_watchdog_reset();
    if (bitten && !crash_record.valid()) crash_record.set(EndCause::watchdog, 0);
    return crash_record.valid() ? gateway::StartCause::watchdog : gateway::StartCause::power_up;
}

void note_crash(gateway::Gateway& sequence) {
    if (!crash_record.valid()) return;
    sequence.note(gateway::Event::gave_up, static_cast<std::uint16_t>(crash_record.cause()));
    sequence.note(gateway::Event::gave_up_at, static_cast<std::uint16_t>(crash_record.code_address()));
    crash_record.clear();
}

/// Longer than a scan may wait for the motor, which a user can change.
base::Milliseconds watchdog_time(const gateway::SettingsKeeper& settings) {
    return base::Milliseconds(settings.get(store::Setting::longest_wait)) + kBeyondLongestWait;
}

/// Until an interrupt has brought something; a millisecond at the most.
void rest() {
    core::forbid_interrupts();
    if (!user_line.has_received() && !motor_line.has_received() && !motor_mactalk_line.has_received())
        core::sleep();
    core::allow_interrupts();
}

/// The answer to the reset command shall leave the line, if it takes it.
[[noreturn]] void restart() {
    constexpr base::Milliseconds kLongestAnswer{20};
    const base::Instant asked = board_clock.now();
    while (!user_line.transmitter_idle() && board_clock.now() - asked < kLongestAnswer) rest();
    core::reset();
}

}  // namespace

void on_systick() {
    board_clock.on_interrupt();
}
void on_uart0() {
    user_line.on_interrupt();
}
void on_uart1() {
    motor_line.on_interrupt();
}
void on_uart2() {
    motor_mactalk_line.on_interrupt();
}
void on_i2c0() {
    i2c.on_interrupt();
}

[[noreturn]] void run() {
    begin_chip();
    static gateway::SettingsKeeper settings(memory, kSettingsArea);
    settings.start({});
    user_line.begin(settings.get(store::Setting::user_baud));
    motor_line.begin(settings.get(store::Setting::motor_baud));
    motor_mactalk_line.begin(kMactalkBaud);
    base::Milliseconds bites_after = kStartUp;
    watchdog.begin(bites_after);

    static gateway::ChosenMotor chosen(motor_line, settings.values());
    motor::Motor& drive = chosen.motor();
    static gateway::Gateway sequence({inputs, outputs, watchdog, drive},
                                     gateway::settings_of(settings.values()), start_cause());
    settings.attach(sequence);
    note_crash(sequence);
    static gateway::TableKeeper tables(sequence, drive, memory, kTableArea, table);
    static gateway::OwnRegisters registers(sequence, tables, settings);
    static gateway::UserPort user_port(user_line, &motor_mactalk_line, sequence, drive, registers, settings);
    static_cast<void>(tables.mount());
    tables.start(board_clock.now());

    for (;;) {
        const base::Instant now = board_clock.now();
        sequence.poll(now);
        user_port.poll(now);
        safe_levels.set(sequence.settings().safe_outputs);
        if (watchdog_time(settings) != bites_after) watchdog.set_time(bites_after = watchdog_time(settings));
        if (registers.reset_asked()) restart();
        rest();
    }
}

/// `exception`: as the core numbers them; the chip's interrupts from 16 on.
[[noreturn]] void end(std::uint32_t exception, std::uint32_t code_address) {
    constexpr std::uint32_t kFirstInterrupt = 16;
    switch (exception) {
        case 3:
            give_up(EndCause::hard_fault, code_address);
        case 4:
            give_up(EndCause::memory_fault, code_address);
        case 5:
            give_up(EndCause::bus_fault, code_address);
        case 6:
            give_up(EndCause::usage_fault, code_address);
        case 11:
            give_up(EndCause::pure_call, code_address);
        case kFirstInterrupt + chip::Watchdog::kInterrupt:
            give_up(EndCause::watchdog, code_address);
        default:
            give_up(EndCause::stray_interrupt, code_address);
    }
}

}  // namespace nplc::board

void run_firmware() {
    nplc::board::run();
}

void end_firmware(std::uint32_t exception, std::uint32_t code_address) {
    nplc::board::end(exception, code_address);
}
