#pragma once

#include <cstdint>
#include <string>

namespace nplc::hal_linux {

/// What is to be done about the errno of a TCP socket that cannot be bound or listen; one clause.
std::string listen_remedy(int error);
/// A TCP port that this machine keeps for programs with CAP_NET_BIND_SERVICE, usually one below 1024.
bool is_privileged(unsigned port);

/// A listening TCP socket for any number of clients. Neither it nor the clients' sockets block.
class TcpListener {
  public:
    TcpListener() = default;
    ~TcpListener();
    TcpListener(const TcpListener&) = delete;
    TcpListener& operator=(const TcpListener&) = delete;

    /// `where`: "tcp:ADDRESS:PORT", ADDRESS of IPv4 or, in brackets, IPv6; PORT 0 lets the system choose.
    /// Empty, or a one-line error with the remedy.
    std::string open(const std::string& where);
    /// "tcp:127.0.0.1:1502", with the port that the system chose.
    const std::string& name() const { return name_; }
    /// Readable while a client is connecting.
    int descriptor() const { return descriptor_; }

    struct Client {
        int descriptor = -1;  ///< negative: none; else owned by the caller
        std::string peer{};   ///< its address in numbers
    };
    Client accept() const;

    /// Why `where` is no valid address; empty if it is.
    static std::string mistake_in(const std::string& where);
    /// Whether this machine has the address of a valid `where` now.
    static bool has_address(const std::string& where);
    /// Its port, with or without "tcp:" before the address; 0: none.
    static unsigned port_in(const std::string& where);

  private:
    int descriptor_ = -1;
    std::string name_;
};

}  // namespace nplc::hal_linux
