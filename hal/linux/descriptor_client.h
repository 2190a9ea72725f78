#pragma once

#include <string>

#include "file_descriptor.h"
#include "host/byte_client.h"

namespace nplc::hal_linux {

/// A client of any descriptor that does not block.
class DescriptorClient : public host::ByteClient {
  public:
    DescriptorClient(FileDescriptor descriptor, std::string name)
        : descriptor_(std::move(descriptor)), name_(std::move(name)) {}

    const std::string& name() const override { return name_; }
    bool write(std::span<const std::uint8_t> bytes) override;
    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override;
    base::Instant now() const override;

  protected:
    int descriptor() const { return descriptor_.get(); }

  private:
    FileDescriptor descriptor_;
    std::string name_;
};

host::ByteClient::Opened open_terminal_client(const std::string& path, const std::string& name,
                                              std::uint32_t baud, host::ByteClient::Holding holding);
host::ByteClient::Opened open_unix_client(const std::string& path);
/// `where`: 127.0.0.1:PORT; other machines' addresses are refused.
host::ByteClient::Opened open_tcp_client(const std::string& where);

}  // namespace nplc::hal_linux
