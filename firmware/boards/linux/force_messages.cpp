#include "force_messages.h"

#include <fmt/format.h>

#include <utility>

namespace nplc::boards {

std::optional<LogMessage> ForceMessages::message(const gateway::EventLog::Entry& entry,
                                                 const gateway::ForcedIo& now) {
    using registers::gateway::Event;
    const auto event = static_cast<Event>(entry.event);
    if (event == Event::forces_ended) inputs_ = outputs_ = false;
    if (event != Event::forced) return in_words(entry);
    const bool of_inputs = entry.detail == registers::gateway::FORCE_IN;
    const bool is_forced = (of_inputs ? now.inputs() : now.outputs()).mask != 0;
    const bool was_forced = std::exchange(of_inputs ? inputs_ : outputs_, is_forced);
    if (is_forced) return in_words(entry);
    if (!was_forced) return std::nullopt;
    return LogMessage{LogLevel::notice,
                      fmt::format("forcing of {} has ended", of_inputs ? "inputs" : "outputs")};
}

}  // namespace nplc::boards
