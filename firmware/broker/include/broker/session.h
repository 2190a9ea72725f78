#pragma once

#include <memory>
#include <string>
#include <vector>

#include "broker/options.h"

struct mosquitto;

/// Functions shared by all clients of a broker. Needs libmosquitto: if kIsBuiltIn is false, nothing else in
/// this file is defined but mistakes_in_files(), which finds none.
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

/// What is wrong with the files of TLS, and what to do; each names its file.
std::vector<Mistake> mistakes_in_files(const Options& options);

struct Secrets {
    std::string password{};
    std::string error{};  ///< one line: a file that cannot be read, is empty or holds something else
};
Secrets read_secrets(const Options& options);

/// User, password and TLS. Empty, or the library's error.
std::string set_secrets(mosquitto* session, const Options& options, const std::string& password);

/// For the log's callback: an error in `text`; of TLS also what to do about it.
std::string explained(mosquitto* session, const std::string& text);

/// Text of an error code; to be called directly after the failed function.
std::string reason_of(int code);

}  // namespace nplc::broker
