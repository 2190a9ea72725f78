// Replacement without libsodium, as for a board whose Debian has none.
#include "orders/crypto.h"

namespace nplc::orders {

bool has_crypto() {
    return false;
}

bool is_signed(std::string_view /*message*/, const Signature& /*signature*/, const PublicKey& /*key*/) {
    return false;
}

Signature sign(std::string_view /*message*/, const Seed& /*seed*/) {
    return {};
}

PublicKey public_key_of(const Seed& /*seed*/) {
    return {};
}

Seed new_seed() {
    return {};
}

}  // namespace nplc::orders
