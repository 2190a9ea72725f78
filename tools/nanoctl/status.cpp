#include "nanoctl/status.h"

#include <fmt/format.h>

#include <algorithm>

#include "text/edit_distance.h"
#include "text/text.h"

namespace nplc::nanoctl {

using spelling::is_same;

namespace {

std::uint8_t byte_of(std::uint32_t value, unsigned shift) {
    return static_cast<std::uint8_t>(value >> shift);
}

std::optional<unsigned> number_of(const std::string& text, unsigned limit) {
    const auto number = spelling::whole_number(text);
    if (!number || *number < 0 || *number >= limit || text.size() > 2) return std::nullopt;
    return static_cast<unsigned>(*number);
}

/// By its name in `names`, or by `prefix` and its number.
template <class List>
std::optional<unsigned> find(const std::string& text, const std::string& prefix, const List* names,
                             unsigned count) {
    for (unsigned i = 0; names != nullptr && i < count; ++i) {
        if (!(*names)[i].empty() && is_same((*names)[i], text)) return i;
    }
    if (text.size() <= prefix.size() || !is_same(text.substr(0, prefix.size()), prefix)) return std::nullopt;
    return number_of(text.substr(prefix.size()), count);
}

}  // namespace

Status::Status(const Block& block)
    : bits(block[gw::STATUS - gw::STATUS]),
      run_state(gw::run_state_of(bits)),
      safe_reason(static_cast<gw::SafeReason>(block[gw::SAFE_REASON - gw::STATUS])),
      safe_since(block[gw::SAFE_SINCE - gw::STATUS]),
      uptime(block[gw::UPTIME - gw::STATUS]),
      step(byte_of(block[gw::STEP - gw::STATUS], 0)),
      timer(static_cast<std::uint16_t>(block[gw::TIMER - gw::STATUS])),
      counter(static_cast<std::uint16_t>(block[gw::COUNTER - gw::STATUS])),
      inputs(byte_of(block[gw::INPUTS - gw::STATUS], 0)),
      terminals(byte_of(block[gw::INPUTS - gw::STATUS], 8)),
      outputs(byte_of(block[gw::OUTPUTS - gw::STATUS], 0) & 0x0F),
      written_outputs(byte_of(block[gw::OUTPUTS - gw::STATUS], 8) & 0x0F),
      forced_outputs(byte_of(block[gw::OUTPUTS - gw::STATUS], 16) & 0x0F),
      scans(block[gw::SCANS - gw::STATUS]),
      scan_time(block[gw::SCAN_TIME - gw::STATUS]),
      scan_worst(block[gw::SCAN_WORST - gw::STATUS]),
      link(static_cast<gw::Link>(block[gw::LINK - gw::STATUS])),
      force_left(block[gw::FORCE_LEFT - gw::STATUS]),
      log_count(block[gw::LOG_COUNT - gw::STATUS]) {}

std::string Names::input(unsigned index) const {
    return symbols_ ? symbols_->symbols.inputs[index] : fmt::format("IN{}", index);
}

std::string Names::wire(unsigned index) const {
    return symbols_ ? seqc::wire_name(symbols_->symbols, index) : fmt::format("IN{}", index);
}

std::uint32_t Names::named(std::uint32_t inputs) const {
    return inputs ^ (symbols_ ? symbols_->symbols.inverted_inputs : 0U);
}

std::string Names::output(unsigned index) const {
    return symbols_ ? symbols_->symbols.outputs[index] : fmt::format("OUT{}", index);
}

std::string Names::step_name(unsigned number) const {
    return symbols_ && number < symbols_->symbols.steps.size() ? symbols_->symbols.steps[number]
                                                               : std::string();
}

std::string Names::step(unsigned number) const {
    const std::string name = step_name(number);
    return name.empty() ? std::to_string(number) : fmt::format("{} {}", number, name);
}

std::string Names::term_place(std::size_t term) const {
    if (!symbols_ || term >= symbols_->terms.size() || symbols_->terms[term].line == 0) return {};
    return fmt::format(" (line {})", symbols_->terms[term].line);
}

std::optional<unsigned> Names::find_input(const std::string& text) const {
    return find(text, "IN", symbols_ ? &symbols_->symbols.inputs : nullptr, 6);
}

std::optional<unsigned> Names::find_output(const std::string& text) const {
    return find(text, "OUT", symbols_ ? &symbols_->symbols.outputs : nullptr, 4);
}

std::optional<unsigned> Names::find_step(const std::string& text) const {
    if (const auto number = number_of(text, 63)) return number;
    return find(text, "STEP", symbols_ ? &symbols_->symbols.steps : nullptr, 63);
}

std::string Names::guess(const std::string& text, bool of_steps) const {
    if (!symbols_) return {};
    const seqc::Symbols& symbols = symbols_->symbols;
    std::vector<std::string_view> known;
    if (of_steps) {
        known.assign(symbols.steps.begin(), symbols.steps.end());
    } else {
        known.assign(symbols.inputs.begin(), symbols.inputs.end());
        known.insert(known.end(), symbols.outputs.begin(), symbols.outputs.end());
    }
    std::erase_if(known, [](std::string_view name) { return name.empty(); });
    const std::string_view meant = spelling::nearest(text, known);
    return meant.empty() ? std::string() : fmt::format("; did you mean {}?", meant);
}

std::uint64_t Names::with_copies(unsigned step) const {
    const auto number = static_cast<std::uint8_t>(step);
    return symbols_ ? seqc::with_copies(symbols_->symbols, number) : std::uint64_t{1} << step;
}

std::string signals_text(std::uint32_t bits, unsigned count, const Names& names, bool are_inputs) {
    std::string text;
    const std::uint32_t on = are_inputs ? names.named(bits) : bits;
    for (unsigned i = 0; i < count; ++i) {
        if ((on >> i & 1U) == 0) continue;
        text += (text.empty() ? "" : ", ") + (are_inputs ? names.input(i) : names.output(i));
    }
    return text.empty() ? "none" : text;
}

Fired read_fired(GatewayClient& gateway) {
    const Block about = gateway.read_block(gw::FIRED_SCAN);
    Fired fired{about[0], byte_of(about[1], 0), {}};
    for (unsigned half = 0; half < 2; ++half) {
        const Block words = gateway.read_block(static_cast<std::uint8_t>(gw::FIRED + 16 * half));
        for (unsigned i = 0; i < 512; ++i) {
            if ((words[i / 32] >> (i % 32) & 1U) != 0)
                fired.terms.push_back(static_cast<std::uint16_t>(512 * half + i));
        }
    }
    return fired;
}

std::vector<LogEntry> read_log(GatewayClient& gateway) {
    const std::uint32_t count = gateway.read(gw::LOG_COUNT);
    std::array<Block, 2> halves{gateway.read_block(gw::LOG), gateway.read_block(gw::LOG + 16)};
    std::vector<LogEntry> entries;
    const std::uint32_t held = std::min<std::uint32_t>(count, gw::kLogEntries);
    for (std::uint32_t number = count - held; number != count; ++number) {
        const unsigned slot = number % gw::kLogEntries;
        const Block& half = halves[slot / 8];
        const std::uint32_t what = half[2 * (slot % 8) + 1];
        if (what == 0) continue;
        entries.push_back({number, half[2 * (slot % 8)], byte_of(what, 0), byte_of(what, 8),
                           static_cast<std::uint16_t>(what >> 16)});
    }
    return entries;
}

}  // namespace nplc::nanoctl
