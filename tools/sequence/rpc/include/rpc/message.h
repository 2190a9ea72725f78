#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

/// JSON messages of the language server and debug adapter protocols: a header with Content-Length, an empty
/// line, the content.
namespace nplc::rpc {

using Json = nlohmann::json;

/// Longer than any message of an editor.
inline constexpr std::size_t kLongestMessage = 64U << 20;
/// The most lists and objects in each other.
inline constexpr std::size_t kDeepestMessage = 100;

struct Incoming {
    enum class Kind : std::uint8_t { message, malformed, end };
    Kind kind = Kind::end;
    Json message;
    std::string problem;  ///< error of a malformed message, which was skipped
};

Incoming read_message(std::istream& in);
/// Invalid UTF-8 is replaced.
void write_message(std::ostream& out, const Json& message);

}  // namespace nplc::rpc
