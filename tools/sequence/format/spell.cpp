#include "format/layout.h"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>

#include "language/names.h"
#include "language/reserved_words.h"
#include "registers/details.h"
#include "registers/mac.h"
#include "symbols/commands.h"
#include "symbols/motors.h"

namespace nplc::seqc::layout {
namespace {

constexpr std::array<std::string_view, 10> kUnits = {"counts", "count", "rev",     "rpm",   "s",
                                                     "s2",     "ms",    "samples", "%peak", "%nominal"};

/// Keywords that a statement may follow.
constexpr std::array<std::string_view, 6> kBeforeStatement = {"THEN",       "ELSE",   "ENTRY",
                                                              "EVERY_SCAN", "END_IF", "POWER_UP"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_digits(std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

/// The spelling of names in their declarations.
class Names {
  public:
    void declare(std::string_view name) { names_.try_emplace(upper(name), name); }
    std::optional<std::string_view> find(std::string_view name) const {
        const auto found = names_.find(upper(name));
        return found == names_.end() ? std::nullopt : std::optional(found->second);
    }

  private:
    std::unordered_map<std::string, std::string_view> names_;
};

class Speller {
  public:
    explicit Speller(Document& document) : document_(document), tokens_(document) {}

    void run() {
        mark_keywords();
        collect_declarations();
        for (at_ = 0; at_ < tokens_.size(); ++at_) {
            follow_blocks();
            const std::string spelled = spelled_here();
            if (spelled != tokens_[at_].text) respell(tokens_[at_], spelled);
        }
    }

  private:
    void respell(Item& item, std::string text) { item.text = document_.texts.emplace_back(std::move(text)); }

    /// A word after '/' is part of a unit.
    void mark_keywords() {
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            Item& item = tokens_[i];
            const bool in_unit = i > 0 && tokens_.is_symbol(i - 1, "/");
            if (item.kind != Item::Kind::name || in_unit || !is_reserved(item.text)) continue;
            item.kind = Item::Kind::keyword;
            if (upper(item.text) != item.text) respell(item, upper(item.text));
        }
    }

    void collect_declarations() {
        for (at_ = 0; at_ < tokens_.size(); ++at_) {
            follow_blocks();
            const Item& item = tokens_[at_];
            if (item.kind != Item::Kind::name || at_ == 0) continue;
            if (tokens_.is_keyword(at_ - 1, "STEP") || tokens_.is_keyword(at_ - 1, "GROUP"))
                steps_.declare(item.text);
            if (is_parameter_here()) variables_.declare(item.text);
            const bool is_value =
                tokens_.is_keyword(at_ - 1, "CONST") || tokens_.is_keyword(at_ - 1, "SET_POINT");
            if (is_value || (in_variables_ && tokens_.is_keyword(at_ + 1, "AT")))
                variables_.declare(item.text);
            if (tokens_.is_keyword(at_ - 1, "MOTOR"))
                motor_ = motor_named(item.text).value_or(MotorChoice{motor_}).map;
            if (in_scale_ && !is_unit(item.text)) units_.declare(item.text);
        }
    }

    void follow_blocks() {
        const Item& item = tokens_[at_];
        if (behind_symbol("(") || behind_symbol(",")) return;  // a parameter of a SEQUENCE
        if (item.is_keyword("SCALE")) in_scale_ = true;
        if (item.is_symbol(";")) in_scale_ = in_steps_ = false;
        if (item.is_keyword("NEXT")) in_steps_ = false;
        if (item.is_keyword("GROUP") || (item.is_keyword("IN") && !behind_keyword("STEP")) ||
            item.is_keyword("EXCEPT"))
            in_steps_ = true;
        if (item.is_keyword("END_VAR")) in_variables_ = false;
        if (item.is_keyword("VAR_INPUT") || item.is_keyword("VAR_OUTPUT") || item.is_keyword("VAR_MOTOR"))
            in_variables_ = true;
    }

    static bool is_unit(std::string_view text) {
        return std::any_of(kUnits.begin(), kUnits.end(),
                           [&](std::string_view unit) { return same_name(unit, text); });
    }
    std::string unit(std::string_view text) const;
    std::string command(std::string_view text) const;
    std::string place(std::string_view text) const;
    static std::string direct(std::string_view text);
    std::string name_here() const;
    bool is_word_of_property(std::string_view text) const;
    /// SEQUENCE Close(VAR_OUTPUT Valve, ..
    bool is_parameter_here() const {
        return at_ > 1 && tokens_[at_ - 1].kind == Item::Kind::keyword &&
               (tokens_.is_symbol(at_ - 2, "(") || tokens_.is_symbol(at_ - 2, ","));
    }
    bool is_word_of_output(std::string_view text) const;
    bool is_place_at(std::size_t at) const {
        return at < tokens_.size() &&
               (tokens_[at].kind == Item::Kind::name || tokens_[at].token == TokenKind::direct);
    }
    std::string spelled_here() const;
    bool behind_keyword(std::string_view word) const { return at_ > 0 && tokens_.is_keyword(at_ - 1, word); }
    bool behind_symbol(std::string_view symbol) const {
        return at_ > 0 && tokens_.is_symbol(at_ - 1, symbol);
    }
    bool begins_statement() const;

    Document& document_;
    Tokens tokens_;
    Names steps_;
    Names variables_;
    Names units_;
    registers::Model motor_ = registers::Model::mac140;
    std::size_t at_ = 0;
    bool in_variables_ = false;
    bool in_scale_ = false;
    bool in_steps_ = false;
};

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

std::string time_text(std::string_view text) {
    const std::size_t mark = text.find('#');
    return upper(text.substr(0, mark)) + lower(text.substr(mark));
}

std::string Speller::unit(std::string_view text) const {
    return is_unit(text) ? lower(text) : std::string(units_.find(text).value_or(text));
}

std::string Speller::command(std::string_view text) const {
    if (const NamedCommand* found = find_command(text)) return std::string(found->name);
    for (std::string_view name : command_names()) {
        if (same_name(name, text)) return std::string(name);
    }
    return std::string(text);
}

/// A signal, a register or a variable that stands for one.
std::string Speller::place(std::string_view text) const {
    if (const auto declared = variables_.find(text)) return std::string(*declared);
    const std::string capitals = upper(text);
    for (std::string_view prefix : {"IN", "OUT"}) {
        if (capitals.starts_with(prefix) && is_digits(std::string_view(capitals).substr(prefix.size())))
            return capitals;
    }
    const registers::Register* found = registers::find(motor_, text);
    if (found == nullptr) return registers::is_name_of_value(motor_, text) ? capitals : std::string(text);
    return same_name(found->name, text) ? std::string(found->name) : capitals;
}

std::string Speller::direct(std::string_view text) {
    const bool is_address = same_name(text.substr(0, 3), "%IX") || same_name(text.substr(0, 3), "%QX");
    return is_unit(text) ? lower(text) : is_address ? upper(text) : std::string(text);
}

bool Speller::begins_statement() const {
    if (at_ == 0 || behind_symbol(";") || behind_symbol(":")) return true;
    return tokens_[at_ - 1].kind == Item::Kind::keyword && contains(kBeforeStatement, tokens_[at_ - 1].text);
}

/// Words of properties that are names elsewhere.
bool Speller::is_word_of_property(std::string_view text) const {
    const auto is = [&](std::string_view keyword, std::string_view word) {
        return behind_keyword(keyword) && same_name(text, word);
    };
    if (is("ONLY", "AFTER") || is("FOLLOWED", "BY") || is("STAYS", "OFF")) return true;
    if (is("EVERY_SCAN", "FROM")) return !tokens_.is_symbol(at_ + 1, ":=");
    const bool begins_claim = at_ > 2 && behind_symbol(":") && tokens_.is_keyword(at_ - 3, "PROPERTY");
    const bool before_fact = tokens_.is_keyword(at_ + 1, "NOT") || tokens_.is_keyword(at_ + 1, "STEP") ||
                             tokens_.is_keyword(at_ + 1, "INPOS") || tokens_.is_symbol(at_ + 1, "(") ||
                             (at_ + 1 < tokens_.size() && tokens_[at_ + 1].kind == Item::Kind::name);
    return begins_claim && same_name(text, "AFTER") && before_fact;
}

/// SET Clamp; OUT Lamp BLINKING T#1s; R_TRIG(Start)
bool Speller::is_word_of_output(std::string_view text) const {
    if (same_name(text, "SET") || same_name(text, "RESET")) return begins_statement() && is_place_at(at_ + 1);
    if (same_name(text, "CALL")) return begins_statement() && is_place_at(at_ + 1);
    if (same_name(text, "RETURN")) return begins_statement() && tokens_.is_symbol(at_ + 1, ";");
    if (same_name(text, "R_TRIG") || same_name(text, "F_TRIG")) return tokens_.is_symbol(at_ + 1, "(");
    return same_name(text, "BLINKING") && at_ > 0 && is_place_at(at_ - 1);
}

std::string Speller::name_here() const {
    const std::string_view text = tokens_[at_].text;
    const bool behind_number = at_ > 0 && tokens_[at_ - 1].token == TokenKind::number;
    if (is_word_of_property(text) || is_word_of_output(text)) return upper(text);
    if (behind_number || (behind_symbol("/") && !variables_.find(text))) return unit(text);
    if (behind_symbol(".")) return upper(text);
    if (behind_keyword("PROGRAM") || behind_keyword("STEP") || behind_keyword("CONST") ||
        behind_keyword("SET_POINT"))
        return std::string(text);
    const bool behind_next = at_ > 1 && behind_symbol(":=") && tokens_.is_keyword(at_ - 2, "NEXT");
    const bool behind_step_in = at_ > 1 && behind_keyword("IN") && tokens_.is_keyword(at_ - 2, "STEP");
    if (behind_next || behind_step_in || in_steps_ || behind_keyword("TERM"))
        return std::string(steps_.find(text).value_or(text));
    if (behind_keyword("MOTOR")) return motor_named(text) ? upper(text) : std::string(text);
    if (in_variables_ && tokens_.is_keyword(at_ + 1, "AT")) return std::string(text);
    if (in_variables_ && behind_symbol(":")) return upper(text);
    if (begins_statement() && !tokens_.is_symbol(at_ + 1, ":=")) return command(text);
    return place(text);
}

std::string Speller::spelled_here() const {
    const Item& item = tokens_[at_];
    switch (item.token) {
        case TokenKind::based:
            return upper(item.text);
        case TokenKind::time:
            return time_text(item.text);
        case TokenKind::direct:
            return direct(item.text);
        case TokenKind::identifier:
            return item.kind == Item::Kind::keyword ? std::string(item.text) : name_here();
        default:
            return std::string(item.text);
    }
}

}  // namespace

void spell(Document& document) {
    Speller(document).run();
}

}  // namespace nplc::seqc::layout
