#include "cli/certificates.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/bytes.h"
#include "cli/session.h"
#include "command_line/files.h"

namespace nplc::nanoctl::cli {

proof::Digest certificate_for(const std::string& path, std::span<const std::uint8_t> table) {
    if (!proof::is_available()) throw UserError(fmt::format("{}: {}", path, proof::kNotAvailable));
    const std::string text = command_line::read_whole(path);
    const proof::CertificateReading reading = proof::read_certificate(text);
    std::string wrong = reading.error;
    if (wrong.empty()) wrong = proof::why_not_of(reading.certificate, table);
    if (!wrong.empty())
        throw UserError(fmt::format("{}: {}; prove the table with `seqc verify --proof`", path, wrong));
    return proof::sha256(text);
}

std::vector<std::uint8_t> with_digest(std::span<const std::uint8_t> table, const proof::Digest& digest) {
    std::vector<std::uint8_t> content(table.begin(), table.end());
    content.insert(content.end(), gw::kProofMark.begin(), gw::kProofMark.end());
    content.insert(content.end(), digest.begin(), digest.end());
    return content;
}

KeptProof read_proof(GatewayClient& gateway) {
    const Block block = gateway.read_block(gw::PROOF_BYTES);
    KeptProof kept{.is_taken = block[0] == gw::kProofBytes, .digest = {}};
    if (!kept.is_taken) return kept;
    proof::Digest digest{};
    for (std::size_t i = 0; i < gw::kProofWords; ++i) base::store_u32(&digest[4 * i], block[1 + i]);
    const bool has_one =
        std::any_of(digest.begin(), digest.end(), [](std::uint8_t byte) { return byte != 0; });
    if (has_one) kept.digest = digest;
    return kept;
}

}  // namespace nplc::nanoctl::cli
