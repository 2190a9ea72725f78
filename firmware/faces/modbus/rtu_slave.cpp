#include "rtu_slave.h"

#include <algorithm>
#include <utility>

namespace nplc::modbus {
namespace {

/// An adapter delivers characters in groups; a shorter pause does not end a frame.
constexpr base::Milliseconds kLumps{20};
constexpr base::Milliseconds kBriefly{1};

}  // namespace

RtuSlave::RtuSlave(const Options& options, const faces::Axes& axes)
    : gap_(protocol::modbus::silence_between_frames(options.baud)),
      set_(axes, options.settings, options.unit) {}

void RtuSlave::join(faces::Bell& bell, base::Instant now) {
    set_.join(bell);
    session_.emplace(set_.units(), "Modbus RTU", bell);
    heard_ = now;
}

base::Instant RtuSlave::due(base::Instant now) const {
    base::Instant due = now + UnitSet::kTick;
    if (reader_.is_under_way()) due = std::min(due, heard_ + gap_ + kLumps);
    if (frame_ && sent_ != 0) due = std::min(due, now + kBriefly);
    if (frame_ && sent_ == 0 && !reader_.is_under_way()) due = std::min(due, heard_ + gap_);
    if (asked_) due = std::min(due, now + kBriefly);
    if (session_ && session_->is_waiting()) due = std::min(due, now + UnitSet::kBetweenLooks);
    return due;
}

void RtuSlave::take(std::span<const ports::ReceivedByte> bytes, base::Instant arrived, base::Instant now) {
    if (bytes.empty() && reader_.is_under_way() && now - heard_ > gap_ + kLumps) {
        if (reader_.silence()) note_frame(arrived, now);
        return;
    }
    if (bytes.empty()) return;
    hear_another(now);
    heard_ = now;
    for (const ports::ReceivedByte& byte : bytes) {
        if (byte.framing_error) {
            reader_.damaged();
            continue;
        }
        const bool is_stop = finder_.take(byte.value);
        if (reader_.take(byte.value))
            note_frame(arrived, now);
        else if (is_stop)
            note_stop(now);
    }
}

/// Characters behind the silence that ended the request are another message, damaged or not; those before it
/// may be a driver that is switched off.
void RtuSlave::hear_another(base::Instant now) {
    if (is_pending() && sent_ == 0 && now - request_ended_ > gap_ + kLumps) give_up(now);
}

/// Carries out what is pending, without an answer: the master waits for it no longer.
void RtuSlave::give_up(base::Instant now) {
    frame_.reset();
    sent_ = 0;
    asked_.reset();
    if (session_->is_waiting()) static_cast<void>(session_->put_aside());
    if (request_size_ != 0) static_cast<void>(hand_over(now));
    if (session_->is_waiting()) static_cast<void>(session_->put_aside());
}

void RtuSlave::note_frame(base::Instant arrived, base::Instant now) {
    give_up(now);
    if (reader_.unit() == kBroadcast) {
        for (const faces::Command& stop : stops_in(reader_.pdu(), now)) set_.stop_all(stop);
        return;
    }
    if (!set_.index_of(reader_.unit())) return;
    unit_ = reader_.unit();
    request_ended_ = now;
    request_arrived_ = arrived;
    request_size_ = reader_.pdu().size();
    std::copy(reader_.pdu().begin(), reader_.pdu().end(), request_.begin());
}

/// Outside of a frame: carried out without an answer, for who is to answer here is not certain.
void RtuSlave::note_stop(base::Instant now) {
    give_up(now);
    const bool is_for_all = finder_.unit() == kBroadcast;
    const auto index = set_.index_of(finder_.unit());
    for (const faces::Command& stop : stops_in(finder_.pdu(), now)) {
        if (is_for_all) set_.stop_all(stop);
        if (!is_for_all && index) set_.stop(*index, stop);
    }
}

std::optional<Answer> RtuSlave::hand_over(base::Instant now) {
    const std::span<const std::uint8_t> pdu = std::span(request_).first(std::exchange(request_size_, 0));
    return session_->serve(unit_, pdu, {.now = now, .arrived = request_arrived_});
}

/// Answers once there is a recent image.
void RtuSlave::serve(base::Instant now) {
    if (!asked_) asked_ = now;
    if (!set_.is_fresh(now) && now - *asked_ < UnitSet::kImageWait) return;
    asked_.reset();
    if (const auto at_once = hand_over(now)) answer(*at_once);
}

void RtuSlave::poll(base::Instant now) {
    if (request_size_ != 0) serve(now);
    if (const auto ended = session_->take(now)) answer(*ended);
    set_.watch_masters(now);
}

std::span<const std::uint8_t> RtuSlave::out(base::Instant now) const {
    if (!frame_ || (sent_ == 0 && (now < heard_ + gap_ || reader_.is_under_way()))) return {};
    return frame_->bytes().subspan(sent_);
}

void RtuSlave::note_sent(std::size_t count) {
    sent_ += count;
    if (sent_ < frame_->bytes().size()) return;
    frame_.reset();
    sent_ = 0;
}

}  // namespace nplc::modbus
