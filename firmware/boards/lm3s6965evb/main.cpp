// The gateway on a Stellaris LM3S6965: its pins, ports and storage areas.

#include "bare_metal/fault_reset.h"
#include "bare_metal/loader.h"
#include "bare_metal/run.h"
#include "flash_map.h"
#include "gateway/table_manager.h"
#include "hal_mcu/cortex_m/core.h"
#include "hal_mcu/cortex_m/start.h"
#include "hal_mcu/cortex_m/systick_clock.h"
#include "hal_mcu/i2c_memory.h"
#include "hal_mcu/stellaris/flash.h"
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

/// In the 32 KiB: the settings follow the tables, the set-points and recipes follow both.
constexpr store::Area kTableArea{.begin = 0, .slot_bytes = 8 * 1024};
constexpr store::Area kSettingsArea{.begin = 16 * 1024, .slot_bytes = 256};
constexpr store::Area kSetPointArea{.begin = 17 * 1024, .slot_bytes = 1024};
constexpr std::uint32_t kMactalkBaud = 19'200;  ///< of the motor's own MacTalk port

core::SysTickClock board_clock;
chip::InputPins inputs(chip::kPortD, {0, 1, 4, 5, 6, 7});
chip::OutputPins outputs(chip::kPortB, kOutputs);
chip::Watchdog watchdog;
chip::Uart user_line(chip::Uart::kUart0);
chip::Uart motor_line(chip::Uart::kUart1);
chip::Uart motor_mactalk_line(chip::Uart::kUart2);
chip::I2cMaster i2c;
hal_mcu::I2cMemory memory(i2c, board_clock, hal_mcu::I2cMemory::k24C256);
std::array<std::uint8_t, gateway::kTableMemory> table;

constinit const bare_metal::Parts kParts{.clock = board_clock,
                                         .inputs = inputs,
                                         .outputs = outputs,
                                         .watchdog = watchdog,
                                         .storage = memory,
                                         .user_line = &user_line,
                                         .motor_line = motor_line,
                                         .motor_mactalk_line = &motor_mactalk_line,
                                         .table_area = kTableArea,
                                         .settings_area = kSettingsArea,
                                         .table = table,
                                         .set_point_area = &kSetPointArea};

/// Outputs first.
void begin_chip() {
    if (chip::was_reset_from_outside()) bare_metal::run_marker().clear();
    const bool has_clock = chip::begin_clock();
    outputs.begin(bare_metal::safe_outputs());
    if (!has_clock) bare_metal::reset_after_fault(hal_mcu::EndCause::no_clock, 0);
    inputs.begin();
    board_clock.begin(chip::kHertz);
    core::allow_interrupts();
    i2c.begin_bus();
    static_cast<void>(memory.wait_until_ready());  // on a timeout, mounting reports the error
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

}  // namespace nplc::board

namespace nplc::bare_metal {

#if NPLC_UPDATE
update::Receiver& firmware_receiver() {
    using namespace board;
    static chip::Flash slots(chip::chip_flash(), kSlotsBegin, 2 * kSlotBytes);
    static update::Receiver receiver(slots, kSlots, kBoardId, running_slot(kSlots));
    return receiver;
}
#endif

void begin_lines(std::uint32_t user_baud, std::uint32_t motor_baud) {
    board::user_line.begin(user_baud);
    board::motor_line.begin(motor_baud);
    board::motor_mactalk_line.begin(board::kMactalkBaud);
}
bool has_received() {
    return board::user_line.has_received() || board::motor_line.has_received() ||
           board::motor_mactalk_line.has_received();
}
void begin_watchdog(base::Milliseconds time) {
    board::watchdog.begin(time);
}
void set_watchdog_time(base::Milliseconds time) {
    board::watchdog.set_time(time);
}
bool take_watchdog_reset() {
    return board::chip::take_watchdog_reset();
}
void write_outputs(std::uint8_t levels) {
    board::outputs.write(levels);
}

}  // namespace nplc::bare_metal

void run_firmware() {
    using namespace nplc::board;
    begin_chip();
    nplc::bare_metal::run(kParts);
}

void end_firmware(std::uint32_t exception, std::uint32_t code_address) {
    nplc::bare_metal::reset_after_exception(exception, nplc::board::chip::Watchdog::kInterrupt, code_address);
}
