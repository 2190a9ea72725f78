#include "random_tables.h"

#include <array>

namespace nplc::property {
namespace {

using TermBytes = std::array<std::uint8_t, 8>;

void set(std::uint8_t& byte, std::uint8_t mask, unsigned value) {
    byte = static_cast<std::uint8_t>((byte & ~mask) | (value & mask));
}

TermBytes any_bytes(Dice& dice) {
    TermBytes term;
    for (auto& byte : term) byte = dice.byte();
    return term;
}

void make_valid(TermBytes& term, Dice& dice) {
    if ((term[0] & 0x3F) == 0x3F) set(term[0], 0x3F, dice.below(63));
    if ((term[2] & 0x80) != 0) {
        if ((term[3] & 0x7F) == 0) set(term[3], 0x7F, 1 + dice.below(127));
    } else if ((term[3] & 0x3F) == 0x3F) {
        set(term[3], 0x3F, dice.below(63));
    }
}

/// A term of one of `steps` steps, comparing at most `compared` of HW_INP's bits besides ERROR.
TermBytes lively(Dice& dice, unsigned steps, unsigned compared) {
    TermBytes term = any_bytes(dice);
    set(term[0], 0x3F, dice.below(steps));
    if (!dice.one_in(3)) set(term[0], 0xC0, 0xC0);
    set(term[1], 0x80, dice.one_in(8) ? 0x80 : 0);
    const bool is_flex = dice.one_in(6);
    term[2] = is_flex ? 0x80 : 0;
    for (unsigned i = 0; i < dice.below(compared + 1); ++i) {
        term[2] = static_cast<std::uint8_t>(term[2] | (1U << dice.below(7)));
    }
    if (!is_flex) {
        set(term[3], 0x3F, dice.one_in(3) ? 0x3E : dice.below(steps));
        if (!dice.one_in(3)) set(term[5], 0x40, 0);
        if (dice.one_in(2)) {
            term[6] = 0;
            term[7] = 0;
        } else if (dice.one_in(2)) {
            term[6] = static_cast<std::uint8_t>(1 + dice.below(4));
            term[7] = 0;
        }
    }
    make_valid(term, dice);
    return term;
}

TermBytes shaped(Shape shape, Dice& dice) {
    switch (shape) {
        case Shape::dense:
            return lively(dice, 3, 2);
        case Shape::many_true:
            return lively(dice, 1, 1);
        case Shape::scattered: {
            TermBytes term = lively(dice, 3, 2);
            if (!dice.one_in(3)) set(term[0], 0x3F, 3 + dice.below(60));
            return term;
        }
        case Shape::uniform:
            break;
        case Shape::arbitrary:
            return any_bytes(dice);
    }
    TermBytes term = any_bytes(dice);
    make_valid(term, dice);
    return term;
}

}  // namespace

std::vector<std::uint8_t> random_table(Shape shape, Dice& dice) {
    std::vector<std::uint8_t> bytes;
    const unsigned terms = shape == Shape::scattered ? dice.below(40) : dice.below(16);
    for (unsigned i = 0; i < terms; ++i) {
        const TermBytes term = shaped(shape, dice);
        bytes.insert(bytes.end(), term.begin(), term.end());
    }
    if (shape != Shape::arbitrary || !dice.one_in(4)) {
        TermBytes end = any_bytes(dice);
        set(end[0], 0x3F, 0x3F);
        bytes.insert(bytes.end(), end.begin(), end.end());
    }
    // What follows the end counts for nothing.
    for (unsigned i = 0; shape != Shape::dense && i < dice.below(20); ++i) bytes.push_back(dice.byte());
    return bytes;
}

}  // namespace nplc::property
