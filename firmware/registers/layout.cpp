#include "registers/layout.h"

namespace nplc::registers {

const Register* holder_of(Model model, std::uint8_t number) {
    for (const Register& entry : map_of(model)) {
        if (overlap(cells_of(model, entry), {number, 1})) return &entry;
    }
    return nullptr;
}

bool is_second_half(Model model, std::uint8_t number) {
    const Register* holder = holder_of(model, number);
    return holder != nullptr && holder->number != number;
}

}  // namespace nplc::registers
