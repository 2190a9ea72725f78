#pragma once

#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "verify/property.h"

namespace nplc::verify {

/// Reads properties a token at a time; stops at the first error.
class PropertyParser {
  public:
    PropertyParser(std::string_view text, const Names& names);
    PropertyReading parse();

  private:
    struct Token {
        enum class Kind : std::uint8_t { end, word, number, direct, symbol };
        Kind kind = Kind::end;
        std::string_view text;
        std::size_t line = 1;
        std::size_t column = 1;
    };

    void split(std::string_view text);
    const Token& token(std::size_t ahead = 0) const;
    bool at(std::string_view word, std::size_t ahead = 0) const;
    bool take(std::string_view word);
    bool expect(std::string_view word, std::string_view where);
    bool fail(std::string message);
    std::string shown() const;
    std::string guess(std::span<const std::string> known, std::string_view otherwise) const;

    bool parse_property();
    bool parse_assumption();
    bool parse_stable(Assumption& assumption);
    std::string text_since(std::size_t first) const;
    bool parse_never(Property& property);
    bool needs_a_time(const Property& property);
    bool parse_between(Property& property);
    bool parse_whenever(Property& property);
    bool parse_only(Property& property);
    bool parse_condition_first(Property& property);
    bool begins_no_claim() const;
    bool parse_form(Property& property);
    const NamedTime* time_named(const Token& token) const;
    bool parse_time(std::uint32_t& milliseconds);
    bool parse_condition(Condition& result) { return parse_operators(result, 0); }
    bool parse_operators(Condition& result, std::size_t level);
    bool parse_primary(Condition& result);
    bool parse_step(Condition& result);
    bool parse_group(Condition& result);
    bool parse_signal(Condition& result);

    static constexpr int kDeepest = 100;

    const Names& names_;
    std::vector<Token> tokens_;
    std::deque<std::string> spelled_;  ///< what stands for names of times
    std::size_t at_ = 0;
    int depth_ = 0;
    PropertyReading reading_;
};

}  // namespace nplc::verify
