#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "digest/digest.h"
#include "proof/certificate.h"
#include "set_points/record.h"

/// What is uploaded to a gateway, of files; what goes wrong is a UserError.
namespace nplc::uploads {

/// A table in a .bin or Intel HEX file, held to the rules of a table; nothing may follow its end term.
std::vector<std::uint8_t> read_table(const std::string& path);

/// The set-points that the F.sym beside a table declares, or `symbols` if it is named; none without such a
/// file. One that has set-points of another table is a UserError.
set_points::Record read_record(const std::string& table_file, const std::string& symbols,
                               std::span<const std::uint8_t> table);

/// The digest of F.proof, if it is a certificate of this table.
digest::Digest certificate_for(const std::string& path, std::span<const std::uint8_t> table);

/// As it is uploaded: the table with what follows it, a mark and the digest.
std::vector<std::uint8_t> with_digest(std::span<const std::uint8_t> table, const digest::Digest& digest);

/// Appears whole or stays as it was, but a device or pipe is written to; Intel HEX if its name says so.
void write_table(const std::string& path, std::span<const std::uint8_t> table);

}  // namespace nplc::uploads
