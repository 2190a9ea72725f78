#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "protocol/mactalk.h"
#include "sim/world.h"

namespace nplc::soak {

using sim::Time;

/// A program at the gateway's user's port: asks, waits for the answer, asks again when there is none. It
/// gives an upload up when a piece was asked for three times.
class Person {
  public:
    explicit Person(sim::World& world) : world_(world) {}

    void ask(const protocol::mactalk::Request& request);
    void noise(std::uint64_t seed);
    /// Stop, all pieces, commit; then, when it is stored, activate and run.
    void upload(const std::vector<std::uint8_t>& table);
    /// The gateway's power was cut: what was under way is lost.
    void forget();

    /// After each step of the world.
    void look();
    /// When look() has something to do without an answer.
    std::optional<Time> next_due() const;

    bool uploads() const { return uploads_ != 0; }
    /// Uploads whose commit was asked for.
    bool has_committed() const { return committed_; }
    std::uint64_t answers() const { return answers_; }
    std::uint64_t silences() const { return silences_; }

  private:
    struct Message {
        std::vector<std::uint8_t> bytes{};
        protocol::mactalk::Answer answer = protocol::mactalk::Answer::none;
        std::size_t data_bytes = 0;
        bool of_upload = false;
        bool is_commit = false;
        bool waits_for_store = false;  ///< a read of UPLOAD_STATE, until it is 4 or 5
        int tries = 0;
    };

    void put(std::vector<std::uint8_t> bytes, protocol::mactalk::Answer answer, std::size_t data_bytes,
             Message kind);
    void write(std::uint8_t number, std::uint32_t value, Message kind);
    void send();
    void answered(const protocol::mactalk::Reply& reply);
    void missed();
    void give_up_upload();
    void done();

    sim::World& world_;
    std::deque<Message> messages_;
    protocol::mactalk::ReplyDecoder decoder_;
    bool waits_ = false;
    Time deadline_{0};
    std::size_t uploads_ = 0;  ///< messages of uploads that wait
    bool committed_ = false;
    std::uint64_t answers_ = 0;
    std::uint64_t silences_ = 0;
};

}  // namespace nplc::soak
