#include "cli/certificates.h"

#include <algorithm>

#include "base/bytes.h"

namespace nplc::nanoctl::cli {

KeptProof read_proof(GatewayClient& gateway) {
    const Block block = gateway.read_block(gw::PROOF_BYTES);
    KeptProof kept{.is_taken = block[0] == gw::kProofBytes, .digest = {}};
    if (!kept.is_taken) return kept;
    digest::Digest digest{};
    for (std::size_t i = 0; i < gw::kProofWords; ++i) base::store_u32(&digest[4 * i], block[1 + i]);
    const bool has_one =
        std::any_of(digest.begin(), digest.end(), [](std::uint8_t byte) { return byte != 0; });
    if (has_one) kept.digest = digest;
    return kept;
}

}  // namespace nplc::nanoctl::cli
