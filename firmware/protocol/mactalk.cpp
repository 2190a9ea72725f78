#include "protocol/mactalk.h"

#include <algorithm>

#include "base/bytes.h"

namespace nplc::protocol::mactalk {
namespace {

constexpr std::size_t kSync = 3;
constexpr std::uint8_t kEnd = 0xAA;
constexpr std::size_t kEnds = 2;
constexpr std::uint8_t kAccept = 0x11;
constexpr std::uint8_t kFirstKind = 0x50;
constexpr std::uint8_t kLastKind = 0x57;
constexpr std::size_t kHeaderPairs = 3;  // address, register, length

enum class Progress : std::uint8_t { wrong, partial, whole };

bool has_register(Kind kind) {
    return kind == Kind::read || kind == Kind::read_block || kind == Kind::write;
}

bool is_write_length(std::uint8_t length) {
    return length == 2 || length == 4;
}

bool is_long_length(std::size_t length) {
    return length >= 4 && length <= kMaxLongWrite && length % 4 == 0;
}

constexpr std::size_t place_of(std::size_t index) {
    return kSync + 2 * index;
}

/// Index of protected byte number `index`.
std::uint8_t protected_byte(std::span<const std::uint8_t> bytes, std::size_t index) {
    return bytes[place_of(index)];
}

/// Whether the last byte is the protected one with this number.
bool ends_with(std::span<const std::uint8_t> bytes, std::size_t index) {
    return bytes.size() == place_of(index) + 1;
}

/// Checks the last byte as repeat, inverse or end of a message with so many protected bytes; the previous
/// ones are correct.
Progress framing(std::span<const std::uint8_t> bytes, std::size_t pairs) {
    const std::size_t end = place_of(pairs);
    const std::size_t i = bytes.size() - 1;
    bool right = true;
    if (i < kSync) {
        right = bytes[i] == bytes[0];
    } else if (i >= end) {
        right = bytes[i] == kEnd && i < end + kEnds;
    } else if ((i - kSync) % 2 == 1) {
        right = bytes[i] == base::inverse(bytes[i - 1]);
    }
    if (!right) return Progress::wrong;
    return bytes.size() == end + kEnds ? Progress::whole : Progress::partial;
}

/// Checks the last byte; the previous ones are correct.
Progress request_progress(std::span<const std::uint8_t> bytes, std::uint8_t long_address) {
    if (bytes[0] < kFirstKind || bytes[0] > kLastKind) return Progress::wrong;
    const Kind kind = static_cast<Kind>(bytes[0]);
    if (!has_register(kind)) return framing(bytes, 1);
    if (ends_with(bytes, 1) && bytes.back() == 0) return Progress::wrong;
    if (kind != Kind::write) return framing(bytes, 2);
    if (bytes.size() <= place_of(2)) return framing(bytes, kHeaderPairs);
    const std::uint8_t length = protected_byte(bytes, 2);
    const bool takes_long = long_address != kMasterAddress && protected_byte(bytes, 0) == long_address;
    if (!is_write_length(length) && !(takes_long && is_long_length(length))) return Progress::wrong;
    return framing(bytes, kHeaderPairs + length);
}

/// Checks the last byte; the previous ones are correct.
Progress reply_progress(std::span<const std::uint8_t> bytes, Answer answer, std::size_t data_bytes) {
    if (answer == Answer::accept) {
        if (bytes.back() != kAccept) return Progress::wrong;
        return bytes.size() == kSync ? Progress::whole : Progress::partial;
    }
    if (answer == Answer::none || bytes[0] != static_cast<std::uint8_t>(Kind::write)) return Progress::wrong;
    const std::size_t header = answer == Answer::registers ? kHeaderPairs : kHeaderPairs - 1;
    if (ends_with(bytes, 0) && bytes.back() != kMasterAddress) return Progress::wrong;
    if (answer == Answer::registers && ends_with(bytes, 1) && bytes.back() == 0) return Progress::wrong;
    if (ends_with(bytes, header - 1) && bytes.back() != data_bytes) return Progress::wrong;
    return framing(bytes, header + data_bytes);
}

Request request_of(std::span<const std::uint8_t> bytes) {
    Request request{.kind = static_cast<Kind>(bytes[0]), .address = protected_byte(bytes, 0)};
    if (has_register(request.kind)) request.reg = protected_byte(bytes, 1);
    if (request.kind != Kind::write) return request;
    request.length = protected_byte(bytes, 2);
    for (std::size_t i = 0; i < std::min<std::size_t>(request.length, 4); ++i) {
        request.value |= static_cast<std::uint32_t>(protected_byte(bytes, kHeaderPairs + i)) << (8 * i);
    }
    return request;
}

Reply reply_of(std::span<const std::uint8_t> bytes, Answer answer, std::size_t data_bytes) {
    Reply reply;
    if (answer == Answer::accept) return reply;
    const std::size_t header = answer == Answer::registers ? kHeaderPairs : kHeaderPairs - 1;
    if (answer == Answer::registers) reply.reg = protected_byte(bytes, 1);
    reply.length = static_cast<std::uint8_t>(data_bytes);
    for (std::size_t i = 0; i < data_bytes; ++i) reply.data[i] = protected_byte(bytes, header + i);
    return reply;
}

/// Adds a byte after the `count` correct ones. If it is wrong, bytes are removed from the front until the
/// rest is complete or may still become a message.
template <std::size_t N, class Count, class Judge>
Progress take_in(std::array<std::uint8_t, N>& bytes, Count& count, std::uint8_t byte, Judge judge) {
    std::size_t begin = 0;
    std::size_t end = count + 1U;
    std::size_t right = count;
    bytes[count] = byte;
    Progress progress = Progress::partial;
    while (begin + right < end) {
        progress = judge(std::span<const std::uint8_t>(&bytes[begin], right + 1));
        if (progress == Progress::wrong) {
            ++begin;
            right = 0;
        } else {
            ++right;
        }
    }
    std::copy(bytes.begin() + begin, bytes.begin() + end, bytes.begin());
    count = static_cast<Count>(right);
    return progress;
}

template <std::size_t N>
void put(Encoded<N>& out, std::uint8_t byte) {
    out.bytes[out.size] = byte;
    ++out.size;
}

template <std::size_t N>
void put_protected(Encoded<N>& out, std::uint8_t byte) {
    put(out, byte);
    put(out, base::inverse(byte));
}

template <std::size_t N>
void begin(Encoded<N>& out, Kind kind, std::uint8_t address) {
    for (std::size_t i = 0; i < kSync; ++i) put(out, static_cast<std::uint8_t>(kind));
    put_protected(out, address);
}

template <std::size_t N>
void end(Encoded<N>& out) {
    for (std::size_t i = 0; i < kEnds; ++i) put(out, kEnd);
}

template <std::size_t N>
void put_data(Encoded<N>& out, std::span<const std::uint8_t> data) {
    put_protected(out, static_cast<std::uint8_t>(data.size()));
    for (const std::uint8_t byte : data) put_protected(out, byte);
    end(out);
}

}  // namespace

EncodedRequest encode(const Request& request) {
    const bool is_write = request.kind == Kind::write;
    EncodedRequest out;
    if (has_register(request.kind) && request.reg == 0) return out;
    if (is_write && !is_write_length(request.length)) return out;
    begin(out, request.kind, request.address);
    if (has_register(request.kind)) put_protected(out, request.reg);
    if (is_write) {
        put_protected(out, request.length);
        for (unsigned i = 0; i < request.length; ++i)
            put_protected(out, static_cast<std::uint8_t>(request.value >> (8 * i)));
    }
    end(out);
    return out;
}

EncodedLongWrite encode_long_write(std::uint8_t address, std::uint8_t reg,
                                   std::span<const std::uint8_t> data) {
    EncodedLongWrite out;
    if (reg == 0 || !is_long_length(data.size())) return out;
    begin(out, Kind::write, address);
    put_protected(out, reg);
    put_data(out, data);
    return out;
}

EncodedReply encode_accept() {
    EncodedReply out;
    for (std::size_t i = 0; i < kSync; ++i) put(out, kAccept);
    return out;
}

EncodedReply encode_registers(std::uint8_t reg, std::span<const std::uint8_t> data) {
    EncodedReply out;
    if (reg == 0 || data.size() > kMaxReplyData) return out;
    begin(out, Kind::write, kMasterAddress);
    put_protected(out, reg);
    put_data(out, data);
    return out;
}

EncodedReply encode_samples(std::span<const std::uint8_t> data) {
    EncodedReply out;
    if (data.size() > kMaxReplyData) return out;
    begin(out, Kind::write, kMasterAddress);
    put_data(out, data);
    return out;
}

void RequestDecoder::place(const Request& request, std::span<const std::uint8_t> data) {
    const EncodedRequest bare = request.reg == 0 ? encode(request) : EncodedRequest{};
    const std::span<const std::uint8_t> bytes = request.reg == 0 ? bare.view() : data;
    std::copy(bytes.begin(), bytes.end(), bytes_.begin());
    data_size_ = request.length;
    count_ = 0;
}

[[gnu::noinline]] std::optional<Request> RequestDecoder::receive(std::uint8_t byte) {
    data_size_ = 0;
    const auto judge = [this](std::span<const std::uint8_t> bytes) {
        return request_progress(bytes, long_address_);
    };
    if (take_in(bytes_, count_, byte, judge) != Progress::whole) return std::nullopt;
    const Request request = request_of({bytes_.data(), count_});
    data_size_ = request.length;
    for (std::size_t i = 0; i < data_size_; ++i) bytes_[i] = protected_byte(bytes_, kHeaderPairs + i);
    count_ = 0;
    return request;
}

Answer answer_to(Kind kind) {
    switch (kind) {
        case Kind::read:
        case Kind::read_block:
            return Answer::registers;
        case Kind::read_samples:
            return Answer::samples;
        case Kind::write:
        case Kind::safe_mode:
        case Kind::init_mode:
            return Answer::accept;
        case Kind::write_flash:
        case Kind::reset:
            break;
    }
    return Answer::none;
}

void ReplyDecoder::expect(Answer answer, std::size_t data_bytes) {
    answer_ = answer;
    data_bytes_ = static_cast<std::uint8_t>(std::min(data_bytes, kMaxReplyData));
    count_ = 0;
}

std::optional<Reply> ReplyDecoder::receive(std::uint8_t byte) {
    const auto judge = [this](std::span<const std::uint8_t> bytes) {
        return reply_progress(bytes, answer_, data_bytes_);
    };
    if (take_in(bytes_, count_, byte, judge) != Progress::whole) return std::nullopt;
    const Reply reply = reply_of({bytes_.data(), count_}, answer_, data_bytes_);
    count_ = 0;
    return reply;
}

}  // namespace nplc::protocol::mactalk
