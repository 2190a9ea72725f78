#include "motor/midi_session.h"

#include <algorithm>

#include "registers/midi.h"

namespace nplc::motor {
namespace {

namespace midi = registers::midi;

/// Failures in a row after which the link is down.
constexpr std::uint8_t kMostFailures = 3;
/// Interval of the messages while there is no answer.
constexpr base::Microseconds kProbe{100'000};
/// 000 §VI 00h: two seconds, with a margin.
constexpr base::Microseconds kDeaf{2'100'000};
/// Its longest answer, and time for the proof.
constexpr base::Microseconds kOthersShow{200'000};

}  // namespace

Link MidiSession::link() const {
    if (is_down()) return Link::down;
    if (!is_up()) return Link::starting;
    return link_error_ ? Link::unacknowledged : Link::up;
}

MidiNext MidiSession::start_up(bool stop_wanted, base::Instant now) {
    switch (phase_) {
        case Phase::down:
            if (now < next_query_) return MidiNext::nothing;
            next_query_ = now + kProbe;
            if (!stop_wanted || !blind_) return midi_query(midi::GET_STATUS);
            next_query_ = now + stop_pause();
            ignore_ = false;
            return midi_command(midi::EMERGENCY_STOP);
        case Phase::resetting:
            if (now < deaf_until_) return MidiNext::nothing;
            phase_ = Phase::status;
            [[fallthrough]];
        case Phase::status:
            return midi_query(midi::GET_STATUS);
        case Phase::imax:
            return midi_query(midi::GET_RAM, midi::kImaxAddress);
        case Phase::speeds:
            return midi_query(midi::GET_SPEEDS);
        case Phase::settings:
            return midi_query(midi::GET_SETTINGS);
        case Phase::position:
            return midi_query(midi::GET_POSITION);
        case Phase::up:
            break;
    }
    return MidiNext::nothing;
}

MidiNext MidiSession::next_query(bool needs_position, bool at_once, base::Instant now) {
    if (!at_once && now < next_query_) return MidiNext::nothing;
    turn_ = static_cast<std::uint8_t>(turn_ == 2 ? 0 : turn_ + 1);
    if (turn_ == 2 && needs_position) return midi_query(midi::GET_POSITION);
    if (turn_ == 2) turn_ = 0;
    return midi_query(turn_ == 0 ? midi::GET_STATUS : midi::GET_MEASURES);
}

base::Instant MidiSession::next_send(bool has_work, base::Instant now) const {
    if (phase_ == Phase::resetting) return deaf_until_;
    return is_down() || (is_up() && !has_work && !must_ask_) ? next_query_ : now;
}

bool MidiSession::note_failure() {
    return ++failures_ >= kMostFailures;
}

bool MidiSession::on_answer(base::Microseconds pause, base::Instant now) {
    must_ask_ = false;
    if (is_up()) {
        next_query_ = now + pause;
        return false;
    }
    phase_ = is_down() ? Phase::imax : static_cast<Phase>(static_cast<int>(phase_) + 1);
    if (!is_up()) return false;
    was_up_ = true;
    resetting_ = false;
    next_query_ = now;
    alone_at_ = now + kOthersShow;
    return true;
}

bool MidiSession::skips_refused() {
    if (phase_ != Phase::imax) return false;
    phase_ = Phase::speeds;
    return true;
}

bool MidiSession::lose(bool busy, bool stop_wanted, base::Instant now) {
    const bool is_error = was_up_;
    if (is_error) {
        link_error_ = true;
        ++losses_;
    }
    was_up_ = resetting_ = must_ask_ = false;
    phase_ = Phase::down;
    failures_ = 0;
    next_query_ = stop_wanted ? now : now + kProbe;
    ignore_ = busy;
    blind_ = true;
    return is_error;
}

/// 000 §VI 00h.
void MidiSession::begin_reset(base::Instant now) {
    link_error_ = must_ask_ = false;
    resetting_ = true;
    phase_ = Phase::resetting;
    deaf_until_ = now + kDeaf;
}

/// R: a restart is reported on CAN only; on a serial line it shows as two seconds without an answer.
bool MidiSession::on_boot(base::Instant now) {
    if (phase_ == Phase::resetting) {
        deaf_until_ = now;
        return false;
    }
    if (is_down()) next_query_ = now;
    return !is_down();
}

}  // namespace nplc::motor
