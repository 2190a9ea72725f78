#include "compiler/orders.h"

namespace nplc::seqc {

sequencer::MotorOrder order_of(const Send& send) {
    if (send.reg == nullptr) return {.command = send.command};
    const bool longword = registers::is_32_bit(send.reg->format);
    return {
        .is_register_write = true,
        .reg = send.reg->number,
        .longword = longword,
        .value = longword ? send.value : send.value & 0xFFFF,
    };
}

OrderKind kind_of(const Send& send) {
    const OrderKind kind = table::kind_of(order_of(send));
    return kind == OrderKind::stop && send.set_point != 0 ? OrderKind::speed : kind;
}

MotionEffect motion_effect_of(const Send& send) {
    return table::effect_of(kind_of(send));
}

const Send* motion_of(const Rule& rule) {
    for (const Send& send : rule.action.sends) {
        if (moves(motion_effect_of(send))) return &send;
    }
    return nullptr;
}

}  // namespace nplc::seqc
