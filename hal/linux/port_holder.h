#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <functional>
#include <string>

namespace nplc::hal_linux {

/// "minicom (process 1234)", a program other than this one that has such a file open; empty if it is none
/// that we may look into.
std::string program_with(const std::function<bool(const struct stat&)>& is_it);

/// The same of a client that is connected to the socket of this name, or to this port of 127.0.0.1.
std::string client_of_unix(const std::string& path);
std::string client_of_tcp(std::uint16_t port);

}  // namespace nplc::hal_linux
