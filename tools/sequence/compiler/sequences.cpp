#include "compiler/sequences.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "compiler/substitution.h"
#include "language/names.h"

namespace nplc::seqc {
namespace {

using ast::Statement;

class Expansion {
  public:
    Expansion(ast::Program& program, Report& report) : program_(program), report_(report) {}

    void run() {
        refuse_same_names();
        callers_.resize(program_.steps.size());
        for (const ast::Step& step : program_.steps) taken_.insert(upper(step.name.text));
        if (program_.power_up) expand_step(*program_.power_up, {}, false);
        // Steps added by a call are processed too. The limit is that of the table, with a margin for the
        // error message.
        constexpr std::size_t kMost = 256;
        for (std::size_t i = 0; i < program_.steps.size() && i < kMost; ++i) {
            ast::Step step = std::move(program_.steps[i]);
            const std::vector<std::string> callers = callers_[i];
            expand_step(step, callers, !callers.empty());
            program_.steps[i] = std::move(step);
        }
        add_groups();
    }

  private:
    void refuse_same_names() {
        for (std::size_t i = 0; i < program_.sequences.size(); ++i) {
            const ast::Name& name = program_.sequences[i].name;
            const auto [first, is_new] = places_.try_emplace(upper(name.text), i);
            if (is_new) continue;
            report_
                .add("E020", name.span, fmt::format("sequence '{}' stands twice", name.text),
                     "give one of them another name")
                .notes.push_back({program_.sequences[first->second].name.span, "the first one is here"});
        }
    }

    const ast::Sequence* find(const ast::Name& name) const {
        const auto found = places_.find(upper(name.text));
        return found == places_.end() ? nullptr : &program_.sequences[found->second];
    }

    /// `inside`: the step belongs to a sequence, whose RETURNs are already replaced.
    void expand_step(ast::Step& step, const std::vector<std::string>& callers, bool inside) {
        for (const Statement& statement : step.entry) {
            if (statement.kind == Statement::Kind::call || statement.kind == Statement::Kind::go_back)
                refuse(statement.span, "ENTRY cannot hold CALL or RETURN", "put it into a branch");
        }
        std::erase_if(step.entry, [](const Statement& statement) {
            return statement.kind == Statement::Kind::call || statement.kind == Statement::Kind::go_back;
        });
        for (ast::Choice& choice : step.choices) {
            for (ast::Branch& branch : choice.branches) expand_branch(branch, callers, inside);
        }
    }

    void expand_branch(ast::Branch& branch, const std::vector<std::string>& callers, bool inside) {
        const auto is = [](Statement::Kind kind) {
            return [kind](const Statement& statement) { return statement.kind == kind; };
        };
        auto& list = branch.statements;
        for (const Statement& statement : list) {
            if (!inside && statement.kind == Statement::Kind::go_back)
                refuse(statement.span, "RETURN stands in the steps of a SEQUENCE only",
                       "name the step: NEXT := Step;");
        }
        std::erase_if(list, is(Statement::Kind::go_back));
        const auto call = std::find_if(list.begin(), list.end(), is(Statement::Kind::call));
        if (call == list.end()) return;
        const auto next = std::find_if(list.begin(), list.end(), is(Statement::Kind::next));
        const Statement called = *call;
        if (next == list.end()) {
            refuse(called.span, "CALL does not say where it goes on when the sequence is done",
                   fmt::format("write CALL {}(..); NEXT := Step;", called.name.text));
        } else if (const auto first = instance(called, next->name, callers)) {
            next->name = {first->text, called.span};
        }
        list.erase(std::find_if(list.begin(), list.end(), is(Statement::Kind::call)));
        for (const Statement& other : list) {
            if (other.kind == Statement::Kind::call)
                refuse(other.span, "a branch calls one SEQUENCE",
                       "call the other one where this one goes on");
        }
        std::erase_if(list, is(Statement::Kind::call));
    }

    void refuse(Span span, std::string message, std::string help) {
        report_.add("E067", span, std::move(message), std::move(help));
    }

    std::optional<ast::Name> instance(const Statement& call, const ast::Name& back,
                                      const std::vector<std::string>& callers) {
        const ast::Sequence* sequence = find(call.name);
        if (sequence == nullptr) {
            report_.add("E021", call.name.span, fmt::format("there is no SEQUENCE '{}'", call.name.text),
                        help_for(call.name.text));
            return std::nullopt;
        }
        if (sequence->is_broken || !fits(*sequence, call) || sequence->steps.empty()) return std::nullopt;
        const std::string own = upper(sequence->name.text);
        if (std::find(callers.begin(), callers.end(), own) != callers.end()) {
            refuse(call.span,
                   fmt::format("'{}' would be called from within itself, without end", sequence->name.text),
                   "let it go back to its first step with NEXT instead");
            return std::nullopt;
        }
        std::string key = own + "\n" + upper(back.text);
        for (const ast::Argument& argument : call.call) key += "\n" + upper(argument.text);
        const auto known = instances_.find(key);
        if (known != instances_.end()) {
            for (std::size_t i = 0; i < sequence->steps.size(); ++i)
                program_.steps[known->second + i].origin->calls.push_back(call.span);
            return program_.steps[known->second].name;
        }
        std::vector<std::string> now = callers;
        now.push_back(own);
        const std::size_t first = program_.steps.size();
        instances_[key] = first;
        add_steps(*sequence, call, back, now);
        return program_.steps[first].name;
    }

