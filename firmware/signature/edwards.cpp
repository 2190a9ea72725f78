#include "edwards.h"

namespace nplc::signature {
namespace {

constexpr Field kZero{};
constexpr Field kOne{{1}};
constexpr Field kD{{0x78A3, 0x1359, 0x4DCA, 0x75EB, 0xD8AB, 0x4141, 0x0A4D, 0x0070, 0xE898, 0x7779, 0x4079,
                    0x8CC7, 0xFE73, 0x2B6F, 0x6CEE, 0x5203}};
constexpr Field kTwiceD{{0xF159, 0x26B2, 0x9B94, 0xEBD6, 0xB156, 0x8283, 0x149A, 0x00E0, 0xD130, 0xEEF3,
                         0x80F2, 0x198E, 0xFCE7, 0x56DF, 0xD9DC, 0x2406}};
constexpr Field kRootOfMinusOne{{0xA0B0, 0x4A0E, 0x1B27, 0xC4EE, 0xE478, 0xAD2F, 0x1806, 0x2F43, 0xD7A7,
                                 0x3DFB, 0x0099, 0x2B4D, 0xDF0B, 0x4FC1, 0x2480, 0x2B83}};
constexpr Field kBaseX{{0xD51A, 0x8F25, 0x2D60, 0xC956, 0xA7B2, 0x9525, 0xC760, 0x692C, 0xDC5C, 0xFDD6,
                        0xE231, 0xC0A4, 0x53FE, 0xCD6E, 0x36D3, 0x2169}};
constexpr Field kBaseY{{0x6658, 0x6666, 0x6666, 0x6666, 0x6666, 0x6666, 0x6666, 0x6666, 0x6666, 0x6666,
                        0x6666, 0x6666, 0x6666, 0x6666, 0x6666, 0x6666}};
constexpr Field kBaseT{{0xDDA3, 0xA5B7, 0x8AB3, 0x6DDE, 0x52F5, 0x7751, 0x9F80, 0x20F0, 0xE37D, 0x64AB,
                        0x4E8E, 0x66EA, 0x7665, 0xD78B, 0x5F0F, 0x6787}};

bool is_odd(const Field& a) {
    return (bytes_of(a)[0] & 1U) != 0;
}

/// The common part of addition and doubling.
Point join(const Field& e, const Field& f, const Field& g, const Field& h) {
    return {.x = e * f, .y = g * h, .z = f * g, .t = e * h};
}

}  // namespace

constinit const Point kNeutral{.x = kZero, .y = kOne, .z = kOne, .t = kZero};
constinit const Point kBase{.x = kBaseX, .y = kBaseY, .z = kOne, .t = kBaseT};

Point operator+(const Point& a, const Point& b) {
    const Field p = (a.y - a.x) * (b.y - b.x);
    const Field q = (a.y + a.x) * (b.y + b.x);
    const Field c = a.t * kTwiceD * b.t;
    const Field half = a.z * b.z;
    const Field d = half + half;
    return join(q - p, d - c, d + c, q + p);
}

Point doubled(const Point& a) {
    const Field xx = squared(a.x);
    const Field yy = squared(a.y);
    const Field zz = squared(a.z);
    const Field e = squared(a.x + a.y) - xx - yy;
    const Field g = yy - xx;
    return join(e, g - zz - zz, g, kZero - xx - yy);
}

Point operator-(const Point& a) {
    return {.x = kZero - a.x, .y = a.y, .z = a.z, .t = kZero - a.t};
}

PointBytes bytes_of(const Point& a) {
    const Field scale = inverse(a.z);
    PointBytes bytes = bytes_of(a.y * scale);
    if (is_odd(a.x * scale)) bytes.back() |= 0x80;
    return bytes;
}

/// x^2 = (y^2 - 1) / (d y^2 + 1), RFC 8032 §5.1.3.
std::optional<Point> point_of(std::span<const std::uint8_t, kFieldBytes> bytes) {
    const Field y = field_of(bytes);
    const Field yy = squared(y);
    const Field u = yy - kOne;
    const Field v = yy * kD + kOne;
    const Field v3 = squared(v) * v;
    Field x = u * v3 * power_for_root(u * squared(v3) * v);
    const Field vxx = v * squared(x);
    if (!(vxx == u)) {
        if (!(vxx == kZero - u)) return std::nullopt;
        x = x * kRootOfMinusOne;
    }
    const bool wants_odd = (bytes.back() & 0x80) != 0;
    if (wants_odd && x == kZero) return std::nullopt;
    if (is_odd(x) != wants_odd) x = kZero - x;
    return Point{.x = x, .y = y, .z = kOne, .t = x * y};
}

}  // namespace nplc::signature
