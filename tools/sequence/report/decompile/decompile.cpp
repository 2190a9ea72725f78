#include "seqc/decompile.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/paths.h"
#include "report/decompile/draft.h"
#include "report/decompile/layout.h"
#include "report/decompile/naming.h"
#include "report/decompile/vocabulary.h"
#include "report/decompile/writer.h"
#include "seqc/format.h"
#include "sequencer/term.h"
#include "table/step.h"

namespace nplc::seqc {
namespace {

using registers::Model;

constexpr std::size_t kMostDrafts = 12;
constexpr std::string_view kNotForDrive = "E044";

/// Prevents a file name from ending the comment that contains it.
std::string printable(const std::string& name) {
    std::string text;
    for (char c : name) text += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    return text;
}

class Decompiler {
  public:
    Decompiler(std::span<const std::uint8_t> table, const DecompileOptions& options)
        : table_(table),
          options_(options),
          layout_(layout_of(table)),
          motor_(choose_motor()),
          drive_(choose_drive()),
          drafter_(layout_, motor_) {}

    /// With set-points, or without them if they could not be reproduced.
    Decompilation run() {
        keeps_set_points_ = has_set_points();
        if (keeps_set_points_) {
            Decompilation whole = run_once();
            if (compilation_.ok && kept_set_points()) return whole;
            keeps_set_points_ = false;
            drive_ = choose_drive();
        }
        Decompilation whole = run_once();
        if (has_set_points()) {
            for (const set_points::SetPoint& point : options_.symbols->set_points.values)
                whole.lost_set_points.push_back(point.name);
        }
        return whole;
    }

  private:
    bool has_set_points() const {
        return options_.symbols != nullptr && !options_.symbols->set_points.values.empty();
    }

    Decompilation run_once() {
        Exclusions exclusions;
        if (table_.size() / sequencer::kTermBytes > kTermsEverywhere) exclusions = only_terms();
        for (std::size_t i = 0; i < kMostDrafts; ++i) {
            if (attempt(exclusions)) return in_one_style();
            if (drops_drive()) continue;
            const Exclusions before = exclusions;
            learn(exclusions);
            if (exclusions == before) break;
        }
        exclusions = only_terms();
        exclusions.given_names = true;
        return attempt(exclusions) || (drops_drive() && attempt(exclusions)) ? in_one_style() : bytes_alone();
    }

    Model choose_motor() const {
        if (options_.motor) return *options_.motor;
        return options_.symbols != nullptr ? options_.symbols->motor : fitting_motor(layout_);
    }
    const registers::DriveModel* choose_drive() const {
        if (options_.motor) return options_.drive;
        return options_.symbols != nullptr ? options_.symbols->drive : nullptr;
    }
    bool kept_set_points() const { return compilation_.symbols.set_points == options_.symbols->set_points; }
    bool motor_is_sure() const { return options_.motor || options_.symbols != nullptr; }

    static Exclusions only_terms(Exclusions exclusions = {}) {
        exclusions.shape.set();
        exclusions.on_error = true;
        exclusions.power_up = true;
        exclusions.entry.set();
        return exclusions;
    }

    bool attempt(const Exclusions& exclusions) {
        draft_ = drafter_.draft(exclusions);
        Naming naming = naming_of(exclusions.given_names ? nullptr : options_.symbols, stem(), motor_);
        naming.symbols.drive = drive_;
        naming.exact_places = exact_places_;
        if (keeps_set_points_) {
            naming.symbols.set_points = options_.symbols->set_points;
            naming.set_points = naming.symbols.set_points.values;
        }
        const WriterContext context{naming, motor_, motor_is_sure(), draft_.power_up.has_value()};
        count();
        manuscript_ = write_program(layout_, draft_, context, head(naming));
        compilation_ = compile(manuscript_.text);
        result_.text = manuscript_.text;
        if (!compilation_.ok ||
            !std::equal(compilation_.table.begin(), compilation_.table.end(), table_.begin(), table_.end()))
            return false;
        if (exact_places_ || !adds_up_rounding()) return true;
        exact_places_ = true;
        return attempt(exclusions);
    }

    bool adds_up_rounding() const {
        const auto& all = compilation_.diagnostics;
        return std::any_of(all.begin(), all.end(), [](const Diagnostic& d) { return d.code == "W030"; });
    }

    /// The drive is dropped if the program with it would be refused for orders that the drive cannot do,
    /// although the table has them.
    bool drops_drive() {
        if (drive_ == nullptr) return false;
        const auto& all = compilation_.diagnostics;
        const auto found = std::find_if(all.begin(), all.end(), [](const Diagnostic& d) {
            return d.severity == Severity::error && d.code == kNotForDrive;
        });
        if (found == all.end()) return false;
        why_no_drive_ = found->message;
        drive_ = nullptr;
        return true;
    }

    Decompilation in_one_style() {
        Formatted formatted = format_program(result_.text);
        if (formatted.ok) result_.text = std::move(formatted.text);
        return result_;
    }

    /// Parts that the compiler refused or translated to other bytes are written in a simpler form next time.
    void learn(Exclusions& exclusions) const {
        if (compilation_.ok) return learn_from_bytes(exclusions);
        for (const Diagnostic& d : compilation_.diagnostics) {
            if (d.severity == Severity::error) ban(passage_at(d.span.offset), exclusions);
        }
    }

    const Passage& passage_at(std::size_t offset) const {
        const auto found = std::find_if(manuscript_.passages.begin(), manuscript_.passages.end(),
                                        [&](const Passage& p) { return offset < p.end; });
        return found == manuscript_.passages.end() ? manuscript_.passages.back() : *found;
    }