    std::string help_for(std::string_view name) const {
        if (report_.full_of_errors()) return {};  // not shown
        constexpr std::size_t kMostShown = 12;
        std::vector<std::string_view> names;
        for (const ast::Sequence& known : program_.sequences) names.push_back(known.name.text);
        std::string help = suggestion(name, names);
        if (!help.empty()) return help;
        if (names.empty()) return fmt::format("write SEQUENCE {}() .. END_SEQUENCE above the steps", name);
        const bool is_all = names.size() <= kMostShown;
        if (!is_all) names.resize(kMostShown);
        return fmt::format("there are: {}{}", fmt::join(names, ", "), is_all ? "" : ", ...");
    }

    bool fits(const ast::Sequence& sequence, const Statement& call) {
        const std::size_t wanted = sequence.parameters.size();
        if (call.call.size() != wanted) {
            report_
                .add("E067", call.span,
                     fmt::format("'{}' takes {} argument{}, here are {}", sequence.name.text, wanted,
                                 wanted == 1 ? "" : "s", call.call.size()),
                     "give one for each parameter, in their order")
                .notes.push_back({sequence.name.span, "the sequence is here"});
            return false;
        }
        for (std::size_t i = 0; i < wanted; ++i) {
            const ast::Parameter& parameter = sequence.parameters[i];
            if (!call.call[i].value || parameter.kind == ast::Parameter::Kind::constant) continue;
            report_
                .add("E067", call.call[i].span,
                     fmt::format("'{}' takes a name here, no value", sequence.name.text),
                     "CONST in front of a parameter makes it a value")
                .notes.push_back({parameter.name.span, "the parameter is here"});
            return false;
        }
        return true;
    }

    void add_steps(const ast::Sequence& sequence, const Statement& call, const ast::Name& back,
                   const std::vector<std::string>& callers) {
        Substitution substitution(sequence.parameters, call.call, program_.texts);
        std::vector<ast::Name> names;
        for (const ast::Step& step : sequence.steps) {
            const std::string family = fmt::format("{}_{}", sequence.name.text, step.name.text);
            const std::string& name = program_.texts.emplace_back(free_name(family));
            names.push_back({name, step.name.span});
            substitution.rename(step.name.text, name);
        }
        substitution.go_back_to(back);
        for (std::size_t i = 0; i < sequence.steps.size(); ++i) {
            ast::Step step = sequence.steps[i];
            if (step.number) {
                refuse(step.number->span,
                       "a step of a SEQUENCE has no number of its own: it is there for each call",
                       "leave AT out");
                step.number.reset();
            }
            if (!step.terms.empty()) {
                report_.add("E075", step.terms.front().span, "a TERM cannot stand in a SEQUENCE",
                            "write a branch instead of the TERM");
                step.terms.clear();
            }
            substitution.apply(step);
            step.name = names[i];
            ast::Origin& origin = step.origin.emplace();
            origin.sequence = sequence.name;
            origin.step = sequence.steps[i].name.text;
            origin.back = back;
            origin.calls.push_back(call.span);
            for (std::size_t k = 0; k < sequence.parameters.size(); ++k)
                origin.arguments.emplace_back(sequence.parameters[k].name.text, call.call[k].text);
            const auto [first, is_first] = families_.try_emplace(
                upper(fmt::format("{}.{}", sequence.name.text, sequence.steps[i].name.text)), names[i].text);
            if (!is_first) origin.first = first->second;
            taken_.insert(upper(step.name.text));
            program_.steps.push_back(std::move(step));
            callers_.push_back(callers);
        }
    }

    std::string free_name(const std::string& wanted) {
        const auto is_taken = [&](const std::string& name) { return taken_.contains(upper(name)); };
        if (!is_taken(wanted)) return wanted;
        int& n = last_numbers_.try_emplace(upper(wanted), 2).first->second;
        while (is_taken(fmt::format("{}_{}", wanted, n))) ++n;
        return fmt::format("{}_{}", wanted, n);
    }

    /// In front of the program's own, the last one first.
    void add_groups() {
        std::unordered_map<std::string, std::vector<ast::Name>> steps;
        for (const ast::Step& step : program_.steps) {
            if (step.origin) steps[upper(step.origin->sequence.text)].push_back(step.name);
        }
        std::vector<ast::Group> groups;
        for (const ast::Sequence& sequence : program_.sequences) {
            if (&sequence != find(sequence.name)) continue;
            ast::Group& group = groups.emplace_back();
            group.name = sequence.name;
            group.steps = std::move(steps[upper(sequence.name.text)]);
            if (!group.steps.empty() || program_.steps_missing || report_.has_errors()) continue;
            report_.add("W005", sequence.name.span, fmt::format("nothing calls '{}'", sequence.name.text),
                        fmt::format("write CALL {}(..); NEXT := Step; or delete it", sequence.name.text));
        }
        program_.groups.insert(program_.groups.begin(), std::make_move_iterator(groups.rbegin()),
                               std::make_move_iterator(groups.rend()));
    }

    ast::Program& program_;
    Report& report_;
    std::unordered_map<std::string, std::size_t> places_;  ///< of the sequences, by upper-case name
    std::unordered_set<std::string> taken_;                ///< names of steps, upper case
    std::unordered_map<std::string, int> last_numbers_;    ///< behind a name that is taken
    std::map<std::string, std::size_t> instances_;         ///< the first step of each
    std::map<std::string, std::string_view> families_;     ///< the first step of each name
    std::vector<std::vector<std::string>> callers_;        ///< of each step: the sequences that led to it
};

}  // namespace

void expand_sequences(ast::Program& program, Report& report) {
    const bool has_statements = !program.sequences.empty() || program.has_calls;
    if (has_statements) Expansion(program, report).run();
}

}  // namespace nplc::seqc
