#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "faces/points.h"
#include "protocol/modbus_pdu.h"
#include "registers/modbus_map.h"

namespace nplc::modbus {

using namespace protocol::modbus;

/// A row of the map with a value of the axis.
struct ValueRow {
    Space space;
    std::uint16_t address;
    std::uint8_t words;     ///< 1 or 2; 1 for a bit
    std::string_view name;  ///< name of the point
    double steps = 1;       ///< register steps per unit
    bool is_signed = false;
    unsigned highest = 0;  ///< 0: what fits into it
    const faces::Point* point = nullptr;
};

/// In ascending order within each space.
std::span<const ValueRow> value_rows();
/// The row that contains the address; null: none.
const ValueRow* find_row(Space space, std::uint16_t address);
/// The second word of a 32-bit value: a request that begins or ends before it would cut the value in two.
bool is_second_word(Space space, unsigned address);

using namespace registers::modbus;
inline constexpr std::uint16_t kHoldings = kSetPointsNew + 2 * registers::gateway::kSetPoints;

/// Input registers of the set-points.
enum SetPointInput : std::uint16_t {
    kSetPointCount = 200,
    kSetPointState = 201,
    kActiveRecipe = 202,
    kRecipeRoom = 203,
    kSetPointRecord = 204,   ///< two words
    kSetPointChanges = 206,  ///< two words
    kSetPointValues = 210,   ///< two words each
    kSetPointTexts = 300,    ///< kTextWords each
    kRecipeNames = 820,      ///< kRecipeWords each
};
/// Offsets within the text of a set-point.
enum SetPointText : std::uint16_t {
    kTextOfLowest = 0,
    kTextOfHighest = 2,
    kTextOfDefault = 4,
    kTextOfStep = 6,
    kTextOfDecimals = 8,
    kTextOfUnit = 10,
    kTextOfName = 16,
    kTextWords = 32,
};
/// Input registers with the cause of a standstill; to be read in a separate block, as they may be unknown.
enum WhyInput : std::uint16_t {
    kWhy = 900,  ///< the point `why`
    kWhySeverity = 901,
    kWhyText = 902,
    kWhyEnd = 1000,
};
inline constexpr std::uint16_t kRecipeWords = 8;
inline constexpr std::uint16_t kRecipes = 8;

/// The whole map with a header line: address, block, name, type, words, scale (the value is the number in the
/// words times it), unit, range (of the value), meaning, access. Quoted as in RFC 4180.
std::string map_as_csv(const faces::Scaling& scaling, registers::Model model);
/// The same as a table for the documentation, without the motor's registers; of set-points and recipes the
/// first one.
std::string map_as_markdown();

}  // namespace nplc::modbus
