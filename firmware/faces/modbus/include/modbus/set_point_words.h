#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "faces/axis_model.h"
#include "modbus/map.h"

/// Set-points for a PLC: 32-bit integers, in the unit times 10^decimals.
namespace nplc::modbus {

/// A register's word, or an exception.
struct Word {
    Exception exception = Exception::none;
    std::uint16_t value = 0;
};

/// Two characters per word, the first one high; padded with 0.
Word text_word(const std::string& text, std::size_t word);

/// The set-point data of an axis.
struct SetPointLook {
    const faces::SetPointBook& book;
    const faces::AxisImage& image;
    bool low_word_first;
};

/// Input registers from kSetPointCount on; empty: other addresses.
std::optional<Word> set_point_input(const SetPointLook& look, std::uint16_t address);

/// Values that a client has written to its axis's holding registers and no command has taken yet.
class StagedSetPoints {
  public:
    /// Both words of a value must be in one request. Values that the table does not have are ignored.
    void write(const SetPointLook& look, std::size_t index, std::int32_t value);
    void forget() { *this = {}; }
    /// Content of a holding register: the written value, else the wanted one.
    Word word(const SetPointLook& look, std::uint16_t address) const;
    std::uint16_t written() const { return written_; }
    /// The request for SET_POINT_WRITE, without values that are already wanted. Empty: no change.
    std::vector<std::uint8_t> request(const SetPointLook& look) const;
    /// The values were written for the active table.
    bool are_of(const faces::SetPointBook& book) const { return record_crc_ == book.record_crc; }

  private:
    std::uint32_t record_crc_ = 0;
    std::uint16_t written_ = 0;
    std::array<std::int32_t, registers::gateway::kSetPoints> values_{};  ///< as written by the PLC
};

}  // namespace nplc::modbus
