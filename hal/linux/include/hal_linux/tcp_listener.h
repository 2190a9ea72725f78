#pragma once

#include <cstdint>
#include <string>

namespace nplc::hal_linux {

/// A TCP socket that listens, for clients of any number. It never blocks, and neither do the clients'
/// sockets.
class TcpListener {
  public:
    TcpListener() = default;
    ~TcpListener();
    TcpListener(const TcpListener&) = delete;
    TcpListener& operator=(const TcpListener&) = delete;

    /// `where`: "tcp:ADDRESS:PORT", ADDRESS of IPv4 or, in brackets, IPv6; PORT 0 lets the system choose.
    /// Empty, or in one line why not and what to do.
    std::string open(const std::string& where);
    /// "tcp:127.0.0.1:1502", with the port that the system chose.
    const std::string& name() const { return name_; }
    /// Readable while a client waits.
    int descriptor() const { return descriptor_; }

    struct Client {
        int descriptor = -1;  ///< negative: nobody waits; else the caller's
        std::string peer{};   ///< its address in numbers
    };
    Client accept() const;

    /// Why this is no place to listen; empty: it is one.
    static std::string mistake_in(const std::string& where);

  private:
    int descriptor_ = -1;
    std::string name_;
};

}  // namespace nplc::hal_linux
