#include "macreg/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/bytes.h"
#include "macreg/values.h"
#include "mactalk_client/master.h"
#include "registers/convert.h"
#include "registers/details.h"
#include "registers/layout.h"
#include "registers/scale.h"
#include "text/text.h"

namespace nplc::macreg {

using mactalk_client::LineError;
using registers::Model;
using registers::Register;
using spelling::trimmed;
using Phase = RecordProgress::Phase;

namespace {

// Longer ones first.
constexpr Relation kRelations[] = {
    {"<=", [](std::int64_t a, std::int64_t b) { return a <= b; }},
    {">=", [](std::int64_t a, std::int64_t b) { return a >= b; }},
    {"==", [](std::int64_t a, std::int64_t b) { return a == b; }},
    {"!=", [](std::int64_t a, std::int64_t b) { return a != b; }},
    {"<", [](std::int64_t a, std::int64_t b) { return a < b; }},
    {">", [](std::int64_t a, std::int64_t b) { return a > b; }},
    {"=", [](std::int64_t a, std::int64_t b) { return a == b; }, "=="},
    {"&", [](std::int64_t a, std::int64_t b) { return (a & b) != 0; }},
};

constexpr std::size_t kSlots = 4;
constexpr unsigned kMostPasses = 20;
constexpr unsigned kMostLosses = 12;  // in a row
constexpr base::Microseconds kSilence{2'000'000};

using Sample = std::array<std::uint32_t, kSlots>;

void wait_for(Motor& motor, const RecordOptions& options) {
    if (!options.when) return;
    const base::Instant begin = motor.now();
    while (!options.when->holds(motor.read(*options.when->reg))) {
        options.progress({Phase::waiting, 0, 0});
        if (options.within.count() > 0 && motor.now() - begin > options.within)
            throw CannotRecord(fmt::format("{} did not come true within {:g} s; nothing was recorded",
                                           condition_words(*options.when, motor.model()),
                                           static_cast<double>(options.within.count()) / 1e6));
    }
}

std::string start_words(const Motor& motor, const RecordOptions& options) {
    return options.when ? "when " + condition_words(*options.when, motor.model()) : std::string("now");
}

Recording empty_recording(const Motor& motor, const RecordOptions& options) {
    Recording recording;
    const bool large = motor.model() == Model::mac800;
    recording.model = !options.model_name.empty() ? options.model_name
                      : large                     ? registers::name_of(motor.model())
                                                  : "MAC50-141";
    recording.address = motor.address();
    recording.start = start_words(motor, options);
    for (const Register* reg : options.registers) recording.columns.push_back(column_of(*reg));
    return recording;
}

class BufferRecorder {
  public:
    /// With its registers planned, or those that the motor is set to found.
    enum class What : std::uint8_t { record, fetch };

    BufferRecorder(Motor& motor, const RecordOptions& options, What what)
        : motor_(motor),
          options_(options),
          fast_(options.fast),
          record_(mask("RECORDBIT")),
          rewind_(mask("REWINDBIT")),
          inner_(mask("RECINNERBIT")),
          momentary_(record_ | rewind_ | mask(motor.model() == Model::mac800 ? "SYNCPOSMAN" : "MAN_RESYNC")) {
        if (what == What::record) plan();
    }

    Recording fetch(Recording* broken) {
        refuse_gateway();
        const std::int64_t bits = control();
        if ((bits & record_) != 0)
            throw CannotRecord(
                "the motor is recording; wait until it is done, or stop it (`macreg set MODE_REG "
                "INIT_MODE`)");
        fast_ = (bits & inner_) != 0;
        find_parts();
        const std::int64_t there =
            options_.samples != 0 ? static_cast<std::int64_t>(options_.samples) : counted();
        if (there < 1 || there > static_cast<std::int64_t>(kMostSamples))
            throw CannotRecord(
                "the motor has recorded nothing (REC_CNT is 0); or name how many with --samples");
        try {
            return read(static_cast<std::size_t>(there));
        } catch (...) {
            if (broken != nullptr) *broken = put_together(got_);
            throw;
        }
    }

