// Holds one of everything that a gateway's firmware holds, and calls what it calls, so that the size of the
// image is the size of the core. A new part of the core gets an object and a call here.

#include <cstdint>

#include "sequencer/term.h"

namespace nplc {
namespace {

// The line stands for every input and output: what is fed from it and ends in it cannot be optimised away.
volatile std::uint8_t line = 0;

template <class T>
void keep(const T& value) {
    asm volatile("" : : "r"(&value) : "memory");
}

sequencer::TermBytes term_bytes;

void probe_sequencer(std::uint8_t byte) {
    term_bytes[byte % sequencer::kTermBytes] = byte;
    const sequencer::Term term = sequencer::decode(term_bytes);
    keep(term);
    keep(sequencer::encode(term));
}

}  // namespace
}  // namespace nplc

void run_firmware() {
    for (;;) {
        const std::uint8_t byte = nplc::line;
        nplc::probe_sequencer(byte);
    }
}
