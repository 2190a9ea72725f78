#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orders/crypto.h"

namespace nplc::orders {

/// A key whose orders are accepted.
struct TrustedKey {
    std::string name;
    PublicKey key{};
};

/// "nanoplc-public-key NAME HEX", "nanoplc-secret-key NAME HEX" and an end of line: the whole file.
std::string write_public(const TrustedKey& key);
std::string write_secret(const std::string& name, const Seed& seed);
std::optional<TrustedKey> read_public(std::string_view text);
struct SecretKey {
    std::string name;
    Seed seed{};
};
std::optional<SecretKey> read_secret(std::string_view text);

/// A valid key name: letters, digits, - and _, at most 32. Its files are NAME.pub and NAME.key.
bool is_key_name(std::string_view name);

struct TrustedKeys {
    std::vector<TrustedKey> keys{};
    std::string error{};  ///< one line; then no key is trusted
    const TrustedKey* find(const PublicKey& key) const;
};
/// Reads all files *.pub of a folder. One invalid file is an error for all, since it is unknown whose key is
/// missing.
TrustedKeys read_trusted(const std::string& folder);

}  // namespace nplc::orders
