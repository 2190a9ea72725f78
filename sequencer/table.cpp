#include "sequencer/table.h"

#include <optional>

namespace nplc::sequencer {
namespace {

std::optional<base::Error> fault_of(TermView bytes) {
    const Term term = decode(bytes);
    if (term.is_flex) {
        if (term.flex.reg == 0) return base::Error::bad_register;
    } else if (term.fast.next_step == kEndOfTable) {
        return base::Error::bad_next_step;
    }
    return std::nullopt;
}

Table::LoadResult refuse(base::Error error, std::size_t term) {
    return {.ok = false, .table = {}, .fault = {error, static_cast<std::uint16_t>(term)}};
}

}  // namespace

std::string_view describe(base::Error table_error) {
    switch (table_error) {
        case base::Error::table_ragged:
            return "the table ends inside this term; a term has 8 bytes";
        case base::Error::table_no_end:
            return "the table has no end; its last term must have STATE 3Fh";
        case base::Error::no_space:
            return "the table has more than 1024 terms";
        case base::Error::bad_next_step:
            return "NEXT_STATE is 3Fh; a step is 0..61, 3Eh means no switch";
        case base::Error::bad_register:
            return "REG_NMB is 0; a register is 1..127";
        case base::Error::not_for_motor:
            return "the motor has no such order; a MAC800 takes register writes with LONGWORD = 1 only";
        default:
            return "not a fault of a table";
    }
}

void Table::note(std::uint8_t step, std::uint16_t index) {
    if (end_[step] == 0) begin_[step] = index;
    end_[step] = static_cast<std::uint16_t>(index + 1);
}

Table::LoadResult Table::load(std::span<const std::uint8_t> bytes) {
    LoadResult result{.ok = true, .table = {}, .fault = {}};
    Table& table = result.table;
    table.bytes_ = bytes.data();
    for (std::size_t offset = 0;; offset += kTermBytes) {
        const std::size_t index = offset / kTermBytes;
        if (offset == bytes.size()) return refuse(base::Error::table_no_end, index);
        if (bytes.size() - offset < kTermBytes) return refuse(base::Error::table_ragged, index);
        const TermView term = bytes.subspan(offset).first<kTermBytes>();
        if (is_end(term)) return result;
        if (index == kMaxTerms) return refuse(base::Error::no_space, index);
        if (const auto fault = fault_of(term)) return refuse(*fault, index);
        table.note(step_of(term), static_cast<std::uint16_t>(index));
        table.size_ = static_cast<std::uint16_t>(index + 1);
    }
}

}  // namespace nplc::sequencer
