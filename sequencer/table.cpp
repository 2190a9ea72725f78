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
            return "the motor has no such order; a MAC800 takes register writes with LONGWORD = 1 only; of a "
                   "MIDI drive, compiling with MOTOR MAC34 in the program says which and why";
        default:
            return "not a fault of a table";
    }
}

void Table::note(std::uint8_t step, std::uint16_t index) {
    if (end_[step] == 0) begin_[step] = index;
    end_[step] = static_cast<std::uint16_t>(index + 1);
}

std::optional<TableFault> TableRules::take(TermView term) {
    ended_ = is_end(term);
    if (ended_) return std::nullopt;
    if (terms_ == kMaxTerms) return TableFault{base::Error::no_space, terms_};
    if (const auto fault = fault_of(term)) return TableFault{*fault, terms_};
    ++terms_;
    return std::nullopt;
}

std::optional<TableFault> TableRules::finish(std::size_t rest) const {
    if (ended_) return std::nullopt;
    return TableFault{rest == 0 ? base::Error::table_no_end : base::Error::table_ragged, terms_};
}

std::optional<TableFault> Table::assign(std::span<const std::uint8_t> bytes) {
    clear();
    bytes_ = bytes.data();
    TableRules rules;
    for (; bytes.size() >= kTermBytes; bytes = bytes.subspan(kTermBytes)) {
        const TermView term = bytes.first<kTermBytes>();
        const auto fault = rules.take(term);
        if (fault) clear();
        if (fault || rules.ended()) return fault;
        note(step_of(term), size_);
        size_ = rules.terms();
    }
    clear();
    return rules.finish(bytes.size());
}

Table::LoadResult Table::load(std::span<const std::uint8_t> bytes) {
    LoadResult result;
    const auto fault = result.table.assign(bytes);
    result.ok = !fault;
    if (fault) result.fault = *fault;
    return result;
}

}  // namespace nplc::sequencer