    Recording run(Recording* broken) {
        refuse_gateway();
        save();
        try {
            arrange();
            wait_for(motor_, options_);
            change_bits(record_ | wanted_inner(), inner_);
            if (options_.then) options_.then();
            const std::size_t count = wait_until_recorded();
            change_bits(0, 0);
            Recording recording = read(count);
            restore();
            return recording;
        } catch (...) {
            if (broken != nullptr) *broken = put_together(got_);
            try {
                change_bits(0, 0);
                restore();
            } catch (const LineError&) {
                // The line has failed; the first error is the one reported.
            }
            throw;
        }
    }

  private:
    std::int64_t mask(std::string_view name) const {
        const auto* field = registers::field_of(motor_.model(), registers::CNTRL_BITS, name);
        return field != nullptr ? static_cast<std::int64_t>(registers::mask_of(*field)) : 0;
    }
    std::int64_t wanted_inner() const { return options_.fast ? inner_ : 0; }

    /// Words of a register that a sample has; null: the map has no such number.
    struct Part {
        const Register* reg;
        std::uint8_t number;
        unsigned words;
        std::size_t slot;  ///< of its first word
    };

    void refuse_gateway() {
        if (motor_.is_behind_gateway())
            throw CannotRecord(
                "the motor is behind a gateway, whose line to it carries no sample buffer; use macreg record "
                "--poll");
    }

    bool is_whole(const Part& part) const {
        return part.reg != nullptr && part.words == registers::cells_of(motor_.model(), *part.reg).count;
    }

    /// Two consecutive numbers of one register give its value.
    void find_parts() {
        std::array<std::uint8_t, kSlots> numbers{};
        for (std::size_t i = 0; i < kSlots; ++i)
            numbers[i] = static_cast<std::uint8_t>(motor_.read(fmt::format("SAMPLE{}", i + 1)));
        for (std::size_t i = 0; i < kSlots;) {
            const Register* reg = motor_.find(numbers[i]);
            const unsigned cells = reg != nullptr ? registers::cells_of(motor_.model(), *reg).count : 1;
            if (numbers[i] == 0) {  // nothing
                ++i;
                continue;
            }
            const bool both = cells == 2 && i + 1 < kSlots && numbers[i + 1] == numbers[i] + 1;
            parts_.push_back({reg, numbers[i], both ? 2U : 1U, i});
            i += both ? 2 : 1;
        }
    }

    Recording::Column column_for(const Part& part) const {
        if (is_whole(part)) return column_of(*part.reg);
        const char* const half = part.reg != nullptr ? " low word" : "";
        return {.name = part.reg != nullptr ? std::string(part.reg->name) + half
                                            : fmt::format("register {}", part.number),
                .unit = {},
                .values = {}};
    }

    void plan() {
        std::string words;
        for (const Register* reg : options_.registers) {
            // R: a sampled number yields the word at that position (001 §3.2).
            const unsigned count = registers::cells_of(motor_.model(), *reg).count;
            parts_.push_back({reg, reg->number, count, slots_.size()});
            for (unsigned i = 0; i < count; ++i) slots_.push_back(static_cast<std::uint8_t>(reg->number + i));
            words += fmt::format("{}{} takes {}", words.empty() ? "" : ", ", reg->name, count);
        }
        if (slots_.empty()) throw NotRecordable("name a register to record");
        if (slots_.size() > kSlots)
            throw NotRecordable(fmt::format(
                "a sample has {} words, and these registers need {} ({}); name fewer, or use --poll", kSlots,
                slots_.size(), words));
        if (options_.samples < 1 || options_.samples > kMostSamples)
            throw NotRecordable(
                fmt::format("the buffer holds 1 to {} samples; use --poll for more", kMostSamples));
    }

    void save() {
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            samples_[i] = motor_.find(fmt::format("SAMPLE{}", i + 1));
            saved_[i] = motor_.read(*samples_[i]);
        }
        saved_inner_ = control() & inner_;
    }

    void restore() {
        for (std::size_t i = 0; i < slots_.size(); ++i) motor_.write(*samples_[i], saved_[i]);
        change_bits(saved_inner_, inner_);
    }

    void arrange() {
        change_bits(0, 0);
        for (std::size_t i = 0; i < slots_.size(); ++i) motor_.write(*samples_[i], slots_[i]);
        rewind();
    }

    std::int64_t control() { return motor_.read(registers::CNTRL_BITS); }
    std::int64_t counted() { return motor_.read("REC_CNT"); }

