#include "mactalk_client/wire.h"

namespace nplc::mactalk_client {
namespace {

class LineWire final : public Wire {
  public:
    explicit LineWire(std::unique_ptr<host::ByteClient> client) : client_(std::move(client)) {}

    const std::string& name() const override { return client_->name(); }
    bool write(std::span<const std::uint8_t> bytes) override { return client_->write(bytes); }
    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override {
        return client_->read(out, wait);
    }
    base::Instant now() override { return client_->now(); }
    std::string other_client() override { return client_->other_client(); }
    Rest rest(base::Microseconds time) override { return client_->rest(time); }
    std::string holder() override { return client_->holder(); }

  private:
    std::unique_ptr<host::ByteClient> client_;
};

}  // namespace

OpenedWire open_wire(const std::string& endpoint, std::uint32_t baud, Holding holding) {
    auto opened = host::ByteClient::open(endpoint, baud, holding);
    if (opened.client == nullptr) return {nullptr, opened.error, opened.never};
    return {std::make_unique<LineWire>(std::move(opened.client)), {}};
}

}  // namespace nplc::mactalk_client
