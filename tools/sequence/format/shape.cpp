#include <algorithm>

#include "format/layout.h"
#include "language/names.h"

namespace nplc::seqc::layout {
namespace {

bool is_any(const Item& item, std::initializer_list<std::string_view> symbols) {
    return item.token == TokenKind::symbol &&
           std::find(symbols.begin(), symbols.end(), item.text) != symbols.end();
}

/// Whether an operator may follow.
bool ends_value(const Item& item) {
    return item.kind == Item::Kind::name || item.is_symbol(")") || item.token == TokenKind::number ||
           item.token == TokenKind::based || item.token == TokenKind::time || item.token == TokenKind::direct;
}

bool is_part_of_rate(const Item& item) {
    return same_name(item.text, "s") || same_name(item.text, "s2");
}

bool is_blank_between(const Item& before, const Item& a, const Item& b, const Item& after) {
    if (b.is_comment()) return !a.is_symbol("(");
    if (is_any(b, {";", ",", ")", ".", ":"})) return false;
    if (b.is_symbol("/")) return !(a.kind == Item::Kind::name && is_part_of_rate(after));
    if (a.is_comment()) return true;
    if (is_any(a, {"(", "."})) return false;
    if (a.is_symbol("/")) return !(before.kind == Item::Kind::name && is_part_of_rate(b));
    if (is_any(a, {"+", "-"})) return ends_value(before);
    const bool is_call = a.kind == Item::Kind::name || a.is_keyword("REG");
    return !(b.is_symbol("(") && is_call);
}

class Shaper {
  public:
    explicit Shaper(Document& document) : items_(document.items), tokens_(document) {}

    void run() {
        const Item none;
        for (std::size_t i = 1; i < items_.size(); ++i) {
            const Item& before = i > 1 ? items_[i - 2] : none;
            const Item& after = i + 1 < items_.size() ? items_[i + 1] : none;
            items_[i].blanks = is_blank_between(before, items_[i - 1], items_[i], after) ? 1 : 0;
        }
        while (at_ < tokens_.size()) shape_item();
    }

  private:
    void begin_line(std::size_t level, Role role) {
        if (at_ == tokens_.size()) return;
        Item& item = tokens_[at_];
        item.starts_line = true;
        item.level = static_cast<std::uint8_t>(level + base_);
        item.role = role;
    }

    bool skip(std::string_view symbol) {
        if (!tokens_.is_symbol(at_, symbol)) return false;
        ++at_;
        return true;
    }

    bool is_end(std::size_t i) const { return i >= tokens_.size(); }

    std::size_t find(std::size_t from, std::string_view keyword) const {
        while (!is_end(from) && !tokens_.is_keyword(from, keyword)) ++from;
        return from;
    }

    bool has_branches(std::size_t from, std::size_t to) const {
        while (from < to && !tokens_.is_keyword(from, "ELSIF") && !tokens_.is_keyword(from, "ELSE")) ++from;
        return from < to;
    }

    /// Index after the closing word at `i` and an optional semicolon.
    std::size_t past(std::size_t i) const {
        if (!is_end(i)) ++i;
        return tokens_.is_symbol(i, ";") ? i + 1 : i;
    }

    bool is_symbolic_term(std::size_t i) const {
        return tokens_.is_keyword(i, "TERM") &&
               (tokens_.is_keyword(i + 1, "IF") || tokens_.is_symbol(i + 2, ":"));
    }

    std::size_t end_of_statement(std::size_t i) const {
        if (tokens_.is_keyword(i, "IF") || is_symbolic_term(i)) return past(find(i, "END_IF"));
        while (!is_end(i) && !tokens_.is_symbol(i, ";")) ++i;
        return past(i);
    }

    /// Comments before a token on its line; those after code belong to that code.
    std::size_t led_by(std::size_t token) const {
        std::size_t sum = 0;
        std::size_t i = tokens_.place(token);
        for (; i > 0 && items_[i].breaks == 0 && items_[i - 1].is_comment(); --i)
            sum += width(items_[i - 1].text) + 1;
        return i > 0 && items_[i].breaks == 0 ? 0 : sum;
    }

    /// Whether tokens `first` to `last` are on one line of the source and would fit on one here.
    bool stays_on_one_line(std::size_t first, std::size_t last, std::size_t level) const {
        if (is_end(last)) return false;
        std::size_t sum = (level + base_) * kIndent + width(tokens_[first].text);
        for (std::size_t i = tokens_.place(first) + 1; i <= tokens_.place(last); ++i) {
            const Item& item = items_[i];
            if (item.breaks > 0 || item.text.find('\n') != item.text.npos) return false;
            sum += item.blanks + width(item.text);
        }
        return sum <= kWidestOneLiner && led_by(first) + sum <= kWidest;
    }

