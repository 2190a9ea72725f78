#include "hub.h"

namespace nplc::panel {

void Hub::ask_set_points(ClientId client, Session& session, std::size_t axis, const Request& request) {
    const SetPointFeed& feed = feeds_[axis].set_points();
    std::string file;
    const bool exports = request.what == "recipe" && request.text("action") == "export";
    SetPointsRead read =
        exports ? SetPointWork::export_to(request, feed, file) : SetPointWork::read(request, feed);
    if (!read.is_message) ++session.faults;
    if (!read.error.empty())
        return answer(client, request, read.is_message ? "refused" : "bad_message", read.error);
    if (exports) return answer(client, request, "done", file);
    AxisPart& part = session.parts[axis];
    if (part.set_points) return answer(client, request, "refused", "a change is under way; try again");
    if (!join(client, session, axis))
        return answer(client, request, "refused", "too many clients operate this axis; try again");
    part.set_points = std::move(read.work);
}

void Hub::go_on_with_set_points(ClientId client, AxisPart& part, base::Instant now) {
    SetPointWork& work = *part.set_points;
    if (const auto command = work.next(now)) {
        const auto id = part.desk->submit(*command);
        if (id) {
            work.submitted(*id);
        } else {
            work.ended({.id = 0, .result = faces::Result::busy});
        }
    }
    if (!work.is_over()) return;
    const bool is_done = work.result() == faces::Result::done;
    server_->send(client, Json{{"t", "answer"},
                               {"id", work.request()},
                               {"result", is_done ? "done" : "refused"},
                               {"code", static_cast<unsigned>(work.result())},
                               {"detail", work.detail()},
                               {"text", work.text()}}
                              .dump(-1, ' ', false, Json::error_handler_t::replace));
    if (is_done && simulation_ != nullptr && !work.action().empty()) simulation_->note(work.action());
    part.set_points.reset();
}

}  // namespace nplc::panel
