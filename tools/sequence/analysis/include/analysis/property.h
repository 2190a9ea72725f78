#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sequencer/state.h"

/// Properties in a machine builder's terms, and whether a scan fulfils a condition.
namespace nplc::verify {

/// Names for the numbers of a table. Steps without a name have an empty one.
struct Names {
    std::array<std::string, 63> steps;
    std::array<std::string, 6> inputs;
    std::array<std::string, 4> outputs;
    /// A bit for each input whose name holds while the bit of the image is off.
    std::uint8_t inverted_inputs = 0;
    /// The step of which it is a copy: `step = Name` includes the copies.
    std::array<std::optional<std::uint8_t>, 63> copy_of = {};
    /// A bit for each step that the compiler made for what a branch does a scan later, asking nothing again.
    std::uint64_t helpers = 0;
    /// A bit for each step that does not wait for its timer: it limits the step (WITHIN) or makes it blink.
    std::uint64_t timer_is_limit = 0;
    /// With names and units; none: bytes and numbers.
    std::function<std::string(const sequencer::MotorOrder&)> order = {};
};

/// A set of images of HW_INP, one bit for each of the 256.
using ImageSet = std::bitset<256>;
/// Those that have a bit of HW_INP on.
const ImageSet& images_with_bit(std::size_t bit);

/// What a condition depends on besides the image of a finished scan.
struct View {
    std::uint8_t step = 0;
    std::uint8_t outputs = 0;
    bool timer_zero = true;
    bool counter_zero = true;
    bool moving = false;  ///< a move was commanded, and no end of it was detected
    bool operator==(const View&) const = default;
};

struct Condition {
    enum class Kind : std::uint8_t {
        constant,
        image,  ///< bit `number` of HW_INP: an input, INPOS, ERROR
        output,
        timer_q,
        counter_q,
        step,
        moving,
        negation,
        all_of,
        any_of,
        odd_of,
    };
    Kind kind = Kind::constant;
    std::uint8_t number = 0;  ///< constant: 0 or 1
    std::vector<Condition> operands;
};

/// The images with which a scan that ends in `view` fulfils the condition.
ImageSet images_where(const Condition& condition, const View& view);
bool holds(const Condition& condition, std::uint8_t image, const View& view);
/// Bits of HW_INP that the condition names.
std::uint8_t image_bits_of(const Condition& condition);

bool names_moving(const Condition& condition);

enum class Form : std::uint8_t {
    never,
    always,
    reachable,
    always_possible,
    whenever,
    after_possible,   ///< AFTER then ALWAYS POSSIBLE condition
    never_while,      ///< NEVER condition WHILE then FOR within_ms
    only_after,       ///< condition ONLY AFTER then
    stays,            ///< BETWEEN condition AND then third STAYS ON
    changes_only_in,  ///< condition CHANGES ONLY IN then
    scan_ends,        ///< EVERY_SCAN FROM condition ENDS IN then
    followed_by,      ///< WHENEVER condition FOLLOWED BY then THEN third
    only_from,        ///< condition ONLY FROM then
    only_after_both,  ///< condition ONLY AFTER then FOLLOWED BY third
};

struct Property {
    std::string name;
    std::string text;  ///< as written, blanks made single
    Form form = Form::never;
    Condition condition;
    Condition then{};
    Condition third{};
    std::uint32_t within_ms = 0;
    bool is_implied = false;  ///< a WHENEVER without a time: its left side is `condition`'s first operand
};

/// An assumption.
struct Assumption {
    std::string text;
    Condition never{};            ///< of inputs, INPOS and ERROR alone; false if it is about something else
    std::uint8_t input = 0;       ///< 0..5, keeps its level
    std::uint32_t stable_ms = 0;  ///< minimum duration; 0 if it is no such assumption
    std::uint32_t move_ms = 0;    ///< a move to a place ends within; 0 if it is about something else
};

}  // namespace nplc::verify