    /// Bits that the motor clears by itself are written as 0 unless they are to be set.
    void change_bits(std::int64_t set, std::int64_t clear) {
        const std::int64_t now = control();
        const std::int64_t wanted = (now & ~momentary_ & ~clear) | set;
        if (wanted != now) motor_.write(*motor_.find(registers::CNTRL_BITS), wanted);
    }

    void rewind() {
        change_bits(rewind_, 0);
        const base::Instant begin = motor_.now();
        while ((control() & rewind_) != 0) {
            options_.progress({Phase::waiting, 0, 0});
            if (motor_.now() - begin > kSilence)
                throw CannotRecord("the motor does not clear REWINDBIT: it does not rewind its buffer");
        }
    }

    /// The number of samples.
    std::size_t wait_until_recorded() {
        base::Instant moved = motor_.now();
        std::int64_t last = 0;
        for (;;) {
            const bool ended = (control() & record_) == 0;
            const std::int64_t count = counted();
            const auto whole = static_cast<std::size_t>(std::clamp<std::int64_t>(count, 0, kMostSamples));
            options_.progress({Phase::recording, std::min(whole, options_.samples), options_.samples});
            if (whole >= options_.samples || (ended && whole > 0)) return std::min(whole, options_.samples);
            if (count != last) moved = motor_.now();
            last = count;
            if (motor_.now() - moved > kSilence)
                throw CannotRecord(fmt::format("the motor records nothing: REC_CNT stays at {}", count));
        }
    }

    Recording read(std::size_t count) {
        std::vector<std::optional<Sample>> samples(count);
        const auto is_missing = [](const auto& sample) { return !sample.has_value(); };
        for (unsigned pass = 0;; ++pass) {
            const auto last = std::find_if(samples.rbegin(), samples.rend(), is_missing);
            if (last == samples.rend()) break;
            if (pass == kMostPasses)
                throw CannotRecord(fmt::format(
                    "{} of {} samples were still missing after reading the buffer {} times; look at the line",
                    std::count_if(samples.begin(), samples.end(), is_missing), count, kMostPasses));
            read_pass(samples, static_cast<std::size_t>(samples.rend() - last));
        }
        return put_together(samples);
    }

    /// From the start of the buffer to sample number `end`. The motor counts the samples it sent: after a
    /// missing answer REC_CNT shows whether the answer was lost or the request.
    void read_pass(std::vector<std::optional<Sample>>& samples, std::size_t end) {
        rewind();
        got_ = samples;
        auto& got = got_;  // a member, to survive an exception that ends the pass
        unsigned losses = 0;
        for (std::size_t i = 0; i < end;) {
            options_.progress({Phase::reading,
                               static_cast<std::size_t>(std::count_if(got.begin(), got.end(),
                                                                      [](auto& s) { return s.has_value(); })),
                               got.size()});
            try {
                got[i] = ask();
                ++i;
                losses = 0;
            } catch (const LineError& error) {
                if (error.kind() != LineError::Kind::no_answer || ++losses == kMostLosses) throw;
                const std::int64_t next = counted();
                if (next < static_cast<std::int64_t>(i) || next > static_cast<std::int64_t>(i) + 1) {
                    got_ = samples;
                    return;
                }
                i = static_cast<std::size_t>(next);
            }
        }
        if (counted() == static_cast<std::int64_t>(end))
            samples = got_;
        else
            got_ = samples;
    }

    Sample ask() {
        const std::size_t width = motor_.model() == Model::mac800 ? 4 : 2;
        const auto bytes = motor_.master().read_sample(motor_.address(), kSlots * width);
        Sample sample{};
        for (std::size_t i = 0; i < kSlots; ++i)
            sample[i] = width == 4 ? base::load_u32(&bytes[4 * i]) : base::load_u16(&bytes[2 * i]);
        return sample;
    }

    Recording put_together(const std::vector<std::optional<Sample>>& samples) const {
        Recording recording = empty_recording(motor_, options_);
        recording.columns.clear();
        for (const Part& part : parts_) recording.columns.push_back(column_for(part));
        recording.rate_hz = rate();
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (!samples[i]) continue;  // missing, in a recording that ended early
            recording.time_s.push_back(static_cast<double>(i) / recording.rate_hz);
            for (std::size_t c = 0; c < parts_.size(); ++c) {
                const std::size_t slot = parts_[c].slot;
                std::uint32_t bits = (*samples[i])[slot];
                if (parts_[c].words == 2) bits |= (*samples[i])[slot + 1] << 16;
                recording.columns[c].values.push_back(value_of(parts_[c], bits));
            }
        }
        return recording;
    }

