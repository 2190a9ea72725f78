// Any text is formatted or refused with messages. What is formatted keeps its words, comments and bytes, and
// is formatted for good. Input whose first byte is below 32 picks statements and the gaps between their
// words, so that it makes a program.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "fuzz.h"
#include "seqc/format.h"
#include "seqc/seqc.h"

namespace {

using namespace nplc::seqc;

/// A gap stands at each '~'.
constexpr std::array<std::string_view, 12> kPieces = {
    "OUT~OUT0~,~OUT1~WHEN~IN2~;~",
    "IF~IN0~AND~NOT~IN1~THEN~NEXT~:=~S~;~END_IF~",
    "IF~(~IN0~OR~IN1~)~THEN~STOP~;~ELSIF~IN2~THEN~;~ELSE~NEXT~:=~S~;~END_IF~;~",
    "IF~IN0~AND~A_Very_Long_Name_That_Fills_Half_A_Line_And_More~AND~IN2~OR~"
    "A_Very_Long_Name_That_Fills_Half_A_Line_And_More~THEN~END_IF~",
    "TERM~1~,~2~;~",
    "~",
    ";~",
    "END_STEP~STEP~S~:~OWN~ERROR~;~",
    "END_STEP~VAR_INPUT~Name~AT~IN0~:~BOOL~;~B~AT~%IX0.1~;~END_VAR~STEP~Z~:~",
    "END_STEP~VAR_MOTOR~V~AT~REG~(~33~)~:=~-~5~mm~/~s~;~END_VAR~TERM~0~;~STEP~Z~:~",
    "END_STEP~POWER_UP~NEXT~:=~Z~;~END_POWER_UP~STEP~Z~:~",
    "ENTRY~POSITION~(~P1~)~;~TIMER~:=~T#500ms~;~",
};

constexpr std::array<std::string_view, 16> kGaps = {
    " ",
    " ",
    " ",
    "\n",
    "\n\n\n",
    "\r\n\t",
    " // c\n",
    "\n// c\n",
    "\n        // d\n",
    " (* c *) ",
    "\n(* c *) ",
    " (* c *)\n",
    " (* c\n d *) ",
    "\n\n    (* c *)\n",
    "\n                                        // e\n",
    "                          // e\n",
};

/// Bytes used up count as 0.
class Picks {
  public:
    explicit Picks(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    bool empty() const { return bytes_.empty(); }
    std::size_t operator()(std::size_t count) {
        if (bytes_.empty()) return 0;
        const std::size_t pick = bytes_.front() % count;
        bytes_ = bytes_.subspan(1);
        return pick;
    }

  private:
    std::span<const std::uint8_t> bytes_;
};

std::string program_of(std::span<const std::uint8_t> bytes) {
    std::string text = "PROGRAM P STEP S:";
    Picks pick(bytes);
    while (!pick.empty()) {
        for (char c : kPieces[pick(kPieces.size())]) c == '~' ? text += kGaps[pick(kGaps.size())] : text += c;
    }
    return text + " END_STEP END_PROGRAM";
}

/// All that is no blank, in small letters.
std::string squeezed(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    std::string result;
    for (char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isspace(byte) == 0) result += static_cast<char>(std::tolower(byte));
    }
    return result;
}

bool says_too_often(const Formatted& formatted) {
    return !formatted.diagnostics.empty() &&
           std::all_of(formatted.diagnostics.begin(), formatted.diagnostics.end(),
                       [](const Diagnostic& d) { return d.code == "E020" || d.code == "E090"; });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const bool picks = size > 0 && data[0] < ' ';
    const std::string source =
        picks ? program_of({data, size}) : std::string(reinterpret_cast<const char*>(data), size);
    const Formatted formatted = format_program(source);
    require(formatted.fault.empty());
    require(formatted.ok == formatted.diagnostics.empty());
    // Only a hundred of what may stand once is too much of a program made of pieces.
    require(!picks || formatted.ok || says_too_often(formatted));
    if (!formatted.ok) return 0;
    require(squeezed(formatted.text) == squeezed(source));
    const Formatted again = format_program(formatted.text);
    require(again.ok && again.text == formatted.text);
    require(compile(formatted.text).table == compile(source).table);
    return 0;
}
