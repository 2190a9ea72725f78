#include "protocol/flexmac.h"

#include "base/bytes.h"

namespace nplc::protocol::flexmac {
namespace {

constexpr std::uint8_t kHeaderMark = 0x60;  // bits 6..5
constexpr std::uint8_t kLongword = 0x80;
constexpr std::uint8_t kRead = 0x10;
constexpr std::uint8_t kIndexBits = 0x0F;
constexpr std::size_t kHeaderBytes = 3;
constexpr std::size_t kRegisterBytes = 2;
constexpr std::size_t kAddressBytes = 4;

// 001 §5.2.2. R: P0 and P1 there are P1 and P2 of §3.2, V1 to L2 as in §3.2, ERBIT is ERR_STAT.
constexpr std::array<std::uint8_t, 16> kWriteRegisters{0,  36, 3,  5,  6,  7,  13, 33,
                                                       49, 51, 65, 66, 73, 74, 81, 82};
constexpr std::array<std::uint8_t, 16> kReadRegisters{0,   36, 8,  10, 12, 120, 122, 131,
                                                      121, 16, 18, 20, 24, 35,  0,   0};

constexpr bool has_header_mark(std::uint8_t byte) {
    return (byte & kHeaderMark) == kHeaderMark;
}
constexpr std::uint8_t index_of(std::uint8_t header) {
    return header & kIndexBits;
}
constexpr bool is_read(std::uint8_t header) {
    return (header & kRead) != 0;
}
constexpr bool is_protocol_header(std::uint8_t header) {
    return is_read(header) && index_of(header) >= kReadIndexUseFastMac;
}

constexpr bool begins_request(std::uint8_t byte) {
    return has_header_mark(byte) && !(is_protocol_header(byte) && (byte & kLongword) != 0);
}

constexpr bool begins_reply(std::uint8_t byte) {
    return has_header_mark(byte) && is_read(byte) && !is_protocol_header(byte);
}

/// Bytes of the data block, each byte counted with its inverse.
constexpr std::size_t data_bytes(std::uint8_t header) {
    return (header & kLongword) != 0 ? 8 : 4;
}

using Bytes = std::span<const std::uint8_t>;

/// Whether the last of `bytes` is valid at its position, if the previous ones are.
constexpr bool last_fits(Bytes bytes) {
    const std::size_t at = bytes.size() - 1;
    if (at < kHeaderBytes) return bytes[at] == bytes[0];
    const bool is_inverse = (at - kHeaderBytes) % 2 != 0;
    return !is_inverse || bytes[at] == base::inverse(bytes[at - 1]);
}

constexpr std::size_t header_and_block_bytes(Bytes bytes) {
    if (index_of(bytes[0]) != 0) return kHeaderBytes;
    const bool address = bytes.size() > kHeaderBytes && bytes[kHeaderBytes] == 0;
    return kHeaderBytes + kRegisterBytes + (address ? kAddressBytes : 0);
}

/// `size` protected bytes from `at` on, little-endian.
constexpr std::uint32_t load(Bytes bytes, std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; i += 2) {
        value |= static_cast<std::uint32_t>(bytes[at + i]) << (4 * i);
    }
    return value;
}

Message message_of(Bytes bytes, bool has_data) {
    const std::uint8_t header = bytes[0];
    Message message{.read = is_read(header), .longword = (header & kLongword) != 0};
    if (index_of(header) != 0) {
        message.target = index_of(header);
    } else if (bytes[kHeaderBytes] != 0) {
        message.level = Level::reg;
        message.target = bytes[kHeaderBytes];
    } else {
        message.level = Level::address;
        message.target =
            static_cast<std::uint16_t>(load(bytes, kHeaderBytes + kRegisterBytes, kAddressBytes));
    }
    if (has_data) message.value = load(bytes, header_and_block_bytes(bytes), data_bytes(header));
    return message;
}

bool is_sendable(const Message& message) {
    switch (message.level) {
        case Level::index:
            if (message.target == 0 || message.target > kIndexBits) return false;
            return !(message.read && message.longword && message.target >= kReadIndexUseFastMac);
        case Level::reg:
            return message.target != 0 && message.target <= 0xFF;
        case Level::address:
            break;
    }
    return true;
}

class Writer {
  public:
    explicit Writer(Encoded& out) : out_(out) {}
    void put(std::uint8_t byte) { out_.bytes[out_.size++] = byte; }
    /// The low `count` bytes of `value`, little-endian.
    void put_protected(std::uint32_t value, int count) {
        for (int i = 0; i < count; ++i) {
            const auto byte = static_cast<std::uint8_t>(value >> (8 * i));
            put(byte);
            put(base::inverse(byte));
        }
    }

