#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "orders/crypto.h"

namespace nplc::orders {

/// A table that a gateway is to run. Its text form is exact: only text that write_order() would produce is
/// accepted.
struct Order {
    std::string target;         ///< GROUP/NODE/AXIS
    std::uint64_t counter = 0;  ///< 1 and on; greater than that of all earlier orders
    std::string name;           ///< of the table, for display: 1 to 64 printable characters
    Hash sha256{};              ///< of the table as uploaded, with the bytes after its end term
    std::uint32_t bytes = 0;
    PublicKey key{};  ///< the signer's
    bool operator==(const Order&) const = default;
};

struct SignedOrder {
    Order order;
    std::string message;  ///< the signed text, up to the signature's line
    Signature signature{};
};

inline constexpr std::size_t kLongestOrder = 1024;
inline constexpr std::size_t kLongestName = 64;  ///< of a table
/// More than any gateway's table with its appendix has.
inline constexpr std::uint32_t kMostArtifactBytes = 64 * 1024;

struct OrderReading {
    std::optional<SignedOrder> order{};
    std::string error{};  ///< one line; empty if it was read
};
/// Does not check the signature.
OrderReading read_order(std::string_view text);
/// The text up to the signature's line.
std::string message_of(const Order& order);
/// Signs it; `order.key` becomes the seed's.
std::string write_order(Order order, const Seed& seed);

/// A valid name or part of a target: printable, 1 to `most` characters, no blank at its ends.
bool is_name(std::string_view text, std::size_t most);
/// GROUP/NODE/AXIS.
bool is_target(std::string_view text);

}  // namespace nplc::orders
