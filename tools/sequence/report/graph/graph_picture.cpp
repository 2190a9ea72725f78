#include "report/graph/graph_picture.h"

namespace nplc::seqc {
namespace {

constexpr std::string_view kOnError = "#c00000";
constexpr std::string_view kOnCondition = "#8a5a00";

}  // namespace

TextStyle style_of(Picture::TextKind kind) {
    using Kind = Picture::TextKind;
    constexpr std::string_view kPlain = "#000000";
    constexpr std::string_view kAction = "#1f4e79";
    constexpr std::string_view kTarget = "#444444";
    switch (kind) {
        case Kind::title:
            return {16, true, false, kPlain, "title"};
        case Kind::motor:
            return {10, false, false, kTarget, "motor"};
        case Kind::terminal:
            return {10, false, false, kPlain, "terminal"};
        case Kind::footer:
            return {8, false, false, kTarget, "footer"};
        case Kind::number:
            return {11, false, false, "#666666", "number"};
        case Kind::name:
            return {11, true, false, kPlain, "name"};
        case Kind::made_as:
            return {9, false, true, kTarget, "made_as"};
        case Kind::output:
            return {10, false, false, kPlain, "output"};
        case Kind::entry:
            return {10, false, false, kAction, "entry"};
        case Kind::condition:
            return {10, false, false, kPlain, "condition"};
        case Kind::action:
            return {10, false, false, kAction, "action"};
        case Kind::target:
            return {10, false, false, kTarget, "target"};
        case Kind::note:
            return {10, true, false, kPlain, "note"};
        case Kind::error_note:
            return {10, true, false, kOnError, "error_note"};
        case Kind::where:
            return {10, false, false, kPlain, "where"};
    }
    return {10, false, false, kPlain, ""};
}

std::string_view colour_of(Picture::LineKind kind) {
    using Kind = Picture::LineKind;
    return kind == Kind::error  ? kOnError
           : kind == Kind::note ? kOnCondition
           : kind == Kind::back ? "#8c8c8c"
                                : "#333333";
}

std::string_view name_of(Picture::LineKind kind) {
    using Kind = Picture::LineKind;
    return kind == Kind::error  ? "error"
           : kind == Kind::note ? "note"
           : kind == Kind::back ? "back"
                                : "forward";
}

std::string_view name_of(Picture::BoxKind kind) {
    using Kind = Picture::BoxKind;
    return kind == Kind::helper ? "helper"
           : kind == Kind::copy ? "copy"
           : kind == Kind::note ? "note"
                                : "step";
}

std::string_view colour_of(const Picture::Box& box) {
    if (box.kind != Picture::BoxKind::note) return "#333333";
    return box.on_error ? kOnError : kOnCondition;
}

double inset_of(const Picture::Box& box) {
    return box.kind == Picture::BoxKind::step && box.step == 0 ? kInnerFrame : 0;
}

std::string_view colour_of(const Picture::Box& box, const Picture::Text& text) {
    const bool has_own = box.kind != Picture::BoxKind::note || text.kind == Picture::TextKind::error_note;
    return has_own ? style_of(text.kind).colour : colour_of(box);
}

std::string_view fill_of(const Picture::Box& box) {
    using Kind = Picture::BoxKind;
    if (box.kind == Kind::note) return "#fffdf5";
    if (!box.reachable) return "#dddddd";
    return box.kind == Kind::step ? "#ffffff" : "#f2f5f9";
}

}  // namespace nplc::seqc
