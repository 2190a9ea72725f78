#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/crc32.h"
#include "encoding.h"
#include "hub.h"
#include "seat/secret.h"
#include "sequencer/term.h"
#include "set_points/symbol_record.h"

namespace nplc::panel {
namespace {

namespace own = registers::gateway;

constexpr std::size_t kMostTable = std::size_t{64} * 1024;
constexpr unsigned kMostWrongSecrets = 5;
constexpr std::uint16_t kPolicyViolation = 1008;
constexpr double kSlowest = 0.01;
constexpr double kFastest = 100;

constexpr std::string_view kStops[] = {"stop", "safe", "hold"};
constexpr std::string_view kForAxis[] = {"command", "write", "motor_read", "motor_write", "seat", "leave"};

bool is_one_of(std::string_view word, auto& words) {
    return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// Of the table only: after its end term is its certificate.
std::uint32_t crc_of_table(std::span<const std::uint8_t> bytes) {
    for (std::size_t at = 0; at + sequencer::kTermBytes <= bytes.size(); at += sequencer::kTermBytes) {
        if (sequencer::is_end(sequencer::TermView(&bytes[at], sequencer::kTermBytes)))
            return base::crc32(bytes.first(at + sequencer::kTermBytes));
    }
    return base::crc32(bytes);
}

std::string_view result_word(faces::Result result) {
    return result == faces::Result::done ? "done" : "refused";
}

}  // namespace

void Hub::received(ClientId client, std::string_view text) {
    const auto found = sessions_.find(client);
    if (found == sessions_.end()) return;
    watch_time(clock_.now());
    Session& session = found->second;
    const Request request = Request::read(text);
    // A stop is accepted even from a client that sends too much.
    const bool is_stop = request.what == "command" && is_one_of(request.text("name"), kStops);
    if (!session.may_send(clock_.now()) && !is_stop) {
        answer(client, request, "too_many", "too many messages; this one was not carried out");
        ++session.faults;
    } else if (!request.error.empty()) {
        answer(client, request, "bad_message", request.error);
        ++session.faults;
    } else {
        handle(client, session, request);
    }
    if (sessions_.contains(client) && session.faults > Session::kMostFaults)
        return server_->close(client, kPolicyViolation, "too many messages that were none");
    tick();
}

void Hub::answer(ClientId client, const Request& request, std::string_view result, const std::string& text) {
    Json message = {
        {"t", "answer"}, {"id", request.id ? Json(*request.id) : Json()}, {"result", result}, {"text", text}};
    server_->send(client, message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void Hub::answer_completion(ClientId client, std::uint64_t request, const faces::Completion& completion) {
    const Json message = {{"t", "answer"},
                          {"id", request},
                          {"result", result_word(completion.result)},
                          {"code", static_cast<unsigned>(completion.result)},
                          {"detail", completion.detail},
                          {"value", completion.value},
                          {"text", faces::describe(completion)}};
    server_->send(client, message.dump());
}

std::optional<std::size_t> Hub::axis_of(const Request& request) const {
    const std::string name = request.text("axis");
    if (name.empty() && feeds_.size() == 1) return 0;
    for (std::size_t i = 0; i < feeds_.size(); ++i) {
        if (feeds_[i].name() == name) return i;
    }
    return std::nullopt;
}

bool Hub::allows(ClientId client, Session& session, const Request& request, bool is_stop) {
    if (is_stop) return true;
    if (!session.rights.read) {
        answer(client, request, "not_logged_in", "log in first: this panel asks for a password");
        return false;
    }
    const bool reads = request.what == "motor_read" ||
                       (request.what == "sim" && request.text("record") == "get") ||
                       (request.what == "recipe" && request.text("action") == "export");
    if (reads || session.rights.operate) return true;
    answer(client, request, "no_right", "operating needs the token that the program printed at its start");
    return false;
}

void Hub::handle(ClientId client, Session& session, const Request& request) {
    if (request.what == "login") return login(client, session, request);
    if (request.what == "ping") return answer(client, request, "done", "");
    const bool is_stop = request.what == "command" && is_one_of(request.text("name"), kStops);
    if (!allows(client, session, request, is_stop)) return;
    if (is_late() && !is_stop)
        return answer_completion(client, *request.id, {.result = faces::Result::too_late});
    if (request.what == "sim" && simulation_ != nullptr) return simulate(client, session, request);
    const bool is_upload = request.what == "upload";
    const bool is_of_set_points = request.what == "set_points" || request.what == "recipe";
    if (!is_upload && !is_of_set_points && !is_one_of(request.what, kForAxis)) {
        ++session.faults;
        return answer(client, request, "bad_message", "there is no such \"do\"; see PROTOCOL.md");
    }
    const auto axis = axis_of(request);
    if (!axis) return answer(client, request, "bad_message", "\"axis\" must name one of the axes of hello");
    if (is_upload) return begin_upload(client, session, request);
    if (is_of_set_points) return ask_set_points(client, session, *axis, request);
    submit(client, session, *axis, request);
}

void Hub::login(ClientId client, Session& session, const Request& request) {
    const std::string secret = request.text("secret");
    const bool operates = faces::same_secret(secret, options_.token);
    const bool reads = faces::same_secret(secret, options_.password);
    if (!operates && !reads) {
        answer(client, request, "wrong_secret", "this is neither the token nor the password");
        if (++session.wrong_secrets >= kMostWrongSecrets)
            server_->close(client, kPolicyViolation, "too many wrong tokens");
        return;
    }
    session.rights.read = true;
    session.rights.operate = session.rights.operate || operates;
    Json message = {{"t", "answer"},
                    {"id", *request.id},
                    {"result", "done"},
                    {"text", ""},
                    {"rights", {{"read", true}, {"operate", session.rights.operate}}}};
    server_->send(client, message.dump());
}

bool Hub::join(ClientId client, Session& session, std::size_t axis) {
    AxisPart& part = session.parts[axis];
    if (!part.desk)
        part.desk = feeds_[axis].model().join(faces::Side::person,
                                              fmt::format("panel {} at {}", client, session.peer), bell_);
    return part.desk != nullptr;
}

void Hub::submit(ClientId client, Session& session, std::size_t axis, const Request& request) {
    const Asked asked = command_of(request, faces::model_of(feeds_[axis].image()), clock_.now());
    if (!asked.command) {
        ++session.faults;
        return answer(client, request, "bad_message", asked.error);
    }
    if (!join(client, session, axis))
        return answer(client, request, "refused", "too many clients operate this axis; try again");
    AxisPart& part = session.parts[axis];
    const auto id = part.desk->submit(*asked.command);
    if (!id) return answer(client, request, "refused", "too many commands wait; try again");
    part.asked.emplace(*id, *request.id);
}

void Hub::serve_desk(ClientId client, Session& session, std::size_t index, base::Instant now) {
    AxisPart& part = session.parts[index];
    if (!part.desk) return;
    while (const auto completion = part.desk->take(now)) {
        if (part.upload && completion->id == part.upload_id) {
            part.upload->ended(*completion, now);
            if (completion->result == faces::Result::done) keep_names(client, part, index, now);
            continue;
        }
        if (part.set_points && part.set_points->is_of(completion->id)) {
            part.set_points->ended(*completion);
            continue;
        }
        const auto [first, last] = part.asked.equal_range(completion->id);
        for (auto asked = first; asked != last; ++asked)
            answer_completion(client, asked->second, *completion);
        part.asked.erase(first, last);
    }
    if (part.upload) go_on_with_upload(client, session, index, now);
    if (part.set_points) go_on_with_set_points(client, part, now);
}

void Hub::begin_upload(ClientId client, Session& session, const Request& request) {
    const std::size_t axis = *axis_of(request);
    AxisPart& part = session.parts[axis];
    auto table = from_base64(request.text("table"));
    if (!table || table->empty() || table->size() > kMostTable)
        return answer(client, request, "bad_message", "\"table\" must be the table's bytes in base64");
    if (part.upload) return answer(client, request, "refused", "an upload is under way");
    if (!join(client, session, axis))
        return answer(client, request, "refused", "too many clients operate this axis; try again");
    const auto record = set_points::record_in(request.body.value("symbols", nlohmann::json()), *table);
    if (!record)
        return answer(client, request, "refused",
                      "the set-points of its names do not fit the table; build both anew");
    part.names.reset();
    if (const auto symbols = request.body.find("symbols");
        symbols != request.body.end() && symbols->is_object() && symbols_ != nullptr)
        part.names.emplace(crc_of_table(*table),
                           symbols->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    table->insert(table->end(), record->begin(), record->end());
    part.upload.emplace(std::move(*table),
                        faces::Upload::Afterwards{request.flag("activate"), request.flag("run")},
                        *request.id);
    part.told_bytes = 0;
}

/// Once the upload has begun, which takes the seat: before, a client that may not operate would rename the
/// table that runs.
void Hub::keep_names(ClientId client, AxisPart& part, std::size_t index, base::Instant now) {
    if (!part.names) return;
    const auto [crc, text] = *std::exchange(part.names, std::nullopt);
    const std::string why = symbols_->keep(index, crc, text);
    if (why.empty()) return;
    static_cast<void>(part.desk->submit(faces::Command::of(own::Command::upload_abort, now)));
    const Json message = {
        {"t", "answer"}, {"id", part.upload->request()}, {"result", "refused"}, {"text", why}};
    server_->send(client, message.dump(-1, ' ', false, Json::error_handler_t::replace));
    part.upload.reset();
}

void Hub::go_on_with_upload(ClientId client, Session& session, std::size_t index, base::Instant now) {
    AxisPart& part = session.parts[index];
    faces::Upload& upload = *part.upload;
    if (const auto command = upload.next(feeds_[index].image(), now)) {
        const auto id = part.desk->submit(*command);
        if (id) {
            part.upload_id = *id;
        } else {
            upload.ended({.id = 0, .result = faces::Result::busy}, now);
        }
    }
    if (upload.sent() != part.told_bytes) {
        part.told_bytes = upload.sent();
        server_->send(
            client,
            Json{{"t", "progress"}, {"id", upload.request()}, {"bytes", upload.sent()}, {"of", upload.size()}}
                .dump());
    }
    if (upload.is_over()) finish_upload(client, session, index);
}

void Hub::finish_upload(ClientId client, Session& session, std::size_t index) {
    AxisPart& part = session.parts[index];
    const faces::Upload& upload = *part.upload;
    const bool done = upload.result() == faces::Result::done;
    const std::string text =
        done ? ""
             : fmt::format("{}: {}{}", upload.stage_in_words(), own::describe(upload.result()),
                           upload.detail() == 0 ? "" : fmt::format(" (term {})", upload.detail()));
    server_->send(client, Json{{"t", "answer"},
                               {"id", upload.request()},
                               {"result", result_word(upload.result())},
                               {"code", static_cast<unsigned>(upload.result())},
                               {"detail", upload.detail()},
                               {"text", text}}
                              .dump());
    part.upload.reset();
    feeds_[index].read_names_anew();
}

void Hub::simulate(ClientId client, Session& session, const Request& request) {
    if (const std::string action = request.text("action"); !action.empty()) {
        const std::string error = simulation_->act(action);
        if (error.empty()) return answer(client, request, "done", "");
        return answer(client, request, "refused", error);
    }
    if (request.body.contains("pause")) {
        simulation_->pause(request.flag("pause"));
        return answer(client, request, "done", "");
    }
    if (const auto speed = request.number("speed"); speed && *speed >= kSlowest && *speed <= kFastest) {
        simulation_->set_speed(*speed);
        return answer(client, request, "done", "");
    }
    const std::string record = request.text("record");
    if (record == "clear") simulation_->clear_record();
    if (record == "get" || record == "clear")
        return answer(client, request, "done", record == "get" ? simulation_->record() : "");
    ++session.faults;
    answer(client, request, "bad_message",
           "\"sim\" takes \"action\", \"pause\", \"speed\" 0.01 to 100, or \"record\"");
}

}  // namespace nplc::panel
