#include "bare_metal/loader.h"

#include "hal_mcu/cortex_m/core.h"
#include "hal_mcu/cortex_m/image_start.h"

namespace nplc::bare_metal {

namespace core = hal_mcu::cortex_m;

void load(const LoaderParts& parts) {
    if (const auto start = update::choose(parts.choice)) {
        if (start->on_trial) parts.begin_watchdog();
        const std::uint32_t vectors = parts.choice.layout.address(start->slot);
        parts.use_vectors(vectors);
        core::start_image(vectors);
    }
    for (;;) core::sleep();
}

}  // namespace nplc::bare_metal
