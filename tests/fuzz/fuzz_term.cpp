// Eight bytes become a term and the same eight bytes again; a term's fields stay within their bits.

#include <algorithm>
#include <cstdlib>

#include "sequencer/term.h"

using namespace nplc;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    for (std::size_t at = 0; at + sequencer::kTermBytes <= size; at += sequencer::kTermBytes) {
        const sequencer::TermView view(data + at, sequencer::kTermBytes);
        const sequencer::Term term = sequencer::decode(view);
        if (!std::ranges::equal(sequencer::encode(term), view)) std::abort();
        if (term.condition.step > sequencer::kEndOfTable || term.condition.care > 0x7F) std::abort();
        if (!term.is_flex && (term.fast.next_step > 0x3F || term.fast.outputs > 0x0F)) std::abort();
        if (term.is_flex && term.flex.reg > 0x7F) std::abort();
    }
    return 0;
}
