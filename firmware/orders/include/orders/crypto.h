#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "digest/digest.h"

/// Ed25519 (RFC 8032), by libsodium.
namespace nplc::orders {

using digest::hex;
using digest::read_hex;
using digest::sha256;
using Hash = digest::Digest;
using PublicKey = std::array<std::uint8_t, 32>;
using Signature = std::array<std::uint8_t, 64>;
/// The seed of a secret key (RFC 8032 §5.1.5).
using Seed = std::array<std::uint8_t, 32>;

/// Whether this program was built with libsodium and libmd. Without them nothing can be signed, and every
/// signature is invalid.
bool has_crypto();
inline constexpr std::string_view kNoCrypto =
    "this program was built without libsodium and libmd, which signed orders need";

/// Whether the signature of the message is valid for the key.
bool is_signed(std::string_view message, const Signature& signature, const PublicKey& key);

Signature sign(std::string_view message, const Seed& seed);
PublicKey public_key_of(const Seed& seed);
/// From the system's random numbers.
Seed new_seed();

}  // namespace nplc::orders