    /// Exactly one statement between two tokens, and no IF with more than one branch.
    bool is_single(std::size_t from, std::size_t to) const {
        while (from < to && tokens_.is_symbol(from, ";")) ++from;
        if (from >= to) return false;
        std::size_t end = end_of_statement(from);
        if (has_branches(from, end)) return false;
        while (end < to && tokens_.is_symbol(end, ";")) ++end;
        return end >= to;
    }

    void shape_item();
    void begin_sequence();
    void shape_block(std::string_view end_word);
    void skip_header();
    void shape_statement(std::size_t level);
    void shape_choice(std::size_t level);
    void shape_branches(std::size_t level, std::size_t end);

    std::vector<Item>& items_;
    Tokens tokens_;
    std::size_t at_ = 0;
    std::size_t base_ = 0;  ///< levels of the enclosing SEQUENCE
};

void Shaper::shape_item() {
    const Item& item = tokens_[at_];
    if (item.is_keyword("STEP")) return shape_block("END_STEP");
    if (item.is_keyword("POWER_UP")) return shape_block("END_POWER_UP");
    for (std::string_view word : {"VAR_INPUT", "VAR_OUTPUT", "VAR_MOTOR"}) {
        if (item.is_keyword(word)) return shape_block("END_VAR");
    }
    if (item.is_keyword("SEQUENCE")) return begin_sequence();
    if (item.is_keyword("END_SEQUENCE")) {
        base_ = 0;
        begin_line(0, Role::closer);
        at_ = past(at_);
        return;
    }
    if (item.is_keyword("PROGRAM") || item.is_keyword("END_PROGRAM")) {
        begin_line(0, Role::plain);
        ++at_;
        if (!is_end(at_) && tokens_[at_].kind == Item::Kind::name) ++at_;
        skip(";");
        return;
    }
    shape_statement(0);
}

/// SEQUENCE Name [ "(" parameters ")" ]
void Shaper::begin_sequence() {
    begin_line(0, Role::opener);
    ++at_;
    if (!is_end(at_) && tokens_[at_].kind == Item::Kind::name) ++at_;
    if (tokens_.is_symbol(at_, "(")) {
        while (!is_end(at_) && !tokens_.is_symbol(at_, ")") && !tokens_.is_symbol(at_, ";")) ++at_;
    }
    skip(")");
    skip(":");
    skip(";");
    base_ = 1;
}

/// VAR_INPUT, POWER_UP [":"] or STEP Name [AT 5] ":".
void Shaper::skip_header() {
    const bool is_step = tokens_.is_keyword(at_, "STEP");
    ++at_;
    if (is_step) {
        while (!is_end(at_) && !tokens_.is_symbol(at_, ":") && !tokens_.is_symbol(at_, ";")) ++at_;
    }
    skip(":");
}

void Shaper::shape_block(std::string_view end_word) {
    const std::size_t opener = at_;
    const std::size_t end = find(at_, end_word);
    const bool declares = end_word == "END_VAR";
    skip_header();
    const std::size_t body = at_;
    for (std::size_t i = body; declares && i < end; ++i) {
        if (tokens_.is_symbol(i, ":")) tokens_[i].blanks = 1;
    }
    const bool one_line = is_single(body, end) && stays_on_one_line(opener, end, 0);
    at_ = opener;
    begin_line(0, one_line ? Role::plain : Role::opener);
    for (at_ = body; !one_line && at_ < end;) {
        if (declares && !tokens_.is_symbol(at_, ";")) {
            begin_line(1, Role::declaration);
            at_ = end_of_statement(at_);
        } else {
            shape_statement(1);
        }
    }
    at_ = end;
    if (!one_line) begin_line(0, Role::closer);
    at_ = past(end);
}

void Shaper::shape_statement(std::size_t level) {
    if (skip(";")) return;
    if (tokens_.is_keyword(at_, "IF")) return shape_choice(level);
    begin_line(level, Role::plain);
    at_ = end_of_statement(at_);
}

void Shaper::shape_choice(std::size_t level) {
    const std::size_t end = find(at_, "END_IF");
    if (!has_branches(at_, end) && stays_on_one_line(at_, end, level)) {
        begin_line(level, Role::plain);
    } else {
        shape_branches(level, end);
    }
    at_ = past(end);
}

void Shaper::shape_branches(std::size_t level, std::size_t end) {
    Role role = Role::opener;
    while (at_ < end) {
        begin_line(level, role);
        if (!tokens_.is_keyword(at_, "ELSE")) at_ = find(at_, "THEN");
        if (at_ < end) ++at_;
        while (at_ < end && !tokens_.is_keyword(at_, "ELSIF") && !tokens_.is_keyword(at_, "ELSE"))
            shape_statement(level + 1);
        role = Role::middle;
    }
    at_ = end;
    begin_line(level, Role::closer);
}

}  // namespace

void shape(Document& document) {
    Shaper(document).run();
}

}  // namespace nplc::seqc::layout
