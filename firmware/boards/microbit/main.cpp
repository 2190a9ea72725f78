// The gateway on a BBC micro:bit v1: its pins and storage areas, and the use of its one UART.

#include "bare_metal/fault_reset.h"
#include "bare_metal/loader.h"
#include "bare_metal/run.h"
#include "flash_map.h"
#include "gateway/table_manager.h"
#include "hal_mcu/cortex_m/core.h"
#include "hal_mcu/cortex_m/start.h"
#include "hal_mcu/no_line.h"
#include "hal_mcu/nrf51/flash.h"
#include "hal_mcu/nrf51/pins.h"
#include "hal_mcu/nrf51/system.h"
#include "hal_mcu/nrf51/timer_clock.h"
#include "hal_mcu/nrf51/uart.h"
#include "hal_mcu/nrf51/watchdog.h"
#include "interrupts.h"

namespace nplc::board {
namespace {

namespace core = hal_mcu::cortex_m;
namespace chip = hal_mcu::nrf51;

constexpr store::Area kTableArea{.begin = 0, .slot_bytes = 9 * chip::Flash::kPage};
constexpr store::Area kSettingsArea{.begin = 18 * chip::Flash::kPage, .slot_bytes = chip::Flash::kPage};

// Chip pins; edge connector pins in brackets.
constexpr std::uint8_t kButtonA = 17;
constexpr chip::Uart::Pins kUsb{.receive = 25, .transmit = 24};         // of the interface chip
constexpr chip::Uart::Pins kMotor{.receive = 2, .transmit = 3};         // [1, 0]
constexpr std::array<std::uint8_t, 6> kInputs{18, 20, 23, 22, 21, 16};  // [8, 12 to 16]

chip::TimerClock board_clock;
chip::InputPins inputs(kInputs);
chip::OutputPins outputs(kOutputs);
chip::Watchdog watchdog;
chip::Uart line;
hal_mcu::NoLine no_line;
chip::Flash flash(kStorageBegin, kStoragePages* chip::Flash::kPage);
std::array<std::uint8_t, gateway::kTableMemory> table;
bool serves_person = false;

/// Outputs first.
void begin_chip() {
    if (chip::was_reset_from_outside()) bare_metal::run_marker().clear();
    outputs.begin(bare_metal::safe_outputs());
    chip::begin_crystal();
    inputs.begin();
    serves_person = chip::is_pulled_low(kButtonA);
    board_clock.begin();
    core::allow_interrupts();
}

}  // namespace

void on_timer1() {
    watchdog.on_tick(chip::TimerClock::on_interrupt());
}
void on_uart0() {
    line.on_interrupt();
}

}  // namespace nplc::board

namespace nplc::bare_metal {

#if NPLC_UPDATE
update::Receiver& firmware_receiver() {
    using namespace board;
    static chip::Flash slots(kSlotsBegin, 2 * kSlotBytes);
    static update::Receiver receiver(slots, kSlots, kBoardId, running_slot(kSlots));
    return receiver;
}
#endif

void begin_lines(std::uint32_t user_baud, std::uint32_t motor_baud) {
    if (board::serves_person) {
        board::line.begin(board::kUsb, user_baud);
    } else {
        board::line.begin(board::kMotor, motor_baud);
    }
}
bool has_received() {
    return board::line.has_received();
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
    nplc::ports::SerialPort& uart = line;
    nplc::ports::SerialPort& nobody = no_line;
    nplc::bare_metal::run({.clock = board_clock,
                           .inputs = inputs,
                           .outputs = outputs,
                           .watchdog = watchdog,
                           .storage = flash,
                           .user_line = serves_person ? &uart : nullptr,
                           .motor_line = serves_person ? nobody : uart,
                           .motor_mactalk_line = nullptr,
                           .table_area = kTableArea,
                           .settings_area = kSettingsArea,
                           .table = table,
                           .for_service = serves_person});
}

void end_firmware(std::uint32_t exception, std::uint32_t code_address) {
    nplc::bare_metal::reset_after_exception(exception, nplc::board::chip::Watchdog::kInterrupt, code_address);
}
