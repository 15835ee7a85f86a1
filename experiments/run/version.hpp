// The sources, compiler and flags of this program. Every run records this information; the source hash is
// part of a run's id.
#pragma once

#include <string>
#include <string_view>

namespace bendlab {

struct BuildInfo {
  std::string_view version;      ///< of bendlab
  std::string_view git_commit;   ///< 40 hex digits; "unknown" outside a git checkout
  bool git_dirty = false;        ///< sources or build files differed from that commit
  std::string_view source_hash;  ///< 16 hex digits over the sources that decide results: all of lib/bendlab
                                 ///< and experiments/*.{hpp,cpp} (not experiments/cli)
  std::string_view compiler;     ///< name and version
  std::string_view flags;        ///< compiler flags, space-separated
  std::string_view build_type;   ///< Release, Debug, RelWithDebInfo
  std::string_view changes;      ///< gzip of the patch since that commit; empty if no patch, or above 4 MB
  std::string_view changes_id;   ///< 16 hex digits, the hash of the patch; empty if there is no patch
};

const BuildInfo& build_info();

/// Name of the file beside the runs that contains `changes`. If the patch is too long to be stored, the name
/// does not end in `.patch.gz`.
std::string changes_file_name();

/// One line for `bendlab --version`.
std::string_view version_text();

}  // namespace bendlab
