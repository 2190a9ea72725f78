#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nanoctl/gateway_client.h"
#include "proof/certificate.h"

namespace nplc::nanoctl::cli {

/// The digest of F.proof, if it is a certificate of this table. Throws UserError.
proof::Digest certificate_for(const std::string& path, std::span<const std::uint8_t> table);

/// As it is uploaded: the table, a mark and the digest.
std::vector<std::uint8_t> with_digest(std::span<const std::uint8_t> table, const proof::Digest& digest);

/// The active table's in a gateway that takes certificates.
struct KeptProof {
    bool is_taken = false;  ///< the gateway takes certificates
    std::optional<proof::Digest> digest;
};
KeptProof read_proof(GatewayClient& gateway);

}  // namespace nplc::nanoctl::cli