  private:
    Encoded& out_;
};

Encoded put_together(const Message& message, bool has_data, std::uint32_t value) {
    Encoded encoded;
    Writer out(encoded);
    const int index = message.level == Level::index ? message.target : 0;
    const auto header = static_cast<std::uint8_t>(kHeaderMark | (message.longword ? kLongword : 0) |
                                                  (message.read ? kRead : 0) | index);
    for (std::size_t i = 0; i < kHeaderBytes; ++i) out.put(header);
    if (message.level == Level::reg) out.put_protected(message.target, 1);
    if (message.level == Level::address) {
        out.put_protected(0, 1);
        out.put_protected(message.target, 2);
    }
    if (has_data) out.put_protected(value, message.longword ? 4 : 2);
    return encoded;
}

}  // namespace

bool is_protocol_command(const Message& message) {
    return message.read && message.level == Level::index && message.target >= kReadIndexUseFastMac;
}

Encoded encode(const Message& message) {
    if (!is_sendable(message)) return {};
    return put_together(message, !message.read, message.value);
}

Encoded encode_reply(const Message& request, std::uint32_t value) {
    if (!request.read || is_protocol_command(request) || !is_sendable(request)) return {};
    return put_together(request, true, value);
}

std::uint8_t register_of_write_index(std::uint8_t index) {
    return index < kWriteRegisters.size() ? kWriteRegisters[index] : std::uint8_t{0};
}

std::uint8_t register_of_read_index(std::uint8_t index) {
    return index < kReadRegisters.size() ? kReadRegisters[index] : std::uint8_t{0};
}

std::optional<std::uint8_t> register_of_address(std::uint16_t address) {
    if (address % 2 != 0 || address < address_of_register(1) || address > address_of_register(0xFF)) {
        return std::nullopt;
    }
    return static_cast<std::uint8_t>((address - address_of_register(0)) / 2);
}

std::optional<Message> RequestDecoder::receive(std::uint8_t byte) {
    bytes_[count_++] = byte;
    if (!last_fits({bytes_.data(), count_})) {
        count_ = 1;
        bytes_[0] = byte;
    }
    const Bytes bytes{bytes_.data(), count_};
    if (!begins_request(bytes[0])) {
        count_ = 0;
        return std::nullopt;
    }
    const bool has_data = !is_read(bytes[0]);
    const std::size_t whole = header_and_block_bytes(bytes) + (has_data ? data_bytes(bytes[0]) : 0);
    if (count_ < whole) return std::nullopt;
    count_ = 0;
    return message_of(bytes, has_data);
}

[[gnu::noinline]] ReplyDecoder::Event ReplyDecoder::receive(std::uint8_t byte) {
    if (count_ == 0) return outside_reply(byte);
    bytes_[count_++] = byte;
    const Bytes bytes{bytes_.data(), count_};
    if (!last_fits(bytes)) {
        abandon();
        return outside_reply(byte);
    }
    if (count_ < header_and_block_bytes(bytes) + data_bytes(bytes[0])) return {};
    count_ = 0;
    doubt_ = false;
    return {.kind = Event::Kind::reply, .reply = message_of(bytes, true)};
}

ReplyDecoder::Event ReplyDecoder::outside_reply(std::uint8_t byte) {
    constexpr std::uint8_t kSureRun = 3;
    if (begins_reply(byte)) {
        bytes_[0] = byte;
        count_ = 1;
        return {};
    }
    if (has_header_mark(byte)) {
        doubt_ = true;
        run_ = 0;
        return {};
    }
    if (doubt_) {
        run_ = run_ != 0 && byte == last_ ? static_cast<std::uint8_t>(run_ + 1) : std::uint8_t{1};
        last_ = byte;
        if (run_ < kSureRun) return {};
        doubt_ = false;
    }
    return {.kind = Event::Kind::status, .status = byte};
}

void ReplyDecoder::abandon() {
    if (count_ == 0) return;
    count_ = 0;
    doubt_ = true;
    run_ = 0;
}

}  // namespace nplc::protocol::flexmac
