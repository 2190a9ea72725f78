#pragma once

#include <memory>
#include <string>

#include "broker/options.h"

struct mosquitto;

/// What is the same for every client of a broker. Needs libmosquitto: where kIsBuiltIn is false, nothing else
/// of this file is there.
namespace nplc::broker {

extern const bool kIsBuiltIn;

/// libmosquitto, for as long as it is used.
struct Library {
    Library();
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

using Session = std::unique_ptr<mosquitto, void (*)(mosquitto*)>;
/// With a clean session; null: no memory. `self` is what the callbacks get.
Session new_session(const std::string& name, void* self);

struct Secrets {
    std::string password{};
    std::string error{};  ///< one line: a file that cannot be read, or holds none
};
Secrets read_secrets(const Options& options);

/// User, password and TLS. Empty, or why the library does not take them.
std::string set_secrets(mosquitto* session, const Options& options, const std::string& password);

/// Of a function of the library, read at once after it.
std::string reason_of(int code);

}  // namespace nplc::broker
