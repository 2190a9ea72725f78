#include "bare_metal/loader.h"

extern "C" const std::uint8_t link_image_begin;

namespace nplc::bare_metal {

unsigned running_slot(const update::Layout& slots) {
    return reinterpret_cast<std::uint32_t>(&link_image_begin) == slots.address(1) ? 1 : 0;
}

}  // namespace nplc::bare_metal
