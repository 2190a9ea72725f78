#include <fmt/format.h>

#include "cli/session.h"
#include "host/paths.h"
#include "macreg/change.h"
#include "macreg/plot.h"
#include "macreg/recorder.h"
#include "macreg/service.h"
#include "macreg/values.h"
#include "whole_files/whole_files.h"

namespace nplc::macreg::cli {

using registers::Register;

namespace {

struct RecordArguments {
    std::vector<std::string> registers;
    std::string output = "-";
    std::string rate = "slow";
    std::string when;
    std::string move;
    double within = 0;
    double lasts = 0;
    std::size_t samples = 0;
    bool poll = false;
    bool force = false;
};

/// What --move writes: a position or speed, or how far from the one that is set.
struct Move {
    enum class State : std::uint8_t { not_yet, refused, sent, done };

    const Register* reg = nullptr;
    std::int64_t raw = 0;
    State state = State::not_yet;

    /// What became of the move, appended to the error.
    std::string words(registers::Model model) const {
        if (reg == nullptr) return {};
        const std::string what = fmt::format("{} = {}", reg->name, value_text(*reg, model, raw));
        switch (state) {
            case State::not_yet:
                return fmt::format("; {} was not written, the motor was not moved", what);
            case State::refused:
                return "; the motor was not moved";
            case State::sent:
                return fmt::format("; {} may have been written: THE MOTOR MAY MOVE", what);
            case State::done:
                break;
        }
        return fmt::format(
            "; {} had been written: THE MOTOR MAY STILL MOVE (`macreg set MODE_REG INIT_MODE` stops it)",
            what);
    }
};

Move read_move(Session& session, const std::string& text) {
    const std::size_t sign = text.find('=');
    const bool relative = sign != std::string::npos && sign + 1 < text.size() && text[sign + 1] == '+';
    if (sign == std::string::npos)
        throw UserError(
            fmt::format("--move {}: write REGISTER=VALUE, or REGISTER=+VALUE for so much more", text));
    Motor& motor = session.motor();
    const registers::Model model = motor.model();
    const Register* reg = find_registers(model, {text.substr(0, sign)}).front();
    if (reg->number != registers::P_SOLL && reg->number != registers::V_SOLL)
        throw UserError(fmt::format("--move {}: moves are made by P_SOLL or V_SOLL", text));
    const TypedValue typed = typed_value(*reg, model, text.substr(sign + (relative ? 2 : 1)));
    if (!typed.error.empty()) throw UserError("--move: " + typed.error);
    const std::int64_t raw = typed.raw + (relative ? motor.read(*reg) : 0);
    if (raw < reg->min || raw > reg->max)
        throw UserError(fmt::format("--move {}: {} would be {}, out of its range {}", text, reg->name, raw,
                                    range_text(*reg, model)));
    const std::int64_t mode = motor.read(registers::MODE_REG);
    constexpr std::int64_t kVelocity = 1;
    constexpr std::int64_t kPosition = 2;
    std::string note;
    if (mode == 0 || mode == 15 || (mode == kVelocity && reg->number == registers::P_SOLL))
        note = fmt::format("it is in {}, in which {} moves nothing", mode_text(model, mode), reg->name);
    if (mode == kPosition && reg->number == registers::V_SOLL)
        note = "it is in P_MODE, in which V_SOLL is only the limit on the way to P_SOLL";
    if (session.common().yes && !note.empty()) session.remark("the motor: " + note);
    session.ask(fmt::format("{} becomes {} while it records: the motor may move{}", reg->name,
                            long_value_text(*reg, model, raw), note.empty() ? "" : " (" + note + ")"));
    return {reg, raw};
}

/// Also used through a gateway, which may refuse it without an answer.
void carry_out(Motor& motor, Move& move) {
    move.state = Move::State::sent;
    try {
        motor.write(*move.reg, move.raw);
    } catch (const mactalk_client::LineError& error) {
        if (error.kind() != mactalk_client::LineError::Kind::no_answer) throw;
        const std::string refusal = gateway_refusal(motor, Asked::write);
        if (refusal.empty()) throw;
        move.state = Move::State::refused;
        refuse(fmt::format("{} was not written: {}", move.reg->name, refusal));
    }
    move.state = Move::State::done;
}

std::string phase_words(const RecordProgress& progress) {
    const std::string of = progress.of > 0 ? fmt::format("{} of {}", progress.done, progress.of)
                                           : fmt::format("{}", progress.done);
    switch (progress.phase) {
        case RecordProgress::Phase::waiting:
            return "waiting";
        case RecordProgress::Phase::recording:
            return fmt::format("recorded {} samples", of);
        case RecordProgress::Phase::reading:
            return fmt::format("read {} samples", of);
    }
    return {};
}

void write_file(const std::string& path, const std::string& content) {
    if (const std::string problem = whole_files::write_files({{path, content}}); !problem.empty())
        throw UserError(problem);
}

void save(Session& session, const RecordArguments& options, const Recording& recording) {
    const std::string csv = to_csv(recording);
    const std::string file = output_file(options.output, true);
    if (file.empty()) {
        if (!session.json()) return fmt::print("{}", csv);
    } else {
        write_file(file, csv);
    }
    Json document{{"samples", recording.size()},
                  {"rate_hz", recording.rate_hz},
                  {"seconds", recording.size() > 0 ? recording.time_s.back() : 0.0},
                  {"incomplete", recording.incomplete}};
    if (!file.empty()) {
        document["file"] = file;
    } else {
        document["time_s"] = recording.time_s;
        for (const auto& column : recording.columns)
            document["columns"].push_back(
                {{"name", column.name}, {"unit", column.unit}, {"values", column.values}});
    }
    session.tell(fmt::format("{}: {} in {:.3f} s{}", file, counted(recording.size(), "sample"),
                             recording.size() > 0 ? recording.time_s.back() : 0.0,
                             recording.incomplete.empty() ? "" : ", incomplete: " + recording.incomplete),
                 document);
}

void poll(Session& session, const RecordArguments& options, const RecordOptions& how) {
    Recording recording;
    try {
        record_polling(session.motor(), how, recording);
    } catch (const std::runtime_error& error) {
        session.progress("");
        if (recording.size() < 2) throw;
        // A row may be half filled when the line failed.
        for (auto& column : recording.columns) column.values.resize(recording.size());
        recording.incomplete = error.what();
        const bool without_end = how.samples == 0 && how.lasts.count() == 0;
        if (without_end && !goes_on()) recording.incomplete.clear();  // Ctrl-C is the normal end
        save(session, options, recording);
        if (recording.incomplete.empty()) return;
        throw;
    }
    session.progress("");
    save(session, options, recording);
}

/// What was read of a buffer before the failure; a second recording would not have it.
[[noreturn]] void keep_broken(Session& session, const RecordArguments& options, const RecordOptions& how,
                              Recording& recording, const std::string& why, int exit_code) {
    session.progress("");
    const std::size_t count = recording.size();
    if (count == 0)
        throw command_line::Failure(exit_code, why + "; no sample had been read, and no file was written");
    recording.incomplete = fmt::format("{} of {} were read: {}", count, counted(how.samples, "sample"),
                                       why.substr(0, why.find('\n')));
    const std::string csv = to_csv(recording);
    const std::string file = output_file(options.output, true);
    const std::string part = file.empty() ? "standard output" : file + ".part";
    if (!file.empty()) {
        if (const std::string problem = whole_files::write_files({{part, csv}}); !problem.empty())
            throw command_line::Failure(exit_code,
                                        fmt::format("{}; what was read is lost too: {}", why, problem));
    } else if (!session.json()) {
        fmt::print("{}", csv);
    }
    throw command_line::Failure(
        exit_code,
        fmt::format("{}; {} of {} were read and are in {}, marked as incomplete", why, count,
                    counted(how.samples, "sample"), part),
        {{"incomplete", true}, {"read", count}, {"of", how.samples}, {"file", file.empty() ? "" : part}});
}

using FromBuffer = Recording(Motor& motor, const RecordOptions& how, Recording* broken);

void record_and_save(Session& session, const RecordArguments& options, const RecordOptions& how,
                     FromBuffer* from_buffer) {
    Recording broken;
    try {
        const Recording recording = from_buffer(session.motor(), how, &broken);
        session.progress("");
        save(session, options, recording);
    } catch (const command_line::Failure&) {
        throw;
    } catch (const mactalk_client::Ended& error) {
        const bool asked = dynamic_cast<const CannotRecord*>(&error) == nullptr;
        if (!asked && broken.size() == 0) throw;
        keep_broken(session, options, how, broken, error.what(), error.exit_code());
    }
}

RecordOptions how_to(Session& session, const RecordArguments& options) {
    const std::string file = output_file(options.output, options.force);
    if (const std::string why = whole_files::why_not_made(file); !file.empty() && !why.empty())
        throw UserError(why);
    RecordOptions how;
    how.model_name = session.model_name();
    how.registers = find_registers(session.motor().model(), options.registers);
    if (options.rate != "slow" && options.rate != "fast")
        throw UserError(fmt::format(
            "--rate {}: write slow (the position loop's) or fast (the current loop's)", options.rate));
    how.fast = options.rate == "fast";
    if (options.poll && how.fast)
        throw UserError("--poll reads as fast as the line permits and takes no --rate");
    if (!options.poll && options.lasts > 0)
        throw UserError("--for is for --poll; a buffer's length is --samples");
    how.samples = options.samples > 0 || options.poll ? options.samples : kMostSamples;
    how.within = base::Microseconds{static_cast<std::int64_t>(options.within * 1e6)};
    how.lasts = base::Microseconds{static_cast<std::int64_t>(options.lasts * 1e6)};
    if (!options.when.empty()) {
        const ConditionReading reading = read_condition(options.when, session.motor().model());
        if (!reading.error.empty()) throw UserError("--when: " + reading.error);
        how.when = reading.condition;
    }
    how.progress = [&session](const RecordProgress& progress) {
        session.progress(phase_words(progress));
        look_for_interruption();
    };
    return how;
}

void record(Session& session, const RecordArguments& options) {
    RecordOptions how = how_to(session, options);
    Motor& motor = session.motor();
    Move move;
    if (!options.move.empty()) {
        move = read_move(session, options.move);
        how.then = [&] { carry_out(motor, move); };
    }
    try {
        options.poll ? poll(session, options, how) : record_and_save(session, options, how, record_buffer);
    } catch (const mactalk_client::Ended& error) {
        session.progress("");
        const auto* failure = dynamic_cast<const command_line::Failure*>(&error);
        Json details = failure != nullptr ? failure->details() : Json::object();
        if (move.reg != nullptr) details["moved"] = move.state >= Move::State::sent;
        throw command_line::Failure(error.exit_code(), error.what() + move.words(motor.model()), details);
    }
}

/// Data that TESTU_MODE, TESTA_MODE or another program left in the buffer.
void samples(Session& session, const RecordArguments& options) {
    const std::string file = output_file(options.output, options.force);
    if (const std::string why = whole_files::why_not_made(file); !file.empty() && !why.empty())
        throw UserError(why);
    RecordOptions how;
    how.model_name = session.model_name();
    how.samples = options.samples;
    how.progress = [&session](const RecordProgress& progress) {
        session.progress(phase_words(progress));
        look_for_interruption();
    };
    record_and_save(session, options, how, fetch_buffer);
}

struct PlotArguments {
    std::string recording;
    std::string output;
    PlotOptions how;
};

std::string usual_title(const Recording& recording, const std::string& path) {
    std::string title = host::name_of(host::path_of(path).filename());
    if (recording.model.empty()) return title;
    title += fmt::format(": {}, address {}", recording.model, recording.address);
    if (recording.rate_hz > 0) title += fmt::format(", {:g} Hz", recording.rate_hz);
    return recording.start.empty() || recording.start == "now" ? title : title + ", " + recording.start;
}

void plot_file(Common& common, const PlotArguments& options) {
    const bool png = options.output.ends_with(".png");
    if (!png && !options.output.ends_with(".svg"))
        throw UserError(fmt::format("-o {}: the name must end with .svg or .png", options.output));
    const Recording recording = read_recording(options.recording);
    PlotOptions how = options.how;
    if (how.title.empty()) how.title = usual_title(recording, options.recording);
    const Plotted plotted = plot(recording, how);
    if (!plotted.error.empty()) throw UserError(fmt::format("{}: {}", options.recording, plotted.error));
    write_file(options.output, png ? to_png(plotted.picture) : to_svg(plotted.picture));
    command_line::tell(common,
                       fmt::format("{}: {} samples, {} by {} pixels", options.output, recording.size(),
                                   plotted.picture.width, plotted.picture.height),
                       {{"file", options.output},
                        {"samples", recording.size()},
                        {"width", plotted.picture.width},
                        {"height", plotted.picture.height}});
}

}  // namespace

void add_record(arguments::App& app, Common& common) {
    auto [command, options] = add_command(app, common, "record", "Record registers over time as CSV", record);
    command.add_option("registers", options.registers, "Names or numbers, P_IST,V_IST")
        ->required()
        ->delimiter(',');
    command.add_option("-o,--output", options.output, "The file; standard output if not said, or -");
    command.add_flag("--force", options.force, "Replace a file that is there");
    command
        .add_option("--rate", options.rate,
                    "slow: a sample of the position loop, about 521 Hz; fast: of the current loop, 7812.5 Hz")
        ->capture_default_str();
    command.add_option("--samples", options.samples, "How many; 895, the whole buffer, if not said")
        ->in_range(1, 10'000'000);
    command.add_option("--when", options.when, "Begin when a register condition holds: 'V_IST>100 rpm'");
    command.add_option("--within", options.within, "Seconds to wait for it; without end if not said")
        ->in_range(0.001, 1e6);
    command.add_option(
        "--move", options.move,
        "As soon as it records, P_SOLL=VALUE, P_SOLL=+VALUE (so much more) or V_SOLL=VALUE; asks first");
    command.add_flag("--poll", options.poll,
                     "Read the registers again and again instead of using the motor's buffer: slower, any "
                     "register, through a gateway too");
    command.add_option("--for", options.lasts, "With --poll: seconds; until Ctrl-C if not said")
        ->in_range(0.001, 1e6);
}

void add_samples(arguments::App& app, Common& common) {
    auto [command, options] =
        add_command(app, common, "samples", "Fetch what the motor's sample buffer holds, as CSV", samples);
    command.add_option("-o,--output", options.output, "The file; standard output if not said, or -");
    command.add_flag("--force", options.force, "Replace a file that is there");
    command.add_option("--samples", options.samples, "How many; REC_CNT if not said")
        ->in_range(1, kMostSamples);
}

void add_plot(arguments::App& app, Common& common) {
    auto [command, options] =
        add_command(app, common, "plot", "Draw a recording as an SVG or PNG picture", plot_file);
    command.add_option("recording", options.recording, "CSV of `macreg record`; - is standard input")
        ->required();
    command.add_option("-o,--output", options.output, "The picture: F.svg or F.png")->required();
    command.add_option("--columns", options.how.columns, "At most four of its columns; all if not said")
        ->delimiter(',');
    command.add_option("--width", options.how.width, "Pixels")->capture_default_str()->in_range(320, 8000);
    command.add_option("--height", options.how.height, "Pixels; 200 a panel and the rest if not said")
        ->in_range(240, 8000);
    command.add_option("--title", options.how.title, "Instead of file, model and rate");
}

}  // namespace nplc::macreg::cli
