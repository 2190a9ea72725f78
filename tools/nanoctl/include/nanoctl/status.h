#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nanoctl/gateway_client.h"
#include "seqc/symbol_file.h"

namespace nplc::nanoctl {

/// Registers 16 to 31, decoded (firmware/gateway/REGISTERS.md).
struct Status {
    explicit Status(const Block& block);

    bool has(gw::StatusBit bit) const { return (bits & bit) != 0; }

    std::uint32_t bits;
    gw::RunState run_state;
    gw::SafeReason safe_reason;
    std::uint32_t safe_since;  ///< ms, on the time scale of uptime
    std::uint32_t uptime;      ///< ms
    std::uint8_t step;
    std::uint16_t timer;  ///< ms
    std::uint16_t counter;
    std::uint8_t inputs;     ///< as the sequence sees them
    std::uint8_t terminals;  ///< of the inputs, debounced
    std::uint8_t outputs;
    std::uint8_t written_outputs;  ///< by the sequence
    std::uint8_t forced_outputs;
    std::uint32_t scans;
    std::uint32_t scan_time;   ///< us
    std::uint32_t scan_worst;  ///< us
    gw::Link link;
    std::uint32_t force_left;  ///< ms
    std::uint32_t log_count;
};

/// Names of steps, inputs and outputs: from a symbol file, else IN2 and OUT0.
class Names {
  public:
    Names() = default;
    explicit Names(const seqc::SymbolFile& symbols) : symbols_(symbols) {}

    std::string input(unsigned index) const;
    /// What is true while the wire is on: "START", "NOT ESTOP".
    std::string wire(unsigned index) const;
    bool is_inverted(unsigned index) const { return (named(0) >> index & 1U) != 0; }
    /// The levels of the inputs as what their names say.
    std::uint32_t named(std::uint32_t inputs) const;
    std::string output(unsigned index) const;
    /// "3 FILL", "3".
    std::string step(unsigned number) const;
    /// Only its name; empty without one.
    std::string step_name(unsigned number) const;
    /// " (line 12)" for a term of the program, or nothing.
    std::string term_place(std::size_t term) const;

    /// By name in any case, or IN2, OUT0, 3.
    std::optional<unsigned> find_input(const std::string& text) const;
    std::optional<unsigned> find_output(const std::string& text) const;
    std::optional<unsigned> find_step(const std::string& text) const;
    /// "; did you mean Feed?" of the steps, else of the inputs and outputs; empty without a guess.
    std::string guess(const std::string& text, bool of_steps) const;
    /// A bit for the step and for each copy that the compiler made of it.
    std::uint64_t with_copies(unsigned step) const;

  private:
    std::optional<seqc::SymbolFile> symbols_;
};

/// "START, IN2": of inputs those whose names are true; "none".
std::string signals_text(std::uint32_t bits, unsigned count, const Names& names, bool are_inputs);

/// The terms that were true in the last scan, from 0.
struct Fired {
    std::uint32_t scan;
    std::uint8_t step;
    std::vector<std::uint16_t> terms;
};
Fired read_fired(GatewayClient& gateway);

struct LogEntry {
    std::uint32_t number;  ///< since the start, from 0
    std::uint32_t uptime;  ///< ms
    std::uint8_t event;
    std::uint8_t step;
    std::uint16_t detail;
};
/// The last entries, 16 at the most, oldest first.
std::vector<LogEntry> read_log(GatewayClient& gateway);

}  // namespace nplc::nanoctl
