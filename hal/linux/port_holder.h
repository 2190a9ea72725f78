#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <functional>
#include <string>

namespace nplc::hal_linux {

/// "minicom (process 1234)": another program that has a matching file open; empty if there is none whose
/// files we may read.
std::string program_with(const std::function<bool(const struct stat&)>& is_it);

/// The same for a client that is connected to the socket of this name, or to this port of 127.0.0.1.
std::string client_of_unix(const std::string& path);
std::string client_of_tcp(std::uint16_t port);

}  // namespace nplc::hal_linux
