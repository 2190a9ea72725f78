#include "orders/crypto.h"

#include <sodium.h>

#include <algorithm>

namespace nplc::orders {
namespace {

const unsigned char* bytes_of(std::string_view text) {
    return reinterpret_cast<const unsigned char*>(text.data());
}

struct KeyPair {
    explicit KeyPair(const Seed& seed) {
        ::crypto_sign_seed_keypair(public_key.data(), secret.data(), seed.data());
    }
    ~KeyPair() { ::sodium_memzero(secret.data(), secret.size()); }
    KeyPair(const KeyPair&) = delete;
    KeyPair& operator=(const KeyPair&) = delete;

    PublicKey public_key{};
    std::array<std::uint8_t, crypto_sign_SECRETKEYBYTES> secret{};
};

}  // namespace

bool has_crypto() {
    static const bool is_ready = digest::is_available() && ::sodium_init() >= 0;
    return is_ready;
}

bool is_signed(std::string_view message, const Signature& signature, const PublicKey& key) {
    return has_crypto() && ::crypto_sign_verify_detached(signature.data(), bytes_of(message), message.size(),
                                                         key.data()) == 0;
}

Signature sign(std::string_view message, const Seed& seed) {
    const KeyPair keys(seed);
    Signature signature{};
    ::crypto_sign_detached(signature.data(), nullptr, bytes_of(message), message.size(), keys.secret.data());
    return signature;
}

PublicKey public_key_of(const Seed& seed) {
    return KeyPair(seed).public_key;
}

Seed new_seed() {
    Seed seed{};
    if (has_crypto()) ::randombytes_buf(seed.data(), seed.size());
    return seed;
}

}  // namespace nplc::orders
