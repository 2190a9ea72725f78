#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

/// Messages of JSON as the language server and debug adapter protocols carry them: a header with
/// Content-Length, an empty line, the content.
namespace nplc::rpc {

using Json = nlohmann::json;

/// More than any message of an editor has.
inline constexpr std::size_t kLongestMessage = 64U << 20;

struct Incoming {
    enum class Kind : std::uint8_t { message, malformed, end };
    Kind kind = Kind::end;
    Json message;
    std::string problem;  ///< of a malformed one: it was read over
};

Incoming read_message(std::istream& in);
/// What is no UTF-8 is replaced.
void write_message(std::ostream& out, const Json& message);

}  // namespace nplc::rpc
