#pragma once

#include <optional>

#include "field.h"

/// Points of edwards25519, -x^2 + y^2 = 1 + d x^2 y^2 (RFC 8032 §5.1).
namespace nplc::signature {

/// Extended coordinates: x = X / Z, y = Y / Z, x y = T / Z.
struct Point {
    Field x;
    Field y;
    Field z;
    Field t;
};

using PointBytes = std::array<std::uint8_t, kFieldBytes>;

extern const Point kNeutral;
extern const Point kBase;

Point operator+(const Point& a, const Point& b);
Point doubled(const Point& a);
Point operator-(const Point& a);
PointBytes bytes_of(const Point& a);
/// nullopt if the bytes are no point.
std::optional<Point> point_of(std::span<const std::uint8_t, kFieldBytes> bytes);

}  // namespace nplc::signature
