#include "shared_line/shared_line.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/bytes.h"
#include "registers/gateway.h"
#include "seat/secret.h"

namespace nplc::boards {

namespace gw = registers::gateway;
namespace mactalk = protocol::mactalk;

namespace {

using Time = SharedLine::Time;

/// Samples are 8 or 16 bytes: over once nothing more comes.
constexpr Time kSilenceAfterSamples = std::chrono::milliseconds{20};
/// A stop is answered at once or, like a hold of what does not run, never.
constexpr Time kStopAnswer = std::chrono::milliseconds{50};
/// At 19200 baud, the user's port's own speed.
constexpr Time kCharacter = std::chrono::microseconds{521};
constexpr std::size_t kMostWaiting = 16;  ///< of one client

bool is_for_somebody(std::uint8_t address, const SharedLine::Addresses& addresses) {
    return address == addresses.gateway || address == addresses.motor || address == mactalk::kEveryone;
}

std::uint32_t result_word(gw::Result result, std::uint8_t reg, std::uint16_t detail = 0) {
    return static_cast<std::uint32_t>(result) | std::uint32_t{reg} << 8 | std::uint32_t{detail} << 16;
}

bool is_hold(std::uint32_t command) {
    return command == static_cast<std::uint32_t>(gw::Command::hold);
}

/// The gateway ends it as it ends, and tells how (REGISTERS.md, Set-points).
bool is_for_set_points(const mactalk::Request& request, std::uint8_t gateway) {
    return request.address == gateway && request.reg == gw::SET_POINT_WRITE;
}

std::vector<std::uint8_t> bytes_of(const mactalk::Request& request, std::span<const std::uint8_t> data) {
    if (request.length > 4) {
        const auto encoded = mactalk::encode_long_write(request.address, request.reg, data);
        return {encoded.view().begin(), encoded.view().end()};
    }
    const auto encoded = mactalk::encode(request);
    return {encoded.view().begin(), encoded.view().end()};
}

}  // namespace

SharedLine::SharedLine(hal_linux::ByteServer& server, faces::Seat* operators, std::string password)
    : server_(server),
      operators_(operators),
      password_(std::move(password)),
      seats_(server.seats()),
      last_(seats_.size() - 1) {
    for (Seat& seat : seats_) seat.sitter = faces::Seat::new_number();
}

SharedLine::~SharedLine() {
    if (operators_ == nullptr) return;
    for (const Seat& seat : seats_) operators_->leave(seat.sitter);
}

/// Who has left operates no more.
void SharedLine::let_go() {
    if (operators_ == nullptr || operators_->holder() == nullptr) return;
    for (std::size_t i = 0; i < seats_.size(); ++i) {
        if (seats_[i].sitter == operators_->holder()->number && server_.has_left(i))
            return operators_->leave(seats_[i].sitter);
    }
}

void SharedLine::welcome(Seat& seat, std::size_t number, std::uint64_t visit) {
    if (operators_ != nullptr) operators_->leave(seat.sitter);
    seat = Seat{};
    seat.visit = visit;
    seat.sitter = faces::Seat::new_number();
    if (asking_ != number) return;
    asker_is_gone_ = true;
    until_ = std::min(until_, sent_ + kBriefly);
}

void SharedLine::listen(std::size_t number, Time now, std::uint8_t gateway_address) {
    std::array<std::uint8_t, 4096> bytes;
    Seat& seat = seats_[number];
    if (const auto visit = server_.visit(number); visit != seat.visit) {
        welcome(seat, number, visit);
        seat.drained = looked_.value_or(now);
    }
    seat.decoder.take_long_writes(gateway_address);
    const std::size_t count = server_.read_seat(number, bytes);
    for (const std::uint8_t byte : std::span(bytes).first(count)) take_byte(number, byte, gateway_address);
    if (count < bytes.size()) seat.drained = now;
}

void SharedLine::take_byte(std::size_t number, std::uint8_t byte, std::uint8_t gateway_address) {
    Seat& seat = seats_[number];
    const auto request = seat.decoder.receive(byte);
    if (!request) return;
    server_.note_message(number);
    if (!password_.empty() && is_about_password(number, *request, gateway_address)) return;
    Frame frame{*request, purpose_of(*request, gateway_address), seat.drained,
                bytes_of(*request, seat.decoder.data()), needs_seat(*request, gateway_address)};
    std::erase_if(seat.frames, [](const Frame& waiting) { return waiting.purpose == Purpose::reads; });
    if (frame.purpose == Purpose::stops) return take_stop(number, std::move(frame));
    if (seat.frames.size() < kMostWaiting) seat.frames.push_back(std::move(frame));
}

/// True: it is answered, and does not go onto the line.
bool SharedLine::is_about_password(std::size_t number, const mactalk::Request& request,
                                   std::uint8_t gateway_address) {
    using enum gw::PasswordState;
    if (request.address != gateway_address) return false;
    Seat& seat = seats_[number];
    if (request.kind == mactalk::Kind::read && request.reg == gw::PASSWORD_STATE) {
        const std::uint8_t state[4]{static_cast<std::uint8_t>(seat.has_password ? given : wanted)};
        server_.write_seat(number, mactalk::encode_registers(gw::PASSWORD_STATE, state).view());
        return true;
    }
    if (request.kind != mactalk::Kind::write || request.reg != gw::PASSWORD) return false;
    take_password(number, seat.decoder.data());
    return true;
}

void SharedLine::take_password(std::size_t number, std::span<const std::uint8_t> given) {
    Seat& seat = seats_[number];
    std::string text(given.begin(), given.end());
    text.erase(std::min(text.find_last_not_of('\0') + 1, text.size()));
    seat.has_password = faces::same_secret(text, password_);
    seat.refused.reset();
    if (seat.has_password) return server_.write_seat(number, mactalk::encode_accept().view());
    seat.refused = result_word(gw::Result::no_password, gw::PASSWORD);
    ++wrong_passwords_;
}

/// What its client sent before is over with it.
void SharedLine::take_stop(std::size_t number, Frame frame) {
    Seat& seat = seats_[number];
    seat.frames.clear();
    seat.refused.reset();
    const bool waits_already = std::any_of(stops_.begin(), stops_.end(), [&](const Stop& stop) {
        return stop.visit == seat.visit && stop.frame.request == frame.request;
    });
    if (!waits_already) stops_.push_back({number, seat.visit, std::move(frame)});
}

/// While an answer is to come only the same client may go on, and only once.
std::optional<std::size_t> SharedLine::next_seat() const {
    if (asking_) {
        const bool goes_on = !asked_again_ && !asker_is_gone_ && !seats_[*asking_].frames.empty();
        return goes_on ? asking_ : std::nullopt;
    }
    for (std::size_t i = 1; i <= seats_.size(); ++i) {
        const std::size_t number = (last_ + i) % seats_.size();
        if (!seats_[number].frames.empty()) return number;
    }
    return std::nullopt;
}

/// A hold may come to nothing and is then not answered: stop and safe go before it.
std::optional<SharedLine::Stop> SharedLine::next_stop() {
    if (stops_.empty() || (asking_ && asked_.purpose == Purpose::stops)) return std::nullopt;
    auto next = std::find_if(stops_.begin(), stops_.end(),
                             [](const Stop& stop) { return !is_hold(stop.frame.request.value); });
    if (next == stops_.end()) next = stops_.begin();
    Stop stop = std::move(*next);
    stops_.erase(next);
    return stop;
}

std::vector<std::uint8_t> SharedLine::begin_stop(const Stop& stop, Time now, const Addresses& addresses) {
    const auto refuse = [](Seat& seat, const Frame& frame) {
        if (frame.purpose == Purpose::operates)
            seat.refused = result_word(gw::Result::too_late, frame.request.reg);
        return frame.purpose == Purpose::operates;
    };
    if (asking_ && !asker_is_gone_ && !is_for_set_points(asked_.request, addresses.gateway))
        refuse(seats_[*asking_], asked_);
    asking_.reset();
    for (std::size_t i = 0; i < seats_.size(); ++i) {
        Seat& seat = seats_[i];
        if (i != stop.seat)
            std::erase_if(seat.frames, [&](const Frame& frame) { return refuse(seat, frame); });
    }
    expect(stop.seat, stop.frame, now, addresses);
    until_ = sent_ + kStopAnswer;
    asker_is_gone_ = seats_[stop.seat].visit != stop.visit;
    return stop.frame.bytes;
}

/// What RESULT reads then.
std::optional<std::uint32_t> SharedLine::refusal(std::size_t number, const Frame& frame, Time now) {
    if (frame.needs_seat && !password_.empty() && !seats_[number].has_password)
        return result_word(gw::Result::no_password, frame.request.reg);
    if (now - frame.since > kLongestUnread || server_.has_left(number))
        return result_word(gw::Result::too_late, frame.request.reg);
    if (!frame.needs_seat || operators_ == nullptr) return std::nullopt;
    const base::Instant instant{std::chrono::duration_cast<base::Microseconds>(now)};
    const auto verdict = operators_->take(
        {seats_[number].sitter, faces::Side::person, "client of " + server_.name()}, instant);
    if (verdict == faces::Seat::Verdict::granted) return std::nullopt;
    return result_word(gw::Result::seat_taken, frame.request.reg, faces::detail_of(verdict));
}

/// True: it is dealt with, and does not go onto the line.
bool SharedLine::refuses(std::size_t number, const Frame& frame, Time now) {
    Seat& seat = seats_[number];
    const mactalk::Request& request = frame.request;
    if (frame.purpose == Purpose::operates) {
        seat.refused = refusal(number, frame, now);
        return seat.refused.has_value();
    }
    if (!seat.refused || request.kind != mactalk::Kind::read || request.reg != gw::RESULT) return false;
    std::array<std::uint8_t, mactalk::kReadBytes> result{};
    base::store_u32(result.data(), *seat.refused);
    server_.write_seat(number, mactalk::encode_registers(gw::RESULT, result).view());
    return true;
}

std::vector<std::uint8_t> SharedLine::to_line(Time now, const Addresses& addresses) {
    static_cast<void>(server_.has_client());  // lets them in
    for (std::size_t number = 0; number < seats_.size(); ++number) listen(number, now, addresses.gateway);
    let_go();
    looked_ = now;
    if (asking_ && now >= until_) end_turn(samples_);
    if (const auto stop = next_stop()) return begin_stop(*stop, now, addresses);
    while (const auto next = next_seat()) {
        const Frame frame = std::move(seats_[*next].frames.front());
        seats_[*next].frames.pop_front();
        if (refuses(*next, frame, now)) continue;
        expect(*next, frame, now, addresses);
        return frame.bytes;
    }
    return {};
}

Time SharedLine::next_turn(Time now) const {
    if (!looked_ || next_seat()) return now;
    const bool waits = asking_ && asked_.purpose == Purpose::stops;
    if (!waits && !stops_.empty()) return now;
    const bool is_drained = std::all_of(seats_.begin(), seats_.end(),
                                        [this](const Seat& seat) { return seat.drained == *looked_; });
    if (!is_drained) return now;
    const Time next_look = *looked_ + kBetweenLooks;
    return asking_ ? std::min(next_look, until_) : next_look;
}

void SharedLine::expect(std::size_t number, const Frame& frame, Time now, const Addresses& addresses) {
    const mactalk::Answer answer = mactalk::answer_to(frame.request.kind);
    const bool again = asking_.has_value();
    if (again) end_turn(false);
    last_ = number;
    asker_is_gone_ = false;
    if (answer == mactalk::Answer::none || !is_for_somebody(frame.request.address, addresses)) return;
    asking_ = number;
    asked_ = {frame.request, frame.purpose, frame.since, {}};
    asked_again_ = again;
    sent_ = now + kCharacter * static_cast<int>(frame.bytes.size());
    until_ = seats_[number].unanswered ? sent_ + kBriefly : now + kLongestAnswer;
    samples_ = answer == mactalk::Answer::samples;
    const bool is_block = frame.request.kind == mactalk::Kind::read_block;
    const std::size_t bytes = is_block ? mactalk::kBlockBytes : mactalk::kReadBytes;
    answer_.expect(answer, answer == mactalk::Answer::registers ? bytes : 0);
}

void SharedLine::end_turn(bool answered) {
    if (!asker_is_gone_) seats_[*asking_].unanswered = !answered;
    asking_.reset();
    asker_is_gone_ = false;
}

/// An answer that nobody waits for any more may have been for someone who left.
void SharedLine::from_line(std::span<const std::uint8_t> bytes, Time now) {
    if (bytes.empty()) return;
    if (!asker_is_gone_) server_.write_seat(asking_.value_or(last_), bytes);
    if (!asking_) return;
    if (samples_) until_ = now + kSilenceAfterSamples;
    for (const std::uint8_t byte : bytes) {
        if (!samples_ && asking_ && answer_.receive(byte)) end_turn(true);
    }
}

}  // namespace nplc::boards
