#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "orders/crypto.h"

namespace nplc::orders {

/// Of an artifact; the last one has the rest.
inline constexpr std::size_t kPieceBytes = 4096;
constexpr std::size_t pieces_of(std::size_t bytes) {
    return (bytes + kPieceBytes - 1) / kPieceBytes;
}
/// Piece `number` of what is whole.
std::span<const std::uint8_t> piece_of(std::span<const std::uint8_t> whole, std::size_t number);

/// Pieces of an artifact as they come: in any order, several times, or never.
class Pieces {
  public:
    Pieces(const Hash& hash, std::size_t bytes) : hash_(hash), pieces_(pieces_of(bytes)), bytes_(bytes) {}

    enum class Verdict : std::uint8_t {
        taken,
        not_one,      ///< there is no such piece, or it has another length
        whole,        ///< with it all are there, and fit the hash
        wrong_whole,  ///< with it all were there, and do not: all are to come again
    };
    Verdict take(std::size_t number, std::span<const std::uint8_t> piece);
    std::size_t missing() const;
    const Hash& hash() const { return hash_; }
    /// Once whole.
    const std::vector<std::uint8_t>& artifact() const { return artifact_; }

  private:
    Hash hash_;
    std::vector<std::vector<std::uint8_t>> pieces_;
    std::size_t bytes_;
    std::vector<std::uint8_t> artifact_;
};

}  // namespace nplc::orders
