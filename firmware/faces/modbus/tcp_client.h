#pragma once

#include <array>
#include <string>
#include <vector>

#include "modbus/session.h"
#include "unit_set.h"

namespace nplc::modbus {

/// A client of the TCP server: whole messages in, answers out, one at a time.
class TcpClient {
  public:
    /// Owns the descriptor. `since.arrived`: it had sent nothing then.
    TcpClient(int descriptor, UnitSet& set, const std::string& name, faces::Bell& bell, const Moment& since);
    ~TcpClient();
    TcpClient(const TcpClient&) = delete;
    TcpClient& operator=(const TcpClient&) = delete;

    int descriptor() const { return descriptor_; }
    /// What to poll for. A client that does not take its answers is not read either.
    short events() const;
    void serve(short events, base::Instant now);
    /// When serve() is wanted without an event.
    base::Instant due(base::Instant now) const;
    bool is_gone() const { return is_gone_; }
    /// Its last whole message.
    base::Instant heard() const { return heard_; }
    std::uint64_t number() const { return session_.number(); }

  private:
    static constexpr std::size_t kHead = 7;
    static constexpr std::size_t kMostFrame = kHead + kMostPdu;

    void read(base::Instant now);
    bool serve_one(base::Instant now);
    bool waits_for_image(base::Instant now);
    void put(const Answer& answer);
    void send();

    int descriptor_;
    UnitSet& set_;
    Session session_;
    bool is_gone_ = false;
    base::Instant heard_;
    base::Instant began_{};    ///< the message that is not whole, or the answer that is not taken
    base::Instant silent_at_;  ///< nothing was to be read then
    base::Instant arrived_{};  ///< what was read last came after that
    bool has_more_ = false;    ///< messages that are whole wait for their turn
    bool has_left_ = false;    ///< it has closed its end
    base::Instant image_asked_{};
    bool asks_image_ = false;
    std::array<std::uint8_t, 4 * kMostFrame> in_{};
    std::size_t have_ = 0;
    std::array<std::uint8_t, kHead> head_{};  ///< of the request that is being served
    std::vector<std::uint8_t> out_;
};

}  // namespace nplc::modbus
