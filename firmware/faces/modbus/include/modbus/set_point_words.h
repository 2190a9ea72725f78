#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "faces/axis_model.h"
#include "modbus/map.h"

/// Set-points as a PLC sees them: whole numbers of 32 bits, in the unit times 10^decimals.
namespace nplc::modbus {

/// A word of a register, or why there is none.
struct Word {
    Exception exception = Exception::none;
    std::uint16_t value = 0;
};

/// Two characters a word, the first one high; filled up with 0.
Word text_word(const std::string& text, std::size_t word);

/// What set-points a look at an axis shows.
struct SetPointLook {
    const faces::SetPointBook& book;
    const faces::AxisImage& image;
    bool low_word_first;
};

/// Input registers from kSetPointCount on; nothing: it is none of them.
std::optional<Word> set_point_input(const SetPointLook& look, std::uint16_t address);

/// Values that a client has written to its axis's holding registers, and that no command has taken yet.
class StagedSetPoints {
  public:
    /// Both words of a value come in one request. What the table does not have is passed over.
    void write(const SetPointLook& look, std::size_t index, std::int32_t value);
    void forget() { *this = {}; }
    /// What the holding register shows: what was written, else the wanted value.
    Word word(const SetPointLook& look, std::uint16_t address) const;
    std::uint16_t written() const { return written_; }
    /// The request for SET_POINT_WRITE; of what is wanted already nothing. Empty: nothing is to be changed.
    std::vector<std::uint8_t> request(const SetPointLook& look) const;
    /// They were written for the table that is in use.
    bool are_of(const faces::SetPointBook& book) const { return record_crc_ == book.record_crc; }

  private:
    std::uint32_t record_crc_ = 0;
    std::uint16_t written_ = 0;
    std::array<std::int32_t, registers::gateway::kSetPoints> values_{};  ///< as the PLC wrote them
};

}  // namespace nplc::modbus
