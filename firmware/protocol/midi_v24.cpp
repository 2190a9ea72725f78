#include "protocol/midi_v24.h"

namespace nplc::protocol::midi_v24 {
namespace {

constexpr std::uint8_t hex_digit(unsigned value) {
    return static_cast<std::uint8_t>(value < 10 ? '0' + value : 'A' + value - 10);
}

/// R: capitals only, as in the manual's example.
constexpr int value_of(std::uint8_t digit) {
    if (digit >= '0' && digit <= '9') return digit - '0';
    if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
    return -1;
}

class Writer {
  public:
    Writer(std::uint8_t* out, std::size_t fields) : next_(out) {
        *next_++ = kStx;
        *next_++ = '0';
        *next_++ = hex_digit(static_cast<unsigned>(fields / 10));
        *next_++ = hex_digit(static_cast<unsigned>(fields % 10));
    }
    void put(std::uint32_t value, int digits) {
        for (int i = digits - 1; i >= 0; --i) {
            const std::uint8_t character = hex_digit(value >> (4 * i) & 0xF);
            sum_ = static_cast<std::uint8_t>(sum_ + character);
            *next_++ = character;
        }
    }
    void end() {
        put(sum_, 2);
        *next_ = kEtx;
    }

  private:
    std::uint8_t* next_;
    std::uint8_t sum_ = 0;
};

}  // namespace

RequestBytes encode(const Request& request) {
    RequestBytes bytes;
    Writer out(bytes.data(), kRequestFields);
    out.put(request.address, 2);
    out.put(request.index, 2);
    out.put(request.sub_index, 2);
    out.put(request.data, 8);
    out.end();
    return bytes;
}

ReplyBytes encode_reply(const Reply& reply) {
    ReplyBytes bytes;
    Writer out(bytes.data(), kReplyFields);
    out.put(reply.address, 2);
    out.put(reply.digit, 1);
    out.put(reply.data, 8);
    out.end();
    return bytes;
}

FrameReader::State FrameReader::receive(std::uint8_t byte) {
    if (byte == kStx) {
        count_ = 1;
        return State::inside;
    }
    if (count_ == 0) return State::outside;
    const std::size_t place = count_ - 1U;  // behind Stx
    if (place < kLengthDigits) {
        const std::size_t digits[kLengthDigits] = {0, fields_ / 10U, fields_ % 10U};
        if (byte != '0' + digits[place]) {
            abandon();
            return State::outside;
        }
    } else if (place < kLengthDigits + fields_ + 2) {
        bytes_[place - kLengthDigits] = byte;
    } else {
        abandon();
        if (byte != kEtx) return State::outside;
        return sum_is_right() && all_digits() ? State::whole : State::damaged;
    }
    ++count_;
    return State::inside;
}

std::int64_t FrameReader::number(std::size_t from, std::size_t digits) const {
    std::uint32_t value = 0;
    for (std::size_t i = from; i < from + digits; ++i) {
        const int digit = value_of(bytes_[i]);
        if (digit < 0) return -1;
        value = value << 4 | static_cast<std::uint32_t>(digit);
    }
    return value;
}

bool FrameReader::sum_is_right() const {
    std::uint8_t sum = 0;
    for (std::size_t i = 0; i < fields_; ++i) sum = static_cast<std::uint8_t>(sum + bytes_[i]);
    return number(fields_, 2) == sum;
}

bool FrameReader::all_digits() const {
    for (std::size_t i = 0; i < fields_; ++i) {
        if (value_of(bytes_[i]) < 0) return false;
    }
    return true;
}

RequestDecoder::Event RequestDecoder::receive(std::uint8_t byte) {
    const FrameReader::State state = frame_.receive(byte);
    if (state != FrameReader::State::whole && state != FrameReader::State::damaged) return {};
    const std::int64_t address = frame_.number(0, 2);
    if (address < 0) return {};
    const auto number = [this](std::size_t from, std::size_t digits) { return frame_.number(from, digits); };
    Event event{.kind = Event::Kind::damaged, .request = {.address = static_cast<std::uint8_t>(address)}};
    if (state == FrameReader::State::damaged) return event;
    event.kind = Event::Kind::request;
    event.request.index = static_cast<std::uint8_t>(number(2, 2));
    event.request.sub_index = static_cast<std::uint8_t>(number(4, 2));
    event.request.data = static_cast<std::uint32_t>(number(6, 8));
    return event;
}

void AnswerDecoder::expect(const Request& request) {
    request_ = request;
    frame_.abandon();
    waiting_ = true;
    acknowledged_ = busy_ = has_value_ = spoilt_ = false;
}

Answer AnswerDecoder::finish(Answer::Kind kind) {
    waiting_ = false;
    return {.kind = kind, .value = kind == Answer::Kind::value ? value_ : 0};
}

Answer AnswerDecoder::receive(std::uint8_t byte) {
    if (!waiting_) return {};
    const bool begun = frame_.in_frame();
    // A control character within a reply: a part of the reply was lost.
    if (begun && byte < 0x20 && byte != kStx && byte != kEtx) frame_.abandon();
    const FrameReader::State state = frame_.receive(byte);
    if (state == FrameReader::State::inside) {
        if (begun && byte == kStx) spoilt_ = true;
        return {};
    }
    if (state == FrameReader::State::outside) {
        if (begun) spoilt_ = true;
        return control(byte);
    }
    take_reply(state);
    return {};
}

void AnswerDecoder::take_reply(FrameReader::State state) {
    const auto address = frame_.number(0, 2);
    // R: a module answers a general query with its own address, which is 00; 000 §III can be read as FFh too.
    const bool from_it = address == request_.address || (request_.address == kGeneral && address == 0);
    if (state == FrameReader::State::damaged || !from_it || !is_query(request_.index) ||
        frame_.number(2, 1) != digit_of(request_.index) || has_value_) {
        spoilt_ = true;
        return;
    }
    has_value_ = true;
    value_ = static_cast<std::uint32_t>(frame_.number(3, 8));
}

Answer AnswerDecoder::control(std::uint8_t byte) {
    using Kind = Answer::Kind;
    switch (byte) {
        case kAck:
            acknowledged_ = true;
            return {};
        case kXoff:
            busy_ = acknowledged_;
            return {};
        case kNack:
            return finish(acknowledged_ ? Kind::unclear : Kind::not_understood);
        case kXonError:
        case kXonErrorInTheField:
            return finish(busy_ ? Kind::refused : Kind::unclear);
        case kXon:
            if (!busy_ || spoilt_ || has_value_ != is_query(request_.index)) return finish(Kind::unclear);
            return finish(has_value_ ? Kind::value : Kind::accepted);
        default:
            return {};
    }
}

}  // namespace nplc::protocol::midi_v24
