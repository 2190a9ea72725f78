#include "report/graph/graph_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace nplc::seqc {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kGraphVersion = 1;
constexpr double kPartsOfPoint = 100;  // of a point

double in_parts(double value) {
    return std::round(value * kPartsOfPoint) / kPartsOfPoint;
}

Json text_json(const Picture::Text& text) {
    using Anchor = Picture::Anchor;
    const TextStyle style = style_of(text.kind);
    Json json = {{"kind", style.name},
                 {"text", text.text},
                 {"x", in_parts(text.x)},
                 {"y", in_parts(text.y)},
                 {"width", in_parts(text.width)},
                 {"size", style.size},
                 {"anchor", text.anchor == Anchor::start    ? "start"
                            : text.anchor == Anchor::middle ? "middle"
                                                            : "end"}};
    if (text.way) json["way"] = *text.way;
    return json;
}

Json texts_json(const std::vector<Picture::Text>& texts) {
    Json list = Json::array();
    for (const Picture::Text& text : texts) list.push_back(text_json(text));
    return list;
}

Json way_json(const GraphModel::Way& way) {
    Json json = {{"condition", way.condition}, {"actions", way.actions}, {"to", way.to}};
    if (way.by) json["by"] = *way.by;
    json["on_error"] = way.on_error;
    return json;
}

Json node_json(const GraphModel& model, const Picture::Box& box) {
    Json json = {{"id", box.id}, {"kind", name_of(box.kind)}, {"step", box.step}};
    Json ways = Json::array();
    if (box.kind == Picture::BoxKind::note) {
        for (const GraphModel::Note& note : model.notes) {
            if (note.way.to != box.step) continue;
            ways.push_back(way_json(note.way));
            ways.back()["where"] = note.where;
        }
    } else {
        const auto of = std::find_if(model.boxes.begin(), model.boxes.end(),
                                     [&](const GraphModel::Box& b) { return b.step == box.step; });
        json["steps"] = of->steps;
        json["name"] = of->name;
        if (!of->made_as.empty()) json["made_as"] = of->made_as;
        json["reachable"] = box.reachable;
        json["outputs"] = of->outputs;
        json["entry"] = of->entry;
        for (const GraphModel::Way& way : of->ways) ways.push_back(way_json(way));
    }
    json["ways"] = std::move(ways);
    json["x"] = in_parts(box.x);
    json["y"] = in_parts(box.y);
    json["width"] = in_parts(box.width);
    json["height"] = in_parts(box.height);
    json["rules"] = Json::array();
    for (const double y : box.rules) json["rules"].push_back(in_parts(y));
    json["texts"] = texts_json(box.texts);
    return json;
}

Json edge_json(const Picture::Line& line) {
    Json json = {{"from", line.from}, {"to", line.to}, {"kind", name_of(line.kind)}};
    if (line.way) json["way"] = *line.way;
    json["points"] = Json::array();
    for (const auto& [x, y] : line.points) json["points"].push_back({in_parts(x), in_parts(y)});
    return json;
}

}  // namespace

Json graph_json_of(const GraphModel& model, const Picture& picture) {
    Json json = {{"format", "nanoplc-graph"}, {"version", kGraphVersion}, {"program", model.title}};
    if (!model.motor.empty()) json["motor"] = model.motor;
    if (!model.scale.empty()) json["scale"] = model.scale;
    json["table"] = {{"crc32", fmt::format("{:08x}", model.crc32)}, {"terms", model.terms}};
    json["page"] = {
        {"width", in_parts(picture.width)}, {"height", in_parts(picture.height)}, {"points", picture.scale}};
    json["terminals"] = Json::array();
    for (const auto& [terminal, name] : model.terminals)
        json["terminals"].push_back({{"terminal", terminal}, {"name", name}});
    json["texts"] = texts_json(picture.texts);
    json["nodes"] = Json::array();
    for (const Picture::Box& box : picture.boxes) json["nodes"].push_back(node_json(model, box));
    json["edges"] = Json::array();
    for (const Picture::Line& line : picture.lines) json["edges"].push_back(edge_json(line));
    return json;
}

}  // namespace nplc::seqc
