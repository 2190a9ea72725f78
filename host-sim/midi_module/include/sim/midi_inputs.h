#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace nplc::sim {

enum class MidiInput : std::uint8_t { upper_stop, lower_stop, reference, security };

/// The four inputs of a MIDI module, and the switches at them that its shaft actuates.
class MidiInputs {
  public:
    static constexpr std::array kAll{MidiInput::upper_stop, MidiInput::lower_stop, MidiInput::reference,
                                     MidiInput::security};

    bool operator[](MidiInput input) const { return levels_[index(input)]; }
    /// True if that changes it.
    bool set(MidiInput input, bool active) {
        if (levels_[index(input)] == active) return false;
        levels_[index(input)] = active;
        return true;
    }
    /// Connects a switch that is active on one side of a shaft position.
    void connect(MidiInput input, bool on_above, std::int64_t at) {
        switches_[index(input)] = Switch{at, on_above};
    }
    void disconnect(MidiInput input) { switches_[index(input)].reset(); }
    /// The state of its switch at this shaft position; empty without a switch.
    std::optional<bool> switched(MidiInput input, std::int64_t shaft) const {
        const std::optional<Switch>& connected = switches_[index(input)];
        if (!connected) return std::nullopt;
        return connected->on_above ? shaft > connected->at : shaft < connected->at;
    }

  private:
    struct Switch {
        std::int64_t at;
        bool on_above;
    };
    static constexpr std::size_t index(MidiInput input) { return static_cast<std::size_t>(input); }

    std::array<bool, kAll.size()> levels_{};
    std::array<std::optional<Switch>, kAll.size()> switches_;
};

}  // namespace nplc::sim
