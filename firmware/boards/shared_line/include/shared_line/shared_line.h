#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal_linux/byte_server.h"
#include "protocol/mactalk.h"
#include "registers/vocabulary.h"
#include "seat/seat.h"
#include "shared_line/purpose.h"

namespace nplc::boards {

/// Several clients on one MacTalk line: only whole messages go onto it, one at a time, and what comes back is
/// for the client whose message it answers. Clients take turns. A message that got no answer keeps the line
/// for a while, so that its client may ask once why; whom nobody answered the last time is waited for
/// briefly, and what is for nobody on the line not at all. A read that its client has not waited for is
/// dropped.
///
/// A stop, safe or hold command waits for nobody: it ends another client's turn, and what others sent before
/// it and would operate the gateway or the motor is refused. Such a message is refused too if its client has
/// left, or if more than kLongestUnread may have passed since it was sent, or if another client operates. The
/// client of a refused message hears nothing, and RESULT reads why for it until its next write.
///
/// With a password a client that has not given it may read and stop, and what needs no seat.
class SharedLine {
  public:
    using Time = std::chrono::nanoseconds;
    static constexpr Time kLongestAnswer = std::chrono::milliseconds{1'500};
    static constexpr Time kBriefly = std::chrono::milliseconds{150};  ///< beside the message's own time
    static constexpr Time kLongestUnread = std::chrono::seconds{1};
    /// What came between two looks is as old as the time between them.
    static constexpr Time kBetweenLooks = std::chrono::milliseconds{250};

    struct Addresses {
        std::uint8_t gateway;
        std::uint8_t motor;
    };

    /// `operators`: who may operate, of all clients of the axis; null: everybody. `password`: empty, none is
    /// asked for.
    explicit SharedLine(hal_linux::ByteServer& server, faces::Seat* operators = nullptr,
                        std::string password = {});
    ~SharedLine();
    SharedLine(const SharedLine&) = delete;
    SharedLine& operator=(const SharedLine&) = delete;

    /// What is to be put on the line now. Time runs on while the process is halted.
    std::vector<std::uint8_t> to_line(Time now, const Addresses& addresses);
    /// When to_line() is wanted at the latest if no client sends anything.
    Time next_turn(Time now) const;
    void from_line(std::span<const std::uint8_t> bytes, Time now);
    /// Given by clients since the start.
    unsigned wrong_passwords() const { return wrong_passwords_; }

  private:
    struct Frame {
        protocol::mactalk::Request request{};
        Purpose purpose{};
        Time since{};  ///< it was sent at this time or later
        std::vector<std::uint8_t> bytes{};
        bool needs_seat = false;
    };
    struct Seat {
        protocol::mactalk::RequestDecoder decoder{};
        std::deque<Frame> frames{};
        std::uint64_t visit = 0;
        bool unanswered = false;                 ///< its last message
        Time drained{};                          ///< nothing was left to be read then
        bool has_password = false;               ///< it has given it
        std::uint64_t sitter = 0;                ///< its number among the axis's clients
        std::optional<std::uint32_t> refused{};  ///< what RESULT reads for it, of its last message
    };
    struct Stop {
        std::size_t seat;
        std::uint64_t visit;
        Frame frame;
    };

    void listen(std::size_t number, Time now, std::uint8_t gateway_address);
    void take_byte(std::size_t number, std::uint8_t byte, std::uint8_t gateway_address);
    bool is_about_password(std::size_t number, const protocol::mactalk::Request& request,
                           std::uint8_t gateway_address);
    void take_password(std::size_t number, std::span<const std::uint8_t> given);
    void take_stop(std::size_t number, Frame frame);
    void welcome(Seat& seat, std::size_t number, std::uint64_t visit);
    std::optional<std::size_t> next_seat() const;
    std::optional<Stop> next_stop();
    std::vector<std::uint8_t> begin_stop(const Stop& stop, Time now, const Addresses& addresses);
    std::optional<std::uint32_t> refusal(std::size_t number, const Frame& frame, Time now);
    void let_go();
    bool refuses(std::size_t number, const Frame& frame, Time now);
    void expect(std::size_t number, const Frame& frame, Time now, const Addresses& addresses);
    void end_turn(bool answered);

    hal_linux::ByteServer& server_;
    faces::Seat* operators_;
    std::string password_;
    unsigned wrong_passwords_ = 0;
    std::vector<Seat> seats_;
    std::deque<Stop> stops_;
    std::optional<Time> looked_;         ///< at all seats, the last time
    std::optional<std::size_t> asking_;  ///< the seat whose answer is to come
    Frame asked_;                        ///< by it; without its bytes
    bool asked_again_ = false;           ///< in this turn
    bool asker_is_gone_ = false;
    std::size_t last_ = 0;  ///< the seat that asked last
    bool samples_ = false;
    Time until_{0};
    Time sent_{0};
    protocol::mactalk::ReplyDecoder answer_;
};

}  // namespace nplc::boards
