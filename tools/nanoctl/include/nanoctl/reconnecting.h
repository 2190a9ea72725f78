#pragma once

#include <functional>
#include <memory>
#include <string>

#include "host/byte_client.h"

namespace nplc::nanoctl {

/// A client that reconnects whenever the other end closes the connection, until `patience` has passed since
/// this object was made; what is sent while it is not connected is lost, as on a bad line. After that the
/// other end counts as gone.
class Reconnecting final : public host::ByteClient {
  public:
    using Open = std::function<Opened()>;
    using Sleep = std::function<void(base::Microseconds)>;
    Reconnecting(std::unique_ptr<ByteClient> first, Open open, Sleep sleep, base::Microseconds patience)
        : client_(std::move(first)),
          open_(std::move(open)),
          sleep_(std::move(sleep)),
          end_(client_->now() + patience) {}

    const std::string& name() const override { return client_->name(); }
    bool write(std::span<const std::uint8_t> bytes) override;
    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override;
    std::string other_client() const override { return client_->other_client(); }
    Rest rest(base::Microseconds time) override { return client_->rest(time); }
    std::string holder() const override { return client_->holder(); }
    base::Instant now() const override { return client_->now(); }

  private:
    bool connect();

    std::unique_ptr<ByteClient> client_;  ///< the last one, for its name and clock while disconnected
    Open open_;
    Sleep sleep_;
    base::Instant end_;
    bool is_connected_ = true;
};

}  // namespace nplc::nanoctl
