#pragma once

#include <string>
#include <vector>

#include "orders/keys.h"

/// Keys in a folder: NAME.key is secret, NAME.pub is not. Errors are UserErrors.
namespace nplc::nanofleet {

/// Creates both files, the secret one readable by its owner alone (0600). An existing one is kept, and is an
/// error.
orders::TrustedKey make_key(const std::string& folder, const std::string& name);

struct KeyFiles {
    orders::TrustedKey key;
    bool has_secret = false;
};
/// In the order of their names.
std::vector<KeyFiles> list_keys(const std::string& folder);

/// Refuses a file that others than its owner can read.
orders::SecretKey read_secret_file(const std::string& path);
/// The public key of the seed.
orders::TrustedKey public_of(const orders::SecretKey& secret);

}  // namespace nplc::nanofleet
