#pragma once

#include <optional>

#include "digest/digest.h"
#include "nanoctl/gateway_client.h"
#include "proof/certificate.h"

namespace nplc::nanoctl::cli {

/// The certificate of the active table, for a gateway that supports certificates.
struct KeptProof {
    bool is_taken = false;  ///< the gateway supports certificates
    std::optional<digest::Digest> digest;
};
KeptProof read_proof(GatewayClient& gateway);

}  // namespace nplc::nanoctl::cli
