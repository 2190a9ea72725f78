#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "orders/crypto.h"

namespace nplc::orders {

/// What a gateway is to run. Its text is exact: what is read is what writing it gives, byte for byte.
struct Order {
    std::string target;         ///< GROUP/NODE/AXIS
    std::uint64_t counter = 0;  ///< 1 and on; greater than that of any order before it
    std::string name;           ///< of the table, for people: 1 to 64 printable characters
    Hash sha256{};              ///< of the table as it is uploaded, with what follows its end term
    std::uint32_t bytes = 0;
    PublicKey key{};  ///< whose signature it has
    bool operator==(const Order&) const = default;
};

struct SignedOrder {
    Order order;
    std::string message;  ///< what the signature is of: the text up to its line
    Signature signature{};
};

inline constexpr std::size_t kLongestOrder = 1024;
inline constexpr std::size_t kLongestName = 64;  ///< of a table
/// More than any gateway's table has, with what follows it.
inline constexpr std::uint32_t kMostArtifactBytes = 64 * 1024;

struct OrderReading {
    std::optional<SignedOrder> order{};
    std::string error{};  ///< one line; empty if it was read
};
/// Says nothing of whether the signature is right.
OrderReading read_order(std::string_view text);
/// The text up to the signature's line.
std::string message_of(const Order& order);
/// Signed; `order.key` becomes the seed's.
std::string write_order(Order order, const Seed& seed);

/// What may be a name or stand in a target: printable, 1 to `most` characters, no blank at its ends.
bool is_name(std::string_view text, std::size_t most);
/// GROUP/NODE/AXIS.
bool is_target(std::string_view text);

}  // namespace nplc::orders
