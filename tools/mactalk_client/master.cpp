#include "mactalk_client/master.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/bytes.h"

namespace nplc::mactalk_client {

namespace mactalk = protocol::mactalk;

namespace {

constexpr std::size_t kAcceptBytes = 3;

std::size_t answer_bytes(mactalk::Answer answer, std::size_t data_bytes) {
    return answer == mactalk::Answer::accept ? kAcceptBytes : 11 + 2 * data_bytes;
}

}  // namespace

Master::Master(host::ByteClient& wire, const MasterOptions& options)
    : line_(wire, {.baud = options.baud,
                   .patience = options.patience,
                   .full = "it has no room for another client",
                   .perhaps_full = "it probably has no room for another client; end one first"}),
      attempts_(options.attempts) {}

std::uint32_t Master::read(std::uint8_t address, std::uint8_t reg) {
    const Reply reply =
        ask({.kind = mactalk::Kind::read, .address = address, .reg = reg}, mactalk::kReadBytes, attempts_);
    return base::load_u32(reply.data.data());
}

std::array<std::uint8_t, mactalk::kBlockBytes> Master::read_block(std::uint8_t address, std::uint8_t reg) {
    return ask({.kind = mactalk::Kind::read_block, .address = address, .reg = reg}, mactalk::kBlockBytes,
               attempts_)
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
        0, attempts_);
}

void Master::send_write(std::uint8_t address, std::uint8_t reg, std::uint32_t value, Width width) {
    line_.send(mactalk::encode({.kind = mactalk::Kind::write,
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
    ask({.kind = mactalk::Kind::safe_mode, .address = address}, 0, attempts_);
}

void Master::init_mode(std::uint8_t address) {
    ask({.kind = mactalk::Kind::init_mode, .address = address}, 0, attempts_);
}

void Master::write_flash(std::uint8_t address) {
    line_.send(mactalk::encode({.kind = mactalk::Kind::write_flash, .address = address}).view());
}

void Master::reset(std::uint8_t address) {
    line_.send(mactalk::encode({.kind = mactalk::Kind::reset, .address = address}).view());
}

void Master::pause(base::Microseconds time) {
    counters_.stray_bytes += line_.pause(time);
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
    // An accept carries no address
    counters_.stray_bytes += line_.settle(question.answer == mactalk::Answer::accept);
    line_.send(question.bytes);
    ++counters_.questions;
    heard_ = 0;
    mactalk::ReplyDecoder decoder;
    decoder.expect(question.answer, question.data_bytes);
    const std::size_t size = answer_bytes(question.answer, question.data_bytes);
    std::optional<Reply> answer;
    const auto take = [&](std::span<const std::uint8_t> bytes) {
        heard_ += bytes.size();
        for (const std::uint8_t byte : bytes) {
            answer = decoder.receive(byte);
            if (answer && (question.reg == 0 || answer->reg == question.reg)) return true;
        }
        return false;
    };
    if (line_.listen(question.bytes.size() + size, take, question.more_patience)) {
        ++counters_.answers;
        counters_.stray_bytes += heard_ - std::min<std::uint64_t>(heard_, size);
        return answer;
    }
    ++counters_.timeouts;
    counters_.stray_bytes += heard_;
    line_.expect_late_answer();
    return std::nullopt;
}

/// Distinguishes silence from bytes that are no answer.
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
                    fmt::format("{}: no answer from address {}, asked {} time{}; {}", line_.name(), address,
                                attempts, attempts == 1 ? "" : "s", heard));
}

}  // namespace nplc::mactalk_client
