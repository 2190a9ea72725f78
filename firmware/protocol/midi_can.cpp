#include "protocol/midi_can.h"

namespace nplc::protocol::midi_can {
namespace {

constexpr std::uint8_t kDownload = 0x23;
constexpr std::uint8_t kDownloaded = 0x60;
constexpr std::uint8_t kUpload = 0x40;
constexpr std::uint8_t kUploaded = 0x42;
constexpr std::uint8_t kUploadedCia301 = 0x43;
constexpr std::uint8_t kAbort = 0x80;
constexpr std::uint8_t kSwitchMode = 0x04;
constexpr std::uint8_t kSetAddress = 0x11;
constexpr std::uint8_t kWhole = 8;
constexpr std::uint16_t kRamIndex = kIndices + 8;

struct Sdo {
    std::uint16_t index;
    std::uint8_t sub_index;
    std::uint32_t data;
};

base::CanFrame sdo_frame(unsigned id, std::uint8_t order, const Sdo& sdo) {
    const auto byte = [&sdo](int shift) { return static_cast<std::uint8_t>(sdo.data >> shift); };
    return {.id = id,
            .length = kWhole,
            .data = {order, static_cast<std::uint8_t>(sdo.index), static_cast<std::uint8_t>(sdo.index >> 8),
                     sdo.sub_index, byte(24), byte(16), byte(8), byte(0)}};
}

Sdo sdo_of(const base::CanFrame& frame) {
    const auto& d = frame.data;
    return {.index = static_cast<std::uint16_t>(d[1] | d[2] << 8),
            .sub_index = d[3],
            .data = static_cast<std::uint32_t>(d[4]) << 24 | static_cast<std::uint32_t>(d[5]) << 16 |
                    static_cast<std::uint32_t>(d[6]) << 8 | d[7]};
}

base::CanFrame lmt_frame(std::uint16_t id, std::uint8_t order, std::uint8_t parameter) {
    return {.id = id, .length = kWhole, .data = {order, parameter}};
}

Request::Kind request_kind(std::uint8_t order) {
    if (order == kDownload) return Request::Kind::command;
    return order == kUpload ? Request::Kind::query : Request::Kind::other;
}

Answer::Kind answer_kind(std::uint8_t order) {
    switch (order) {
        case kDownloaded:
            return Answer::Kind::accepted;
        case kUploaded:
        case kUploadedCia301:
            return Answer::Kind::value;
        case kAbort:
            return Answer::Kind::refused;
        default:
            return Answer::Kind::none;
    }
}

Request decode_lmt(const base::CanFrame& frame) {
    if (frame.length < 2) return {};
    if (frame.data[0] == kSetAddress) return {.kind = Request::Kind::set_address, .data = frame.data[1]};
    if (frame.data[0] != kSwitchMode || frame.data[1] > 1) return {};
    return {.kind = frame.data[1] == 1 ? Request::Kind::configure : Request::Kind::operate};
}

}  // namespace

base::CanFrame encode(const Request& request) {
    const unsigned id = kToModule + (request.address & kMaxAddress);
    const Sdo sdo{request.index, request.sub_index, request.data};
    switch (request.kind) {
        case Request::Kind::command:
            return sdo_frame(id, kDownload, sdo);
        case Request::Kind::query:
            return sdo_frame(id, kUpload, sdo);
        case Request::Kind::sync:
            return {.id = kSync};
        case Request::Kind::configure:
            return lmt_frame(kLmt, kSwitchMode, 1);
        case Request::Kind::set_address:
            return lmt_frame(kLmt, kSetAddress, static_cast<std::uint8_t>(request.data));
        case Request::Kind::operate:
            return lmt_frame(kLmt, kSwitchMode, 0);
        case Request::Kind::none:
        case Request::Kind::other:
            break;
    }
    return {};
}

Request decode_request(const base::CanFrame& frame) {
    if (frame.id == kSync && frame.length == 0) return {.kind = Request::Kind::sync};
    if (frame.id == kLmt) return decode_lmt(frame);
    if (frame.id < kToModule || frame.id > kToModule + kMaxAddress || frame.length != kWhole) return {};
    // An answer to a general message as 003 prints it (601h) is no request.
    if (answer_kind(frame.data[0]) != Answer::Kind::none) return {};
    const Sdo sdo = sdo_of(frame);
    return {.kind = request_kind(frame.data[0]),
            .address = static_cast<std::uint8_t>(frame.id - kToModule),
            .index = sdo.index,
            .sub_index = sdo.sub_index,
            .data = sdo.data};
}

base::CanFrame encode_answer(const Answer& answer) {
    const unsigned id = kFromModule + (answer.address & kMaxAddress);
    const Sdo sdo{answer.index, answer.sub_index, answer.data};
    switch (answer.kind) {
        case Answer::Kind::accepted:
            return sdo_frame(id, kDownloaded, sdo);
        case Answer::Kind::value:
            return sdo_frame(id, kUploaded, sdo);
        case Answer::Kind::refused:
            return sdo_frame(id, kAbort, sdo);
        case Answer::Kind::address_taken:
            return lmt_frame(kLmtAnswer, kSetAddress, 0);
        case Answer::Kind::address_refused:
            return lmt_frame(kLmtAnswer, kSetAddress, 1);
        case Answer::Kind::booted:
            return {.id = kBootUp + (answer.address & unsigned{kMaxAddress}), .length = 1};
        case Answer::Kind::none:
            break;
    }
    return {};
}

Answer decode_answer(const base::CanFrame& frame) {
    const std::uint32_t id = frame.id;
    const std::uint8_t size = frame.length;
    const auto& data = frame.data;
    if (id == kLmtAnswer) {
        if (size < 2 || data[0] != kSetAddress) return {};
        return {.kind = data[1] == 0 ? Answer::Kind::address_taken : Answer::Kind::address_refused};
    }
    if (id > kBootUp && id <= kBootUp + kMaxAddress) {
        // R: one byte 00h (003's figure is missing; CiA 301).
        if (size != 1 || data[0] != 0) return {};
        return {.kind = Answer::Kind::booted, .address = static_cast<std::uint8_t>(id - kBootUp)};
    }
    const bool printed = id == kToModule + 1;
    if ((!printed && (id <= kFromModule || id > kFromModule + kMaxAddress)) || size != kWhole) return {};
    const Answer::Kind kind = answer_kind(data[0]);
    if (kind == Answer::Kind::none) return {};
    const Sdo sdo = sdo_of(frame);
    return {.kind = kind,
            .address = static_cast<std::uint8_t>(printed ? 1 : id - kFromModule),
            .index = sdo.index,
            .sub_index = sdo.sub_index,
            .data = sdo.data};
}

bool answers(const Answer& answer, const Request& request) {
    const bool fits = request.kind == Request::Kind::query ? answer.kind == Answer::Kind::value
                                                           : answer.kind == Answer::Kind::accepted;
    if (!fits && answer.kind != Answer::Kind::refused) return false;
    if (request.kind != Request::Kind::query && request.kind != Request::Kind::command) return false;
    const std::uint8_t from = request.address == kGeneral ? std::uint8_t{1} : request.address;
    const bool ram = request.kind == Request::Kind::query && request.index == kRamIndex;
    return answer.address == from && answer.index == request.index &&
           (ram || answer.sub_index == request.sub_index);
}

}  // namespace nplc::protocol::midi_can
