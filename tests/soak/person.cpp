#include "person.h"

#include <algorithm>
#include <utility>

#include "base/bytes.h"
#include "base/crc32.h"
#include "random_tables.h"
#include "registers/gateway.h"

namespace nplc::soak {

namespace mactalk = protocol::mactalk;
namespace reg = registers::gateway;
using namespace std::chrono_literals;
using mactalk::Answer;

namespace {

constexpr Time kPatience = 1'300ms;  ///< beyond the second that a piece may wait for its room
constexpr Time kBetweenLooks = 40ms;
constexpr int kMostTries = 3;
constexpr std::size_t kMostWaiting = 64;

std::vector<std::uint8_t> bytes_of(auto&& encoded) {
    return {encoded.view().begin(), encoded.view().end()};
}

}  // namespace

void Person::put(std::vector<std::uint8_t> bytes, Answer answer, std::size_t data_bytes, Message kind) {
    if (messages_.size() >= kMostWaiting && !kind.of_upload) return;
    kind.bytes = std::move(bytes);
    kind.answer = answer;
    kind.data_bytes = data_bytes;
    uploads_ += kind.of_upload ? 1U : 0U;
    messages_.push_back(std::move(kind));
}

void Person::ask(const mactalk::Request& request) {
    const std::size_t bytes = request.kind == mactalk::Kind::read         ? mactalk::kReadBytes
                              : request.kind == mactalk::Kind::read_block ? mactalk::kBlockBytes
                                                                          : 0;
    put(bytes_of(mactalk::encode(request)), mactalk::answer_to(request.kind), bytes, {.tries = kMostTries});
}

void Person::noise(std::uint64_t seed) {
    property::Dice dice(seed);
    std::vector<std::uint8_t> bytes(1 + dice.below(40));
    std::generate(bytes.begin(), bytes.end(), [&dice] { return dice.byte(); });
    put(std::move(bytes), Answer::none, 0, {.tries = kMostTries});
}

void Person::write(std::uint8_t number, std::uint32_t value, Message kind) {
    put(bytes_of(mactalk::encode({.kind = mactalk::Kind::write,
                                  .address = reg::kDefaultAddress,
                                  .reg = number,
                                  .length = 4,
                                  .value = value})),
        Answer::accept, 0, std::move(kind));
}

void Person::upload(const std::vector<std::uint8_t>& table) {
    if (uploads()) return;
    const auto command = [this](reg::Command which, bool is_commit = false) {
        write(reg::COMMAND, static_cast<std::uint32_t>(which), {.of_upload = true, .is_commit = is_commit});
    };
    command(reg::Command::upload_begin);
    for (std::size_t at = 0; at < table.size(); at += mactalk::kMaxLongWrite) {
        const auto piece = std::span(table).subspan(at, std::min(mactalk::kMaxLongWrite, table.size() - at));
        write(reg::TABLE_POINTER, static_cast<std::uint32_t>(at), {.of_upload = true});
        put(bytes_of(mactalk::encode_long_write(reg::kDefaultAddress, reg::TABLE_DATA, piece)),
            Answer::accept, 0, {.of_upload = true});
    }
    write(reg::UPLOAD_BYTES, static_cast<std::uint32_t>(table.size()), {.of_upload = true});
    write(reg::UPLOAD_CRC, base::crc32(table), {.of_upload = true});
    command(reg::Command::upload_commit, true);
    put(bytes_of(mactalk::encode(
            {.kind = mactalk::Kind::read, .address = reg::kDefaultAddress, .reg = reg::UPLOAD_STATE})),
        Answer::registers, mactalk::kReadBytes, {.of_upload = true, .waits_for_store = true});
    command(reg::Command::stop);
    command(reg::Command::activate);
    command(reg::Command::run);
}

void Person::forget() {
    messages_.clear();
    uploads_ = 0;
    committed_ = false;
    waits_ = false;
}

std::optional<Time> Person::next_due() const {
    if (waits_) return deadline_;
    if (messages_.empty()) return std::nullopt;
    return std::max(deadline_, world_.now());
}

void Person::send() {
    const Message& message = messages_.front();
    decoder_.abandon();
    decoder_.expect(message.answer, message.data_bytes);
    if (message.is_commit) committed_ = true;
    world_.user_sends(message.bytes);
    const Time on_the_line(static_cast<std::int64_t>(message.bytes.size()) * 520'834);
    waits_ = true;
    deadline_ = world_.now() + on_the_line + (message.answer == Answer::none ? Time(0) : kPatience);
}

void Person::look() {
    for (const std::uint8_t byte : world_.user_received()) {
        if (!waits_) continue;
        if (const auto reply = decoder_.receive(byte)) answered(*reply);
    }
    if (waits_ && world_.now() >= deadline_) missed();
    if (!waits_ && !messages_.empty() && world_.now() >= deadline_) send();
}

void Person::done() {
    waits_ = false;
    uploads_ -= messages_.front().of_upload ? 1U : 0U;
    messages_.pop_front();
    if (uploads_ == 0) committed_ = false;
}

void Person::answered(const mactalk::Reply& reply) {
    ++answers_;
    Message& message = messages_.front();
    if (message.waits_for_store) {
        constexpr std::uint32_t kStored = 4;
        constexpr std::uint32_t kFailed = 5;
        const std::uint32_t state = base::load_u32(reply.data.data()) & 0xFF;
        if (state == kFailed) return give_up_upload();
        if (state != kStored) {
            waits_ = false;
            deadline_ = world_.now() + kBetweenLooks;
            return;
        }
    }
    done();
}

void Person::missed() {
    Message& message = messages_.front();
    if (message.answer == Answer::none) return done();
    ++silences_;
    if (++message.tries < kMostTries) {
        waits_ = false;
        return;
    }
    message.of_upload ? give_up_upload() : done();
}

/// The rest of its messages; the machine is left running, if it still does.
void Person::give_up_upload() {
    waits_ = false;
    std::erase_if(messages_, [](const Message& message) { return message.of_upload; });
    uploads_ = 0;
    committed_ = false;
    write(reg::COMMAND, static_cast<std::uint32_t>(reg::Command::upload_abort), {.tries = kMostTries});
    write(reg::COMMAND, static_cast<std::uint32_t>(reg::Command::run), {.tries = kMostTries});
}

}  // namespace nplc::soak
