#include "mactalk_client/master.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/bytes.h"

namespace nplc::mactalk_client {

namespace mactalk = protocol::mactalk;

namespace {

constexpr std::size_t kAcceptBytes = 3;
constexpr base::Microseconds kLongestDrain{2'000'000};

std::size_t answer_bytes(mactalk::Answer answer, std::size_t data_bytes) {
    return answer == mactalk::Answer::accept ? kAcceptBytes : 11 + 2 * data_bytes;
}

}  // namespace

std::uint32_t Master::read(std::uint8_t address, std::uint8_t reg) {
    const Reply reply = ask({.kind = mactalk::Kind::read, .address = address, .reg = reg},
                            mactalk::kReadBytes, options_.attempts);
    return base::load_u32(reply.data.data());
}

std::array<std::uint8_t, mactalk::kBlockBytes> Master::read_block(std::uint8_t address, std::uint8_t reg) {
    return ask({.kind = mactalk::Kind::read_block, .address = address, .reg = reg}, mactalk::kBlockBytes,
               options_.attempts)
        .data;
}

std::optional<std::array<std::uint8_t, mactalk::kBlockBytes>> Master::try_read_block(std::uint8_t address,
                                                                                     std::uint8_t reg) {
    const auto bytes = mactalk::encode({.kind = mactalk::Kind::read_block, .address = address, .reg = reg});
    const auto reply =
        ask_once({address, reg, mactalk::Answer::registers, mactalk::kBlockBytes, bytes.view()});
    return reply ? std::optional(reply->data) : std::nullopt;
}

std::vector<std::uint8_t> Master::read_sample(std::uint8_t address, std::size_t bytes) {
    const Reply reply = ask({.kind = mactalk::Kind::read_samples, .address = address}, bytes, 1);
    return {reply.view().begin(), reply.view().end()};
}

void Master::write(std::uint8_t address, std::uint8_t reg, std::uint32_t value, Width width) {
    ask({.kind = mactalk::Kind::write,
         .address = address,
         .reg = reg,
         .length = static_cast<std::uint8_t>(width),
         .value = value},
        0, options_.attempts);
}

void Master::send_write(std::uint8_t address, std::uint8_t reg, std::uint32_t value, Width width) {
    send(mactalk::encode({.kind = mactalk::Kind::write,
                          .address = address,
                          .reg = reg,
                          .length = static_cast<std::uint8_t>(width),
                          .value = value})
             .view());
}

bool Master::try_write(std::uint8_t address, std::uint8_t reg, std::uint32_t value, Width width,
                       base::Microseconds more_patience) {
    const auto bytes = mactalk::encode({.kind = mactalk::Kind::write,
                                        .address = address,
                                        .reg = reg,
                                        .length = static_cast<std::uint8_t>(width),
                                        .value = value});
    return ask_once({address, 0, mactalk::Answer::accept, 0, bytes.view(), more_patience}).has_value();
}

bool Master::try_write_long(std::uint8_t address, std::uint8_t reg, std::span<const std::uint8_t> data,
                            base::Microseconds more_patience) {
    const auto bytes = mactalk::encode_long_write(address, reg, data);
    return ask_once({address, 0, mactalk::Answer::accept, 0, bytes.view(), more_patience}).has_value();
}

void Master::safe_mode(std::uint8_t address) {
    ask({.kind = mactalk::Kind::safe_mode, .address = address}, 0, options_.attempts);
}

void Master::init_mode(std::uint8_t address) {
    ask({.kind = mactalk::Kind::init_mode, .address = address}, 0, options_.attempts);
}

void Master::write_flash(std::uint8_t address) {
    send(mactalk::encode({.kind = mactalk::Kind::write_flash, .address = address}).view());
}

void Master::reset(std::uint8_t address) {
    send(mactalk::encode({.kind = mactalk::Kind::reset, .address = address}).view());
}

void Master::pause(base::Microseconds time) {
    const base::Instant end = wire_.now() + time;
    std::array<std::uint8_t, 256> bytes{};
    for (base::Instant now = wire_.now(); now < end; now = wire_.now())
        counters_.stray_bytes += receive(bytes, end - now);
}

Master::Reply Master::ask(const mactalk::Request& request, std::size_t data_bytes, unsigned attempts) {
    const auto bytes = mactalk::encode(request);
    const auto answer = mactalk::answer_to(request.kind);
    const std::uint8_t reg = answer == mactalk::Answer::registers ? request.reg : std::uint8_t{0};
    const Question question{request.address, reg, answer, data_bytes, bytes.view()};
    std::uint64_t heard = 0;
    for (unsigned i = 0; i < attempts; ++i) {
        if (const auto reply = ask_once(question)) return *reply;
        heard += heard_;
    }
    no_answer(request.address, attempts, heard);
}

std::optional<Master::Reply> Master::ask_once(const Question& question) {
    if (question.bytes.empty())
        throw LineError(LineError::Kind::no_message, "MacTalk has no message for this register or length");
    settle(question.answer == mactalk::Answer::accept);
    send(question.bytes);
    ++counters_.questions;
    heard_ = 0;
    mactalk::ReplyDecoder decoder;
    decoder.expect(question.answer, question.data_bytes);
    const base::Instant end =
        wire_.now() + options_.patience + question.more_patience +
        on_line(question.bytes.size() + answer_bytes(question.answer, question.data_bytes));
    std::array<std::uint8_t, 256> bytes{};
    for (base::Instant now = wire_.now(); now < end; now = wire_.now()) {
        const std::size_t count = receive(bytes, end - now);
        heard_ += count;
        for (std::size_t i = 0; i < count; ++i) {
            const auto reply = decoder.receive(bytes[i]);
            if (!reply || (question.reg != 0 && reply->reg != question.reg)) continue;
            ++counters_.answers;
            const std::size_t used = answer_bytes(question.answer, question.data_bytes);
            counters_.stray_bytes += heard_ - std::min<std::uint64_t>(heard_, used);
            return reply;
        }
    }
    ++counters_.timeouts;
    counters_.stray_bytes += heard_;
    silent_since_ = wire_.now();
    unsettled_ = true;
    return std::nullopt;
}

void Master::send(std::span<const std::uint8_t> bytes) {
    if (!wire_.write(bytes)) gone();
}

std::size_t Master::receive(std::span<std::uint8_t> out, base::Microseconds wait) {
    const auto count = wire_.read(out, wait);
    if (!count) gone();
    heard_any_ = heard_any_ || *count > 0;
    return *count;
}

/// Reads over what came before the question. An accept does not say whose it is: after a time-out the line
/// must have been silent for as long as an answer may take before one is waited for again.
void Master::settle(bool for_accept) {
    std::array<std::uint8_t, 256> bytes{};
    const base::Instant last = wire_.now() + kLongestDrain;
    for (;;) {
        const base::Instant now = wire_.now();
        const bool waits = unsettled_ && for_accept && now < silent_since_ + options_.patience && now < last;
        const std::size_t count =
            receive(bytes, waits ? silent_since_ + options_.patience - now : base::Microseconds{0});
        counters_.stray_bytes += count;
        if (count > 0) silent_since_ = wire_.now();
        if (count == 0 && !waits) break;
    }
    if (for_accept) unsettled_ = false;
}

base::Microseconds Master::on_line(std::size_t bytes) const {
    return base::Microseconds{static_cast<std::int64_t>(bytes) * 10'000'000 / options_.baud};
}

/// Silence says something else than bytes that are no answer.
void Master::no_answer(std::uint8_t address, unsigned attempts, std::uint64_t bytes) const {
    const bool others = counters_.answers > 0;
    const std::string heard =
        bytes == 0 && others
            ? std::string("nothing came, though others were answered: was it switched off or unplugged?")
        : bytes == 0 ? std::string("nothing came: is it switched on, and are address and speed right?")
        : others     ? fmt::format(
                           "others were answered, and {} bytes came damaged: check wiring, shield and ground of "
                               "the line",
                           bytes)
                 : fmt::format("{} bytes came that are no answer: is the speed right?", bytes);
    throw LineError(LineError::Kind::no_answer,
                    fmt::format("{}: no answer from address {}, asked {} time{}; {}", wire_.name(), address,
                                attempts, attempts == 1 ? "" : "s", heard));
}

void Master::gone() {
    const std::string& name = wire_.name();
    const bool socket = name.starts_with("unix:") || name.starts_with("tcp:");
    const bool silent = counters_.questions <= 1 && !heard_any_;
    if (const std::string other = socket && silent ? wire_.other_client() : std::string(); !other.empty())
        throw LineError(
            LineError::Kind::port_gone,
            fmt::format("{}: it has no room for another client, and {} is connected; end that one first",
                        name, other));
    throw LineError(
        LineError::Kind::port_gone,
        name + (socket && silent
                    ? ": the other end closed the connection before anything came: it probably has no room "
                      "for another client; end one first"
                : socket ? ": the other end closed the connection; has its program ended?"
                         : ": the other end closed the connection; was the device unplugged, or its "
                           "program ended?"));
}

}  // namespace nplc::mactalk_client
