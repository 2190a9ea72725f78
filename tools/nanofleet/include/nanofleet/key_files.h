#pragma once

#include <string>
#include <vector>

#include "orders/keys.h"

/// Keys in a folder: NAME.key is secret, NAME.pub is not. What goes wrong is a UserError.
namespace nplc::nanofleet {

/// Makes both files, the secret one for its owner alone (0600). One that is there stays, and is an error.
orders::TrustedKey make_key(const std::string& folder, const std::string& name);

struct KeyFiles {
    orders::TrustedKey key;
    bool has_secret = false;
};
/// By their names.
std::vector<KeyFiles> list_keys(const std::string& folder);

/// Of a file that nobody but its owner can read.
orders::SecretKey read_secret_file(const std::string& path);
/// As it is, the seed's.
orders::TrustedKey public_of(const orders::SecretKey& secret);

}  // namespace nplc::nanofleet
