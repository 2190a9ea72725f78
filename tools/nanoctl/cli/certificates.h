#pragma once

#include <optional>

#include "digest/digest.h"
#include "nanoctl/gateway_client.h"
#include "proof/certificate.h"

namespace nplc::nanoctl::cli {

/// The active table's in a gateway that takes certificates.
struct KeptProof {
    bool is_taken = false;  ///< the gateway takes certificates
    std::optional<digest::Digest> digest;
};
KeptProof read_proof(GatewayClient& gateway);

}  // namespace nplc::nanoctl::cli
