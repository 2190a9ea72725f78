#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "orders/crypto.h"

namespace nplc::orders {

/// Size of a piece of an artifact; the last one has the rest.
inline constexpr std::size_t kPieceBytes = 4096;
constexpr std::size_t pieces_of(std::size_t bytes) {
    return (bytes + kPieceBytes - 1) / kPieceBytes;
}
/// Piece `number` of the whole artifact.
std::span<const std::uint8_t> piece_of(std::span<const std::uint8_t> whole, std::size_t number);

/// Collects the pieces of an artifact, in any order and with repetitions.
class Pieces {
  public:
    Pieces(const Hash& hash, std::size_t bytes) : hash_(hash), pieces_(pieces_of(bytes)), bytes_(bytes) {}

    enum class Verdict : std::uint8_t {
        taken,
        not_one,      ///< invalid number or length
        whole,        ///< all pieces are complete, and the hash is correct
        wrong_whole,  ///< all pieces were complete, but the hash is wrong: all are needed again
    };
    Verdict take(std::size_t number, std::span<const std::uint8_t> piece);
    std::size_t missing() const;
    const Hash& hash() const { return hash_; }
    /// Valid when complete.
    const std::vector<std::uint8_t>& artifact() const { return artifact_; }

  private:
    Hash hash_;
    std::vector<std::vector<std::uint8_t>> pieces_;
    std::size_t bytes_;
    std::vector<std::uint8_t> artifact_;
};

}  // namespace nplc::orders
