#include "bare_metal/fault_reset.h"

#include "hal_mcu/cortex_m/core.h"
#include "hal_mcu/cortex_m/end_cause.h"
#include "hal_mcu/run_marker.h"
#include "hal_mcu/safe_levels.h"

namespace nplc::bare_metal {

using hal_mcu::EndCause;

namespace {

[[gnu::section(".noinit")]] hal_mcu::CrashRecord kept_crash;
[[gnu::section(".noinit.levels")]] hal_mcu::SafeLevels kept_levels;
[[gnu::section(".noinit")]] hal_mcu::RunMarker kept_run;

}  // namespace

std::uint8_t safe_outputs() {
    return kept_levels.get();
}

void keep_safe_outputs(std::uint8_t levels) {
    kept_levels.set(levels);
}

hal_mcu::CrashRecord& crash_record() {
    return kept_crash;
}

hal_mcu::RunMarker& run_marker() {
    return kept_run;
}

void reset_after_fault(EndCause cause, std::uint32_t code_address) {
    hal_mcu::cortex_m::forbid_interrupts();
    write_outputs(kept_levels.get());
    kept_crash.set(cause, code_address);
    hal_mcu::cortex_m::reset();
}

void reset_after_exception(std::uint32_t exception, unsigned watchdog, std::uint32_t code_address) {
    reset_after_fault(hal_mcu::cortex_m::end_cause(exception, watchdog), code_address);
}

}  // namespace nplc::bare_metal
