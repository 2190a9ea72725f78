#pragma once

#include <array>
#include <string>
#include <vector>

#include "modbus/session.h"
#include "unit_set.h"

namespace nplc::modbus {

/// A client of the TCP server: complete messages in, answers out, one at a time.
class TcpClient {
  public:
    /// Owns the descriptor. `since.arrived`: it had sent nothing at that time.
    TcpClient(int descriptor, UnitSet& set, const std::string& name, faces::Bell& bell, const Moment& since);
    ~TcpClient();
    TcpClient(const TcpClient&) = delete;
    TcpClient& operator=(const TcpClient&) = delete;

    int descriptor() const { return descriptor_; }
    /// Events for poll(). A client that does not read its answers is not read either.
    short events() const;
    void serve(short events, base::Instant now);
    /// When serve() is needed without an event.
    base::Instant due(base::Instant now) const;
    bool is_gone() const { return is_gone_; }
    /// Time of its last complete message.
    base::Instant heard() const { return heard_; }
    std::uint64_t number() const { return session_.number(); }

  private:
    static constexpr std::size_t kHead = 7;
    static constexpr std::size_t kMostFrame = kHead + kMostPdu;

    void read(base::Instant now);
    bool serve_one(base::Instant now);
    bool has_stop_behind() const;
    bool waits_for_image(base::Instant now);
    void put(const Answer& answer);
    void send();

    int descriptor_;
    UnitSet& set_;
    Session session_;
    bool is_gone_ = false;
    base::Instant heard_;
    base::Instant began_{};    ///< start of an incomplete message, or of an unsent answer
    base::Instant silent_at_;  ///< last time when no data were pending
    base::Instant arrived_{};  ///< the last data read arrived after this
    bool has_more_ = false;    ///< complete messages are pending
    bool has_left_ = false;    ///< it has closed its side
    base::Instant image_asked_{};
    bool asks_image_ = false;
    std::array<std::uint8_t, 4 * kMostFrame> in_{};
    std::size_t have_ = 0;
    std::array<std::uint8_t, kHead> head_{};  ///< of the request in progress
    std::vector<std::uint8_t> out_;
};

}  // namespace nplc::modbus
