#pragma once

#include <optional>
#include <vector>

#include "compiler/model.h"
#include "compiler/scope.h"
#include "language/ast.h"
#include "symbols/commands.h"

namespace nplc::seqc {

/// Determines the action of a branch's statements.
class ActionBuilder {
  public:
    explicit ActionBuilder(Scope& scope) : scope_(scope) {}

    Action build(const std::vector<ast::Statement>& statements);

    /// The first statement that would act in every scan and is not marked EVERY_SCAN.
    std::optional<Span> unmarked() const { return unmarked_; }
    std::optional<Span> marked() const { return marked_; }

  private:
    void add_by_kind(const ast::Statement& statement);
    void add(const ast::Statement& statement);
    void add_next(const ast::Statement& statement);
    void add_assignment(const ast::Statement& statement, const registers::Register* reg,
                        std::string_view shown);
    void add_command(const ast::Statement& statement);
    bool refuse_constant(const ast::Name& name, table::Mode mode);
    void add_selections(const ast::Statement& statement, table::Mode mode);
    void add_use_set(const ast::Statement& statement);
    void add_timer(const ast::Statement& statement);
    void add_switch(const ast::Statement& statement);
    void add_counter(const ast::Statement& statement);
    void add_counter_of_set_point(const ast::Statement& statement);
    std::optional<std::uint16_t> preset_of(const ast::Statement& statement, set_points::ValueKind kind,
                                           std::uint8_t& number);
    void add_send(const ast::Statement& statement, std::uint8_t command);
    void add_send(const Send& send);
    bool once(bool already, const ast::Statement& statement, const char* what, Span& place);

    Scope& scope_;
    Action action_;
    std::optional<Span> unmarked_;
    std::optional<Span> marked_;
};

/// Where a time stands: what 0 means there differs.
enum class TimeFor : std::uint8_t { preset, limit, lasting, blinking };

/// The timer value; reports a value that the timer cannot hold.
std::optional<std::uint16_t> milliseconds_of(const ast::Value& value, Report& report,
                                             TimeFor use = TimeFor::preset);
/// The same for a value that must be evaluated.
std::optional<std::uint16_t> timer_value(const ast::Value& value, Scope& scope,
                                         TimeFor use = TimeFor::preset);

/// Warns about an output that is named twice in a list.
void warn_named_twice(const std::vector<ast::Name>& outputs, Scope& scope);

/// Merges the SETs and RESETs of `more` into `action`; reports an output that both switch differently.
void add_switches(Action& action, const Action& more, const char* note, Report& report);

/// Appends the entered step's ENTRY to a branch; reports effects that cannot be combined in one scan.
void append_entry(Action& action, const Action& entry, Report& report);

}  // namespace nplc::seqc
