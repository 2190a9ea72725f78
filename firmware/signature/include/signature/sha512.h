#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nplc::signature {

inline constexpr std::size_t kSha512Bytes = 64;
using Digest512 = std::array<std::uint8_t, kSha512Bytes>;

/// SHA-512 (FIPS 180-4) of bytes that are added piece by piece.
class Sha512 {
  public:
    void add(std::span<const std::uint8_t> bytes);
    /// The digest of all added bytes; nothing may be added afterwards.
    Digest512 end();

  private:
    static constexpr std::size_t kBlock = 128;

    void take(std::uint8_t byte);
    void work();

    std::array<std::uint64_t, 8> state_{0x6A09E667F3BCC908, 0xBB67AE8584CAA73B, 0x3C6EF372FE94F82B,
                                        0xA54FF53A5F1D36F1, 0x510E527FADE682D1, 0x9B05688C2B3E6C1F,
                                        0x1F83D9ABFB41BD6B, 0x5BE0CD19137E2179};
    std::array<std::uint8_t, kBlock> block_{};
    std::uint64_t bytes_ = 0;
};

}  // namespace nplc::signature
