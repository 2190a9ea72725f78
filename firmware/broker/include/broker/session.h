#pragma once

#include <memory>
#include <string>

#include "broker/options.h"

struct mosquitto;

/// Functions shared by all clients of a broker. Needs libmosquitto: if kIsBuiltIn is false, nothing else in
/// this file is defined.
namespace nplc::broker {

extern const bool kIsBuiltIn;

/// Initializes libmosquitto for its lifetime.
struct Library {
    Library();
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

using Session = std::unique_ptr<mosquitto, void (*)(mosquitto*)>;
/// With a clean session; null: no memory. `self` is passed to the callbacks.
Session new_session(const std::string& name, void* self);

struct Secrets {
    std::string password{};
    std::string error{};  ///< one line: a file that cannot be read or is empty
};
Secrets read_secrets(const Options& options);

/// User, password and TLS. Empty, or the library's error.
std::string set_secrets(mosquitto* session, const Options& options, const std::string& password);

/// Text of an error code; to be called directly after the failed function.
std::string reason_of(int code);

}  // namespace nplc::broker
