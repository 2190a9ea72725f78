#include "analysis/property.h"

#include <algorithm>

namespace nplc::verify {
namespace {

std::array<ImageSet, 8> make_bits() {
    std::array<ImageSet, 8> bits;
    for (std::size_t image = 0; image < 256; ++image) {
        for (std::size_t bit = 0; bit < 8; ++bit) bits[bit][image] = ((image >> bit) & 1U) != 0;
    }
    return bits;
}

ImageSet constant(bool value) {
    return value ? ~ImageSet{} : ImageSet{};
}

}  // namespace

const ImageSet& images_with_bit(std::size_t bit) {
    static const std::array<ImageSet, 8> bits = make_bits();
    return bits[bit];
}

ImageSet images_where(const Condition& condition, const View& view) {
    using Kind = Condition::Kind;
    switch (condition.kind) {
        case Kind::constant:
            return constant(condition.number != 0);
        case Kind::image:
            return images_with_bit(condition.number);
        case Kind::output:
            return constant(((view.outputs >> condition.number) & 1U) != 0);
        case Kind::timer_q:
            return constant(view.timer_zero);
        case Kind::counter_q:
            return constant(view.counter_zero);
        case Kind::step:
            return constant(view.step == condition.number);
        case Kind::moving:
            return constant(view.moving);
        case Kind::negation:
            return ~images_where(condition.operands[0], view);
        case Kind::all_of:
        case Kind::any_of:
        case Kind::odd_of:
            break;
    }
    ImageSet result = images_where(condition.operands[0], view);
    for (std::size_t i = 1; i < condition.operands.size(); ++i) {
        const ImageSet next = images_where(condition.operands[i], view);
        if (condition.kind == Kind::all_of) {
            result &= next;
        } else if (condition.kind == Kind::any_of) {
            result |= next;
        } else {
            result ^= next;
        }
    }
    return result;
}

bool holds(const Condition& condition, std::uint8_t image, const View& view) {
    return images_where(condition, view)[image];
}

bool names_moving(const Condition& condition) {
    return condition.kind == Condition::Kind::moving ||
           std::any_of(condition.operands.begin(), condition.operands.end(), names_moving);
}

std::uint8_t image_bits_of(const Condition& condition) {
    unsigned bits = condition.kind == Condition::Kind::image ? 1U << condition.number : 0U;
    for (const Condition& operand : condition.operands) bits |= image_bits_of(operand);
    return static_cast<std::uint8_t>(bits);
}

}  // namespace nplc::verify
