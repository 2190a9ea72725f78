// The ASCII frames of MIDI modules on a line (000 §II to §IV).
#include "macreg/monitor.h"

#include <fmt/format.h>

#include <utility>

#include "macreg/midi/raw.h"
#include "protocol/midi_v24.h"

namespace nplc::macreg {

namespace v24 = protocol::midi_v24;

namespace {

using Bytes = std::vector<std::uint8_t>;
using Kind = v24::Answer::Kind;

/// Request, Ack, Xoff, reply, Xon.
constexpr std::size_t kExchangeBytes = v24::RequestBytes{}.size() + 3 + v24::ReplyBytes{}.size();

constexpr std::size_t kLongestNoise = 64;  // a line's worth

midi_client::Request request_of(const v24::Request& heard) {
    const bool query = v24::is_query(heard.index);
    return {.address = heard.address,
            .query = query,
            .number = static_cast<std::uint8_t>(query ? heard.index - v24::kFirstQuery : heard.index),
            .sub_index = heard.sub_index,
            .data = heard.data};
}

midi_client::Answer answer_of(const v24::Answer& heard) {
    using To = midi_client::Answer::Kind;
    switch (heard.kind) {
        case Kind::accepted:
            return {.kind = To::accepted};
        case Kind::value:
            return {.kind = To::value, .value = heard.value};
        case Kind::refused:
            return {.kind = To::refused};
        case Kind::not_understood:
            return {.kind = To::not_taken};
        case Kind::unclear:
            return {.kind = To::unclear};
        case Kind::none:
            break;
    }
    return {};
}

class MidiMonitor final : public Monitor {
  public:
    explicit MidiMonitor(const MidiMonitorOptions& options)
        : scale_{.model = options.model},
          longest_(options.longest_answer +
                   base::Microseconds{std::int64_t{kExchangeBytes} * 10'000'000 / options.baud}) {}

    void receive(Side side, std::uint8_t byte, base::Instant at) override {
        pass(at);
        last_ = at;
        side == Side::motor ? from_module(byte) : from_master(byte, at, side == Side::both);
    }
    void framing_error(Side side, base::Instant at) override {
        if (side != Side::motor) {
            requests_.abandon();
            release(side == Side::both);
        }
        tell_framing_error(at);
    }
    void pass(base::Instant now) override {
        if (asked_ && now - asked_->at > longest_) end_exchange({});
        if (now - last_ <= longest_) return;
        requests_.abandon();
        release(false);
        tell_noise();
    }
    void finish() override {
        if (asked_) end_exchange({});
        release(false);
        tell_noise();
    }
    std::optional<base::Instant> since() const override {
        if (asked_) return asked_->at;
        const bool noise = !held_.empty() || !unsent_.empty() || !received_.empty();
        return noise ? std::optional(last_) : std::nullopt;
    }

  private:
    struct Asked {
        base::Instant at{};
        midi_client::Request request{};
        bool damaged = false;
        Bytes bytes{};
    };

    /// In a stream with both directions, bytes that are no request may belong to an answer.
    void from_master(std::uint8_t byte, base::Instant at, bool both) {
        if (byte == v24::kStx) release(both);
        held_.push_back(byte);
        const auto event = requests_.receive(byte);
        if (event.kind == v24::RequestDecoder::Event::Kind::none) {
            if (!requests_.in_frame()) release(both);
            return;
        }
        if (asked_) end_exchange({});
        tell_noise();
        const bool damaged = event.kind == v24::RequestDecoder::Event::Kind::damaged;
        asked_ = Asked{at, request_of(event.request), damaged, std::exchange(held_, {})};
        answers_.expect(event.request);
    }

    void release(bool both) {
        for (const std::uint8_t byte : std::exchange(held_, {})) {
            both ? from_module(byte) : unsent_.push_back(byte);
            if (unsent_.size() >= kLongestNoise) tell_noise();
        }
    }

    void from_module(std::uint8_t byte) {
        received_.push_back(byte);
        const v24::Answer answer = answers_.receive(byte);
        if (answer.kind != Kind::none && asked_) end_exchange(answer);
        if (!asked_ && received_.size() >= kLongestNoise) tell_noise();
    }

    void end_exchange(const v24::Answer& answer) {
        MonitorEvent event{.at = asked_->at, .address = asked_->request.address};
        event.request = asked_->damaged
                            ? fmt::format("a damaged request to address {}", asked_->request.address)
                            : midi::describe_request(asked_->request, scale_);
        const bool heard = answer.kind != Kind::none || !received_.empty();
        midi_client::Answer told = answer_of(answer);
        if (answer.kind == Kind::none && heard) told.kind = midi_client::Answer::Kind::unclear;
        event.answer = midi::describe_answer(asked_->request, told, scale_);
        if (asked_->damaged) event.flaw = "its sum is wrong, or a character is no hexadecimal digit";
        if (answer.kind == Kind::value) event.value = answer.value;
        event.sent = std::move(asked_->bytes);
        event.received = std::exchange(received_, {});
        tell(std::move(event));
        asked_.reset();
        answers_.abandon();
    }

    void tell_noise() {
        if (!unsent_.empty()) tell({.at = last_, .flaw = "no frame: " + hex_words(unsent_), .sent = unsent_});
        if (!received_.empty())
            tell({.at = last_,
                  .flaw = "no answer to anything: " + hex_words(received_),
                  .received = received_});
        unsent_.clear();
        received_.clear();
    }

    midi::Scale scale_;
    base::Microseconds longest_;
    v24::RequestDecoder requests_;
    v24::AnswerDecoder answers_;
    std::optional<Asked> asked_;
    Bytes held_;      ///< possibly a request
    Bytes unsent_;    ///< from the master, but no request
    Bytes received_;  ///< from the module, since the last request or answer
    base::Instant last_{};
};

}  // namespace

std::unique_ptr<Monitor> make_midi_monitor(const MidiMonitorOptions& options) {
    return std::make_unique<MidiMonitor>(options);
}

}  // namespace nplc::macreg