    double value_of(const Part& part, std::uint32_t bits) const {
        if (!is_whole(part)) return bits;
        const auto format = registers::format_on_line(motor_.model(), *part.reg);
        return shown_value(*part.reg, motor_.model(), registers::value_of(format, bits));
    }

    /// 001 §3.2.36: the current loop's rate is 15 times the position loop's.
    double rate() const {
        constexpr double kInnerSamples = 15;
        const registers::Ratio outer = registers::exact_scale_of(motor_.model()).samples_per_second;
        const double rate = static_cast<double>(outer.numerator) / static_cast<double>(outer.denominator);
        return fast_ ? kInnerSamples * rate : rate;
    }

    Motor& motor_;
    const RecordOptions& options_;
    bool fast_;
    std::int64_t record_;
    std::int64_t rewind_;
    std::int64_t inner_;
    std::int64_t momentary_;
    std::vector<Part> parts_;
    std::vector<std::uint8_t> slots_;
    std::array<const Register*, kSlots> samples_{};
    std::array<std::int64_t, kSlots> saved_{};
    std::int64_t saved_inner_ = 0;
    std::vector<std::optional<Sample>> got_;  ///< of the present pass
};

}  // namespace

ConditionReading read_condition(std::string_view text, registers::Model model) {
    const std::size_t at = std::min(text.find_first_of("<>=!&"), text.size());
    const auto* relation =
        std::find_if(std::begin(kRelations), std::end(kRelations),
                     [&](const Relation& one) { return text.substr(at).starts_with(one.sign); });
    if (relation == std::end(kRelations))
        return {.error = fmt::format("'{}' is no condition; write a register, one of < <= == != >= > & and a "
                                     "value, such as 'V_IST>100 rpm'",
                                     text)};
    const NamedRegister named = find_register(model, trimmed(text.substr(0, at)));
    if (named.reg == nullptr) return {.error = fmt::format("'{}': {}", text, named.error)};
    const TypedValue value = typed_value(*named.reg, model, trimmed(text.substr(at + relation->sign.size())));
    if (!value.error.empty()) return {.error = fmt::format("'{}': {}", text, value.error)};
    return {.condition = {named.reg, relation, value.raw}};
}

std::string condition_words(const Comparison& condition, registers::Model model) {
    const Relation& relation = *condition.relation;
    return fmt::format("{} {} {}", condition.reg->name, relation.told.empty() ? relation.sign : relation.told,
                       value_text(*condition.reg, model, condition.raw));
}

Recording record_buffer(Motor& motor, const RecordOptions& options, Recording* broken) {
    return BufferRecorder(motor, options, BufferRecorder::What::record).run(broken);
}

Recording fetch_buffer(Motor& motor, const RecordOptions& options, Recording* broken) {
    return BufferRecorder(motor, options, BufferRecorder::What::fetch).fetch(broken);
}

void record_polling(Motor& motor, const RecordOptions& options, Recording& into) {
    if (options.registers.empty()) throw NotRecordable("name a register to record");
    into = empty_recording(motor, options);
    wait_for(motor, options);
    if (options.then) options.then();
    const base::Instant begin = motor.now();
    const auto goes_on = [&] {
        return (options.samples == 0 || into.size() < options.samples) &&
               (options.lasts.count() == 0 || motor.now() - begin < options.lasts);
    };
    while (goes_on()) {
        options.progress({Phase::recording, into.size(), options.samples});
        const base::Instant before = motor.now();
        const Snapshot row = motor.read_block(options.registers);
        const base::Microseconds middle = (before - begin) + (motor.now() - before) / 2;
        for (std::size_t c = 0; c < options.registers.size(); ++c) {
            const Register& reg = *options.registers[c];
            into.columns[c].values.push_back(shown_value(reg, motor.model(), row.at(reg.number)));
        }
        into.time_s.push_back(static_cast<double>(middle.count()) / 1e6);
    }
}

}  // namespace nplc::macreg
