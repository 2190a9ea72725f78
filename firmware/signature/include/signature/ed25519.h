#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nplc::signature {

inline constexpr std::size_t kPublicKeyBytes = 32;
inline constexpr std::size_t kSignatureBytes = 64;
using PublicKey = std::array<std::uint8_t, kPublicKeyBytes>;
using Signature = std::array<std::uint8_t, kSignatureBytes>;

/// Called regularly during long computations: they take a second on a Cortex-M0 of 16 MHz.
using Meanwhile = void (*)();

/// The message was signed by the key's owner (Ed25519, RFC 8032 §5.1.7, without cofactor, S below the
/// group's order).
bool is_signed(std::span<const std::uint8_t> message, const Signature& signature, const PublicKey& key,
               Meanwhile meanwhile);

}  // namespace nplc::signature