    void ban(const Passage& passage, Exclusions& exclusions) const {
        switch (passage.kind) {
            case Passage::Kind::names:
                exclusions.given_names = true;
                return;
            case Passage::Kind::values:
            case Passage::Kind::power_up:
                exclusions.power_up = true;
                return;
            case Passage::Kind::on_error:
                exclusions.on_error = true;
                return;
            case Passage::Kind::entry:
                exclusions.entry.set(passage.step);
                if (draft_.around.fault && draft_.around.fault->next == passage.step)
                    exclusions.on_error = true;
                return;
            case Passage::Kind::step:
                exclusions.shape.set(passage.step);
                return;
            case Passage::Kind::rest:
                exclusions = only_terms(exclusions);
                return;
        }
    }

    void learn_from_bytes(Exclusions& exclusions) const {
        const auto different =
            std::mismatch(compilation_.table.begin(), compilation_.table.end(), table_.begin(), table_.end());
        const auto at = static_cast<std::size_t>(different.second - table_.begin());
        const std::size_t term =
            std::min(at, table_.size() - 1) / sequencer::kTermBytes * sequencer::kTermBytes;
        const std::uint8_t step =
            sequencer::step_of(std::span(table_).subspan(term).first<sequencer::kTermBytes>());
        if (step == 0) exclusions.power_up = true;
        if (step == 0 && !draft_.power_up) exclusions.shape.set(0);
        if (step != 0) exclusions.shape.set(step);
    }

    Decompilation bytes_alone() {
        const Disassembly plain = disassemble(table_, stem());
        result_ = {};
        result_.text = plain.text;
        result_.error = plain.error;
        result_.byte_terms = table_.size() / sequencer::kTermBytes - 1;
        return result_;
    }

    std::string stem() const { return host::name_of(host::path_of(options_.origin).stem()); }

    void count() {
        result_ = {};
        const auto add = [&](const Terms& terms, std::size_t first) {
            for (std::size_t i = first; i < terms.size(); ++i)
                ++(obstacle(terms[i], motor_).empty() ? result_.symbolic_terms : result_.byte_terms);
        };
        for (std::size_t i = 0; i < layout_.steps.size(); ++i) {
            const Part& part = layout_.steps[i];
            const bool whole = (i == 0 && draft_.power_up) || part.terms.empty();
            const std::size_t shaped = whole              ? part.terms.size()
                                       : draft_.shapes[i] ? draft_.shapes[i]->terms
                                                          : 0;
            add(part.terms, shaped);
            if (part.terms.empty()) continue;
            ++(shaped == part.terms.size() ? result_.structured_steps
               : shaped != 0               ? result_.mixed_steps
                                           : result_.term_steps);
        }
        add(layout_.outside, 0);
    }

    /// The declarations as a comment, for the reader to put in.
    std::string lost_set_points(const Naming& naming) const {
        const WriterContext context{naming, motor_, motor_is_sure(), draft_.power_up.has_value()};
        std::string text =
            "// Its set-points are not in this program, since values of the table cannot be told from their "
            "defaults:\n// the defaults stand as constants. The set-points were:\n";
        for (const set_points::SetPoint& point : options_.symbols->set_points.values)
            text += fmt::format("//     {}\n", declaration_of(point, context));
        return text;
    }

    std::string head(const Naming& naming) const {
        const Decompilation& r = result_;
        std::string text = fmt::format("// Decompiled from {}: {} terms and the end of the table.\n",
                                       options_.origin.empty() ? "a table" : printable(options_.origin),
                                       table_.size() / sequencer::kTermBytes - 1);
        text += fmt::format("// Steps: {} as branches, {} as branches and TERMs, {} as TERMs.",
                            r.structured_steps, r.mixed_steps, r.term_steps);
        text += fmt::format(" TERMs: {} in symbols, {} as bytes.\n", r.symbolic_terms, r.byte_terms);
        text += "// It compiles to the same bytes.";
        if (naming.made_up)
            text += " A table holds no names: those of steps, inputs and outputs are made up.";
        text += "\n";
        if (!motor_is_sure()) {
            text += fmt::format("// A table does not say for which motor it is: {} is assumed.\n",
                                registers::name_of(motor_));
        }
        if (!why_no_drive_.empty())
            text += fmt::format("// It is written for a {}, because {}.\n", registers::name_of(motor_),
                                printable(why_no_drive_));
        if (has_set_points() && !keeps_set_points_) text += lost_set_points(naming);
        if (r.symbolic_terms + r.byte_terms > 0)
            text +=
                "// A TERM is one term of the table: all that hold act in their order, and the last "
                "decides.\n";
        return text;
    }

    std::span<const std::uint8_t> table_;
    const DecompileOptions& options_;
    Layout layout_;
    Model motor_;
    const registers::DriveModel* drive_ = nullptr;
    std::string why_no_drive_;
    bool keeps_set_points_ = false;
    bool exact_places_ = false;
    Drafter drafter_;
    Draft draft_;
    WrittenProgram manuscript_;
    Compilation compilation_;
    Decompilation result_;
};

}  // namespace

Decompilation decompile(std::span<const std::uint8_t> table, const DecompileOptions& options) {
    const std::size_t length = table::length_of(table);
    if (length == 0) {
        Decompilation result;
        result.error = disassemble(table, options.origin).error;
        return result;
    }
    Decompilation result = Decompiler(table.first(length), options).run();
    result.trailing_bytes = table.size() - length;
    return result;
}

}  // namespace nplc::seqc
