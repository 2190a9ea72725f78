#include "digest/digest.h"

#include <sha2.h>

namespace nplc::digest {

bool is_available() {
    return true;
}

Digest sha256(std::span<const std::uint8_t> bytes) {
    SHA2_CTX context;
    Digest digest{};
    SHA256Init(&context);
    SHA256Update(&context, bytes.data(), bytes.size());
    SHA256Final(digest.data(), &context);
    return digest;
}

}  // namespace nplc::digest
