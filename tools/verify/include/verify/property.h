#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// What a property says, in the words of a machine builder, and whether a scan fits a condition.
namespace nplc::verify {

/// What the numbers of a table are called. Steps without a name have an empty one.
struct Names {
    std::array<std::string, 63> steps;
    std::array<std::string, 6> inputs;
    std::array<std::string, 4> outputs;
};

/// A set of images of HW_INP, one bit for each of the 256.
using ImageSet = std::bitset<256>;

/// What a condition sees of a finished scan beside its image.
struct View {
    std::uint8_t step = 0;
    std::uint8_t outputs = 0;
    bool timer_zero = true;
    bool counter_zero = true;
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
        negation,
        all_of,
        any_of,
        odd_of,
    };
    Kind kind = Kind::constant;
    std::uint8_t number = 0;  ///< constant: 0 or 1
    std::vector<Condition> operands;
};

/// The images with which a scan that ends in `view` fits.
ImageSet images_where(const Condition& condition, const View& view);
bool holds(const Condition& condition, std::uint8_t image, const View& view);
/// Bits of HW_INP that the condition names.
std::uint8_t image_bits_of(const Condition& condition);

enum class Form : std::uint8_t { never, always, reachable, always_possible, whenever };

struct Property {
    std::string name;
    std::string text;  ///< as written, blanks made single
    Form form = Form::never;
    Condition condition;
    Condition then{};             ///< whenever
    std::uint32_t within_ms = 0;  ///< whenever
};

struct PropertyReading {
    std::vector<Property> properties;
    std::string error;     ///< what is wrong, and what to write; empty if nothing is
    std::size_t line = 0;  ///< of the error, from 1
};

/// A file of properties: `PROPERTY Name: FORM;` one after the other, comments as in programs.
PropertyReading read_properties(std::string_view text, const Names& names);

}  // namespace nplc::verify
