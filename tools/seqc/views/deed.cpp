#include "views/deed.h"

#include <fmt/format.h>

#include "views/words.h"

namespace nplc::seqc {
namespace {

std::string counter_text(const Deed& deed) {
    switch (deed.counter) {
        case CounterChange::none:
            break;
        case CounterChange::clear:
            return "clears the counter";
        case CounterChange::preset:
            return fmt::format("sets COUNTER := {}", deed.counter_preset);
        case CounterChange::count_down:
            return "counts down";
    }
    return {};
}

std::string outputs_text(const KnownOutputs& outputs, const Symbols* symbols) {
    std::string text;
    for (std::uint8_t bit = 0; bit < 4; ++bit) {
        if (((outputs.known >> bit) & 1) == 0) continue;
        append(
            text,
            fmt::format("{} {}", output_name(bit, symbols), ((outputs.value >> bit) & 1) != 0 ? "on" : "off"),
            ", ");
    }
    return text.empty() ? text : "has " + text;
}

}  // namespace

bool Deed::operator==(const Deed& other) const {
    return next_id == other.next_id && orders == other.orders && timer == other.timer &&
           counter == other.counter && counter_preset == other.counter_preset && outputs == other.outputs;
}

Deed deed_of(const Outcome& outcome, std::size_t c) {
    Deed deed;
    deed.orders = outcome.orders;
    deed.timer = outcome.timer;
    deed.counter = outcome.counter;
    deed.counter_preset = outcome.counter_preset;
    const bool counter_zero = ((c >> kCounterZero) & 1) != 0;
    if (counter_zero && deed.counter != CounterChange::preset) deed.counter = CounterChange::none;
    return deed;
}

std::string text_of(const Deed& deed, const Symbols* symbols) {
    std::vector<std::string> parts;
    const auto add = [&](std::string part) {
        if (!part.empty()) parts.push_back(std::move(part));
    };
    std::string orders;
    for (const auto& order : deed.orders) append(orders, order_text(order, symbols), ", ");
    add(orders.empty() ? "" : "sends " + orders);
    add(deed.timer == 0 ? "" : fmt::format("sets TIMER := T#{}ms", deed.timer));
    add(counter_text(deed));
    add(outputs_text(deed.outputs, symbols));
    add(deed.kept_outputs == 0 ? "" : "keeps " + outputs_list(deed.kept_outputs, symbols));
    add(deed.next.empty() ? "" : "goes to " + deed.next);
    std::string text;
    for (std::size_t i = 0; i < parts.size(); ++i)
        append(text, parts[i], i + 1 == parts.size() ? " and " : ", ");
    return text.empty() ? "nothing" : text;
}

}  // namespace nplc::seqc
